#include "render/term_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

#include "core/base/parallel.h"
#include "core/objects/empty_space.h"

namespace voledit {

namespace {

constexpr int kFinest = 32;  // bricks along the longest side
constexpr int kCoarse = 8;   // bricks of a block's side: blocks are tried first

/// Finds the bricks in which something may be seen, halving blocks.
class BrickSearch {
public:
    BrickSearch(const Term& term, const Box3& box, double margin) : term_(term), box_(box), margin_(margin) {
        const Vec3 size = box.size();
        side_ = std::max({size.x, size.y, size.z}) / kFinest;
        count_ = glm::max(Index3(glm::ceil(size / side_ - 1e-9)), Index3(1));
    }

    const Index3& count() const { return count_; }
    Vec3 corner(const Index3& c) const { return glm::min(box_.min + Vec3(c) * side_, box_.max); }

    /// One for each brick, i fastest.
    std::vector<char> seen() {
        seen_.assign(std::size_t(count_.x) * std::size_t(count_.y) * std::size_t(count_.z), 0);
        const Index3 blocks = (count_ + kCoarse - 1) / kCoarse;
        parallelFor(std::size_t(blocks.x * blocks.y * blocks.z), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
                const int b = int(n);
                search(Index3(b % blocks.x, b / blocks.x % blocks.y, b / (blocks.x * blocks.y)) * kCoarse, kCoarse);
            }
        });
        return std::move(seen_);
    }

private:
    void search(const Index3& first, int side) {
        if (first.x >= count_.x || first.y >= count_.y || first.z >= count_.z) return;
        if (!mayBeVisible(term_, {corner(first) - margin_, corner(first + side) + margin_})) return;
        if (side == 1) {
            seen_[std::size_t(first.x + count_.x * (first.y + count_.y * first.z))] = 1;
            return;
        }
        for (int c = 0; c < 8; ++c) search(first + Index3(c & 1, c >> 1 & 1, c >> 2) * (side / 2), side / 2);
    }

    const Term& term_;
    Box3 box_;
    double margin_, side_ = 1;
    Index3 count_{1};
    std::vector<char> seen_;
};

}  // namespace

CellMesh termBricks(const Term& term, double slab, bool cull) {
    if (term.bounds.empty()) return {};
    // A slab shows what is within half of it of its slice. The GPU's places are rounded.
    const Vec3 size = term.bounds.size();
    const double margin = 0.5 * slab + 1e-5 * std::max({size.x, size.y, size.z});
    BrickSearch search(term, {term.bounds.min - margin, term.bounds.max + margin}, margin);
    const Index3 count = search.count();
    const std::vector<char> seen =
        cull ? search.seen() : std::vector<char>(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z), 1);
    return brickMesh(count, seen, [&](const Index3& corner) { return search.corner(corner); });
}

CellMesh termCells(const TermPlan& plan, const Vec3& origin, double slab, bool cull) {
    const MappedCells& cells = *plan.forward->by->cells();
    const auto mayBeSeen = [&](const Box3& source) { return mayBeVisible(*plan.drawn, source); };
    return tetrahedronMesh(
        cells, plan.worldFromDeformed, glm::translate(Mat4(1), -origin),
        cull ? cellsSeen(cells, plan.worldFromDeformed, slab, mayBeSeen) : std::vector<char>(cells.cellCount(), 1));
}

void TermMesh::prepare(const TermPlan& plan, const Vec3& origin, double slab, bool cull) {
    if (root_.lock() == plan.root && origin_ == origin && slab_ == slab && cull_ == cull) return;
    mesh_ = plan.forward ? termCells(plan, origin, slab, cull) : termBricks(*plan.root, slab, cull);
    root_ = plan.root;
    origin_ = origin;
    slab_ = slab;
    cull_ = cull;
}

}  // namespace voledit
