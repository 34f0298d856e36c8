#include "core/rigging/curve_skeleton.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <queue>
#include <unordered_map>

#include "core/rigging/grid_steps.h"

namespace voledit {

namespace {

constexpr std::uint32_t kNobody = 0xffffffff;

/// Joins seeds into a tree inside the object: from the deepest seed, paths grow to the nearest seed that is not yet of
/// the tree, again and again [Takahashi, Matsuyama 1980: An approximate solution for the Steiner problem in graphs]. A
/// step costs its length over the square of the depth, so that paths keep to the middle.
class SeedTree {
public:
    SeedTree(const OpaqueVoxels& voxels, const std::vector<float>& distance)
        : voxels_(voxels),
          distance_(distance),
          steps_(neighbourSteps(voxels)),
          cost_(distance.size(), kFar),
          before_(distance.size(), kNobody) {}

    /// Indices of the tree's cells, each after the one that it hangs on; `before` of the first is kNobody.
    std::vector<std::uint32_t> grow(const std::vector<Index3>& seeds) {
        std::vector<bool> isSeed(distance_.size());
        for (const Index3& s : seeds) isSeed[voxels_.indexOf(s)] = true;
        const auto deepest = std::max_element(seeds.begin(), seeds.end(), [&](const Index3& a, const Index3& b) {
            return distance_[voxels_.indexOf(a)] < distance_[voxels_.indexOf(b)];
        });
        scale_ = double(distance_[voxels_.indexOf(*deepest)]);
        take(static_cast<std::uint32_t>(voxels_.indexOf(*deepest)));
        while (!open_.empty()) {
            const auto [cost, i] = open_.top();
            open_.pop();
            if (cost > cost_[i]) continue;
            if (isSeed[i] && cost > 0)
                takePath(i);
            else
                relax(i);
        }
        return tree_;
    }
    std::uint32_t before(std::uint32_t cell) const { return before_[cell]; }

private:
    static constexpr float kFar = std::numeric_limits<float>::infinity();
    using Entry = std::pair<float, std::uint32_t>;

    void take(std::uint32_t cell) {
        cost_[cell] = 0;
        tree_.push_back(cell);
        open_.emplace(0.0F, cell);
    }
    void takePath(std::uint32_t end) {
        std::vector<std::uint32_t> path;
        for (std::uint32_t i = end; cost_[i] > 0; i = before_[i]) path.push_back(i);
        for (auto i = path.rbegin(); i != path.rend(); ++i) take(*i);
    }
    void relax(std::uint32_t i) {
        const Index3 c = cellOf(voxels_, i);
        for (const NeighbourStep& s : steps_) {
            if (!isInside(voxels_, c + s.by)) continue;
            const auto j = static_cast<std::uint32_t>(std::ptrdiff_t(i) + s.offset);
            if (!voxels_.opaque[j]) continue;
            const double depth = double(distance_[j]) / scale_;
            const auto cost = cost_[i] + static_cast<float>(s.length / (depth * depth));
            if (cost >= cost_[j]) continue;
            cost_[j] = cost;
            before_[j] = i;
            open_.emplace(cost, j);
        }
    }

    const OpaqueVoxels& voxels_;
    const std::vector<float>& distance_;
    std::vector<NeighbourStep> steps_;
    std::vector<float> cost_;
    std::vector<std::uint32_t> before_, tree_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
    double scale_ = 1;
};

/// A tree by parents (each before its children) with positions and depths.
struct RootedTree {
    std::vector<int> parent;
    std::vector<CurveSkeleton::Node> nodes;
};

/// Which nodes stay when ends are cut that stay within the ball of a node before them, and side branches that reach
/// little out of the ball where they leave: such ones follow a bump, or fan out over the sheet in the middle of a flat
/// part.
std::vector<bool> keptNodes(const RootedTree& tree) {
    constexpr double kBeyond = 1.5;
    const std::size_t n = tree.nodes.size();
    std::vector<double> reach(n, 0);  // of the longest path below
    std::vector<int> heir(n, -1);     // the child on it
    const auto step = [&](std::size_t i) {
        return glm::length(tree.nodes[i].at - tree.nodes[std::size_t(tree.parent[i])].at);
    };
    for (std::size_t i = n; i-- > 1;) {
        const auto p = std::size_t(tree.parent[i]);
        if (const double r = reach[i] + step(i); heir[p] < 0 || r > reach[p]) {
            reach[p] = r;
            heir[p] = static_cast<int>(i);
        }
    }
    std::vector<bool> kept(n, false);
    kept[0] = true;
    for (std::size_t i = 1; i < n; ++i) {
        const auto p = std::size_t(tree.parent[i]);
        if (!kept[p] || reach[p] <= tree.nodes[p].radius) continue;
        kept[i] = heir[p] == int(i) || reach[i] + step(i) > kBeyond * tree.nodes[p].radius;
    }
    return kept;
}

CurveSkeleton withoutCut(const RootedTree& tree, const std::vector<bool>& kept) {
    CurveSkeleton skeleton;
    std::vector<int> index(tree.nodes.size(), -1);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        if (!kept[i]) continue;
        index[i] = static_cast<int>(skeleton.nodes.size());
        skeleton.nodes.push_back(tree.nodes[i]);
        if (tree.parent[i] < 0) continue;
        const int p = index[std::size_t(tree.parent[i])];
        skeleton.nodes.back().neighbours.push_back(p);
        skeleton.nodes[std::size_t(p)].neighbours.push_back(index[i]);
    }
    return skeleton;
}

}  // namespace

CurveSkeleton curveSkeleton(const OpaqueVoxels& voxels, const std::vector<float>& distance, double thinness) {
    auto seeds = thinned(voxels, distance, thinness);
    if (seeds.empty()) {
        // Thinned to nothing: what is deepest stays.
        const auto deepest = std::max_element(distance.begin(), distance.end());
        if (deepest == distance.end() || *deepest <= 0) return {};
        seeds.push_back(cellOf(voxels, std::size_t(deepest - distance.begin())));
    }
    SeedTree grown(voxels, distance);
    const auto cells = grown.grow(seeds);
    std::unordered_map<std::uint32_t, int> index;
    RootedTree tree;
    for (const std::uint32_t cell : cells) {
        const auto before = index.find(grown.before(cell));
        tree.parent.push_back(before == index.end() ? -1 : before->second);
        index[cell] = static_cast<int>(tree.nodes.size());
        tree.nodes.push_back({voxels.centre(cellOf(voxels, cell)), double(distance[cell]), {}});
    }
    return withoutCut(tree, keptNodes(tree));
}

}  // namespace voledit
