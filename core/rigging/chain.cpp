#include "core/rigging/chain.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/rigging/grid_steps.h"
#include "core/rigging/tree_paths.h"

namespace voledit {

namespace {

/// From p on along `direction` to where the object ends, `reach` at most.
Vec3 surfaceFrom(const BodyShape& body, const Vec3& p, const Vec3& direction, double reach) {
    double s = 0;
    while (s < reach) {
        const Index3 c = cellAt(body.voxels, p + (s + 0.25 * body.step) * direction);
        if (!isInside(body.voxels, c) || !body.voxels.opaque[body.voxels.indexOf(c)]) break;
        s += 0.25 * body.step;
    }
    return p + s * direction;
}

int farthest(const CurveSkeleton& tree, int from) {
    const HungTree hung(tree, from);
    int best = from;
    for (const int end : hung.ends())
        if (hung.depth(end) > hung.depth(best)) best = end;
    return best;
}

/// The longest path of the tree and its way on to the surface, as a line of points.
std::vector<Vec3> longestLine(const BodyShape& body) {
    const int a = farthest(body.tree, 0), b = farthest(body.tree, a);
    const auto nodes = HungTree(body.tree, a).between(a, b);
    const auto& first = body.tree.nodes[std::size_t(nodes.front())];
    const MedialPath path(body.tree, nodes, std::max(first.radius, 2 * body.step));
    if (path.empty() || path.length() <= 0) {
        // A ball: its diameter along the longest side.
        const Vec3 size = body.box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        Vec3 low = body.box.center(), high = low;
        low[axis] = body.box.min[axis] - 0.5 * body.step;
        high[axis] = body.box.max[axis] + 0.5 * body.step;
        return {low, high};
    }
    const double reach = 0.5 * path.length() + 4 * body.step;
    std::vector<Vec3> line{surfaceFrom(body, path.at(0), -path.direction(0, 4 * body.step), reach)};
    const int pieces = std::max(2, static_cast<int>(2 * path.length() / body.step));
    for (int i = 0; i <= pieces; ++i) line.push_back(path.at(path.length() * i / pieces));
    line.push_back(surfaceFrom(body, path.at(path.length()), path.direction(path.length(), 4 * body.step), reach));
    return line;
}

}  // namespace

Skeleton chainIn(const BodyShape& body, int count) {
    std::vector<Vec3> line = longestLine(body);
    const Vec3 size = body.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (line.back()[axis] < line.front()[axis]) std::reverse(line.begin(), line.end());
    std::vector<double> along{0};
    for (std::size_t i = 1; i < line.size(); ++i) along.push_back(along.back() + glm::length(line[i] - line[i - 1]));
    Skeleton skeleton;
    std::size_t k = 0;
    for (int i = 0; i <= count; ++i) {
        const double s = along.back() * i / count;
        while (k + 2 < along.size() && along[k + 1] < s) ++k;
        const double piece = along[k + 1] - along[k];
        const double t = piece > 0 ? std::clamp((s - along[k]) / piece, 0.0, 1.0) : 0;
        skeleton.joints.push_back(
            {i == 0 ? "Chain" : "Chain" + std::to_string(i), i - 1, glm::mix(line[k], line[k + 1], t), std::nullopt});
    }
    return skeleton;
}

std::vector<Limb> chainLimbs(const Skeleton& skeleton) {
    std::vector<Limb> limbs;
    for (std::size_t i = 1; i < skeleton.joints.size(); ++i) {
        Limb limb;
        limb.name = skeleton.joints[i - 1].name;
        limb.from = static_cast<int>(i) - 1;
        limb.to = static_cast<int>(i);
        limbs.push_back(limb);
    }
    return limbs;
}

}  // namespace voledit
