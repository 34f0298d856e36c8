#include "core/base/triangles.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

namespace voledit {

namespace {

constexpr std::size_t kLeaf = 6;

bool meet(const Box3& a, const Box3& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

/// Boxes halved by their centres, over and over; a node owns a range of `order`.
class BoxTree {
public:
    BoxTree(std::span<const Box3> boxes, const std::function<bool(std::uint32_t, std::uint32_t)>& met)
        : boxes_(boxes), met_(met), order_(boxes.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        if (!boxes.empty()) build(0, order_.size());
    }

    bool anyPair() const { return !nodes_.empty() && within(0); }

private:
    struct Node {
        Box3 box;
        std::size_t first, last;          // range of order_
        std::size_t left = 0, right = 0;  // 0: a leaf
    };

    std::size_t build(std::size_t first, std::size_t last) {
        const std::size_t index = nodes_.size();
        Node node{{}, first, last};
        for (std::size_t i = first; i < last; ++i) node.box = join(node.box, boxes_[order_[i]]);
        nodes_.push_back(node);
        if (last - first <= kLeaf) return index;
        const Vec3 size = node.box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = (first + last) / 2;
        const auto at = [&](std::size_t i) { return order_.begin() + std::ptrdiff_t(i); };
        std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
            return boxes_[a].min[axis] + boxes_[a].max[axis] < boxes_[b].min[axis] + boxes_[b].max[axis];
        });
        const std::size_t left = build(first, middle), right = build(middle, last);
        nodes_[index].left = left;
        nodes_[index].right = right;
        return index;
    }

    bool test(std::uint32_t a, std::uint32_t b) const { return meet(boxes_[a], boxes_[b]) && met_(a, b); }

    bool within(std::size_t n) const {
        const Node& node = nodes_[n];
        if (node.left) return within(node.left) || within(node.right) || between(node.left, node.right);
        for (std::size_t i = node.first; i < node.last; ++i)
            for (std::size_t j = i + 1; j < node.last; ++j)
                if (test(order_[i], order_[j])) return true;
        return false;
    }

    bool between(std::size_t m, std::size_t n) const {
        const Node &a = nodes_[m], &b = nodes_[n];
        if (!meet(a.box, b.box)) return false;
        if (!a.left && !b.left) {
            for (std::size_t i = a.first; i < a.last; ++i)
                for (std::size_t j = b.first; j < b.last; ++j)
                    if (test(order_[i], order_[j])) return true;
            return false;
        }
        if (!b.left || (a.left && a.last - a.first >= b.last - b.first))
            return between(a.left, n) || between(a.right, n);
        return between(m, b.left) || between(m, b.right);
    }

    std::span<const Box3> boxes_;
    const std::function<bool(std::uint32_t, std::uint32_t)>& met_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

/// Whether the projections on `axis` lie more than `tolerance` apart; an axis of no length separates nothing.
bool separates(const Vec3& axis, const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double tolerance) {
    const auto [lowA, highA] =
        std::minmax({glm::dot(axis, a[0] - a[0]), glm::dot(axis, a[1] - a[0]), glm::dot(axis, a[2] - a[0])});
    const auto [lowB, highB] =
        std::minmax({glm::dot(axis, b[0] - a[0]), glm::dot(axis, b[1] - a[0]), glm::dot(axis, b[2] - a[0])});
    const double gap = std::max(lowB - highA, lowA - highB);
    return gap > tolerance * glm::length(axis);
}

}  // namespace

bool anyPairOfBoxes(std::span<const Box3> boxes, const std::function<bool(std::uint32_t, std::uint32_t)>& met) {
    return BoxTree(boxes, met).anyPair();
}

bool trianglesTouch(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double tolerance) {
    // Any axis that separates will do, and the line of the centres mostly does.
    if (separates((b[0] + b[1] + b[2]) - (a[0] + a[1] + a[2]), a, b, tolerance)) return false;
    const std::array<Vec3, 3> edgesA{a[1] - a[0], a[2] - a[1], a[0] - a[2]};
    const std::array<Vec3, 3> edgesB{b[1] - b[0], b[2] - b[1], b[0] - b[2]};
    const Vec3 normalA = glm::cross(edgesA[0], edgesA[1]), normalB = glm::cross(edgesB[0], edgesB[1]);
    if (separates(normalA, a, b, tolerance) || separates(normalB, a, b, tolerance)) return false;
    for (const Vec3& e : edgesA)
        for (const Vec3& f : edgesB)
            if (separates(glm::cross(e, f), a, b, tolerance)) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (separates(glm::cross(normalA, edgesA[i]), a, b, tolerance) ||
            separates(glm::cross(normalB, edgesB[i]), a, b, tolerance))
            return false;
    return true;
}

}  // namespace voledit
