// Many points in any order, located grid cell by grid cell.

#include <algorithm>

#include "core/stf/cell_locator.h"
#include "core/stf/point_packets.h"

namespace voledit {

namespace {

/// Points ordered by the grid cell that they lie in.
struct SortedPoints {
    std::vector<std::uint32_t> starts;  // of each grid cell's points; one more at the end
    std::vector<std::uint32_t> order;   // numbers of the points
    std::vector<Vec3> points;
};

}  // namespace

std::uint32_t CellLocator::gridCellOf(const Vec3& p) const {
    const Index3 c = glm::min(Index3((p - bounds_.min) * cellsPerUnit_), resolution_ - 1);
    return std::uint32_t(c.x) +
           std::uint32_t(resolution_.x) * (std::uint32_t(c.y) + std::uint32_t(resolution_.y) * std::uint32_t(c.z));
}

bool CellLocator::sortingPays(std::span<const Vec3> p) const {
    constexpr std::size_t kFewest = 4096;
    return p.size() >= kFewest && starts_.size() <= 2 * p.size();
}

bool CellLocator::followClosely(std::span<const Vec3> p) const {
    std::size_t same = 0;
    const std::size_t step = std::max<std::size_t>(p.size() / 64, 2);
    std::size_t tried = 0;
    for (std::size_t i = 1; i < p.size(); i += step, ++tried)
        same += bounds_.contains(p[i]) && bounds_.contains(p[i - 1]) && gridCellOf(p[i]) == gridCellOf(p[i - 1]);
    return 4 * same > tried;
}

void CellLocator::firstOfMany(std::span<const Vec3> p, const MappedCells& cells, std::span<Vec3> q) const {
    constexpr std::uint32_t kOutside = ~0U;
    SortedPoints sorted;
    std::vector<std::uint32_t> cell(p.size());
    sorted.starts.assign(starts_.size() + 1, 0);
    // Counted two places on, so that the starts are in place once the points are.
    for (std::size_t i = 0; i < p.size(); ++i) {
        cell[i] = bounds_.contains(p[i]) ? gridCellOf(p[i]) : kOutside;
        if (cell[i] != kOutside) ++sorted.starts[cell[i] + 2];
    }
    for (std::size_t c = 2; c < sorted.starts.size(); ++c) sorted.starts[c] += sorted.starts[c - 1];
    sorted.order.resize(sorted.starts.back());
    sorted.points.resize(sorted.starts.back());
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (cell[i] == kOutside) continue;
        const std::uint32_t at = sorted.starts[cell[i] + 1]++;
        sorted.order[at] = std::uint32_t(i);
        sorted.points[at] = p[i];
    }
    std::fill(q.begin(), q.end(), kUndefined);  // q may be p, which is no longer needed
    const PacketCells view{inverses_.data(), boxes_.data(), perCell_};
    std::vector<PacketFound> found;
    for (std::size_t c = 0; c + 1 < starts_.size(); ++c) {
        const std::size_t begin = sorted.starts[c], count = sorted.starts[c + 1] - begin;
        if (count == 0 || starts_[c] == starts_[c + 1]) continue;
        found.resize(std::max(found.size(), count));
        locatePackets(view, std::span(entries_).subspan(starts_[c], starts_[c + 1] - starts_[c]),
                      std::span(sorted.points).subspan(begin, count), std::span(found).first(count));
        for (std::size_t n = 0; n < count; ++n)
            if (found[n].tetrahedron != PacketFound::kNowhere) {
                const auto& w = found[n].weights;
                CellLocation at{found[n].tetrahedron, {1 - w[0] - w[1] - w[2], w[0], w[1], w[2]}};
                clampWeights(at.barycentric);
                q[sorted.order[begin + n]] = cells.sourceAt(at);
            }
    }
}

}  // namespace voledit
