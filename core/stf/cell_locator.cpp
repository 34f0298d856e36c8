#include "core/stf/cell_locator.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {
/// Grid entries for each cell that are worth their memory; cells that all lie over each other get a coarser grid.
constexpr std::size_t kEntriesPerCell = 48;
constexpr int kMaxResolution = 512;
}  // namespace

void CellLocator::clampWeights(std::array<double, 4>& weights) {
    if (*std::min_element(weights.begin(), weights.end()) >= 0) return;
    double sum = 0;
    for (double& weight : weights) sum += weight = std::max(weight, 0.0);
    for (double& weight : weights) weight /= sum;
}

CellLocator::CellLocator(const MappedCells& cells) : perCell_(cells.tetrahedraPerCell()) {
    buildInverses(cells);
    buildGrid(cells);
}

void CellLocator::buildInverses(const MappedCells& cells) {
    const auto tetrahedra = cells.tetrahedra();
    inverses_.resize(tetrahedra.size());
    parallelFor(tetrahedra.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            Inverse& inverse = inverses_[t];
            const auto& v = tetrahedra[t];
            inverse.origin = cells.deformed()[v[0]];
            if (cells.determinants()[t] == 0) {
                inverse.weightsFromEdge = Mat3(0);
                inverse.tolerance.fill(-kInfinity);
                continue;
            }
            const Vec3 e1 = cells.deformed()[v[1]] - inverse.origin, e2 = cells.deformed()[v[2]] - inverse.origin,
                       e3 = cells.deformed()[v[3]] - inverse.origin;
            const double volume = glm::dot(e1, glm::cross(e2, e3));
            const std::array<Vec3, 3> rows{glm::cross(e2, e3) / volume, glm::cross(e3, e1) / volume,
                                           glm::cross(e1, e2) / volume};
            inverse.weightsFromEdge = glm::transpose(Mat3(rows[0], rows[1], rows[2]));
            // A row's length is 1 / the height over its face: the same distance for each face.
            inverse.tolerance = {glm::length(rows[0] + rows[1] + rows[2]), glm::length(rows[0]), glm::length(rows[1]),
                                 glm::length(rows[2])};
            for (double& tolerance : inverse.tolerance) tolerance *= cells.thickness();
        }
    });
}

void CellLocator::buildGrid(const MappedCells& cells) {
    boxes_.resize(cells.cellCount());
    for (std::size_t c = 0; c < boxes_.size(); ++c) {
        Box3& box = boxes_[c];
        for (const std::uint32_t v : cells.cellVertices(c)) box = join(box, cells.deformed()[v]);
        box = {box.min - cells.thickness(), box.max + cells.thickness()};
        bounds_ = join(bounds_, box);
    }
    const Vec3 size = bounds_.size();
    const double longest = std::max({size.x, size.y, size.z});
    if (!(longest > 0)) return fillGrid(resolution_);  // no cells, or all in one point
    const Vec3 extent = glm::max(size, Vec3(1e-9 * longest));
    double side = std::cbrt(extent.x * extent.y * extent.z / (4 * double(boxes_.size())));
    for (;; side *= 1.5) {
        for (int a = 0; a < 3; ++a) {
            resolution_[a] = std::clamp(int(std::min(extent[a] / side, 1e6)), 1, kMaxResolution);
            cellsPerUnit_[a] = resolution_[a] / extent[a];
        }
        std::size_t entries = 0;
        for (const Box3& box : boxes_) {
            const auto [first, last] = range(box);
            const Index3 count = last - first + 1;
            entries += std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z);
        }
        if (resolution_ == Index3(1) || entries <= kEntriesPerCell * boxes_.size()) break;
    }
    fillGrid(resolution_);
}

void CellLocator::fillGrid(const Index3& resolution) {
    const auto forEntries = [&](const auto& body) {
        for (std::uint32_t c = 0; c < boxes_.size(); ++c) {
            const auto [first, last] = range(boxes_[c]);
            for (int k = first.z; k <= last.z; ++k)
                for (int j = first.y; j <= last.y; ++j)
                    for (int i = first.x; i <= last.x; ++i)
                        body(c, std::size_t(i) + std::size_t(resolution.x) *
                                                     (std::size_t(j) + std::size_t(resolution.y) * std::size_t(k)));
        }
    };
    starts_.assign(std::size_t(resolution.x) * std::size_t(resolution.y) * std::size_t(resolution.z) + 1, 0);
    forEntries([&](std::uint32_t, std::size_t cell) { ++starts_[cell + 1]; });
    for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
    entries_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    forEntries([&](std::uint32_t c, std::size_t cell) { entries_[next[cell]++] = c; });
}

std::pair<Index3, Index3> CellLocator::range(const Box3& box) const {
    const Index3 top = resolution_ - 1;
    return {glm::clamp(Index3((box.min - bounds_.min) * cellsPerUnit_), Index3(0), top),
            glm::clamp(Index3((box.max - bounds_.min) * cellsPerUnit_), Index3(0), top)};
}

std::span<const std::uint32_t> CellLocator::candidates(const Vec3& p) const {
    if (!bounds_.contains(p)) return {};
    return entriesOf(glm::min(Index3((p - bounds_.min) * cellsPerUnit_), resolution_ - 1));
}

std::span<const std::uint32_t> CellLocator::entriesOf(const Index3& c) const {
    const std::size_t cell = std::size_t(c.x) + std::size_t(resolution_.x) *
                                                    (std::size_t(c.y) + std::size_t(resolution_.y) * std::size_t(c.z));
    return std::span(entries_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
}

std::array<double, 4> CellLocator::weights(const Inverse& tetrahedron, const Vec3& p) {
    const Vec3 w = tetrahedron.weightsFromEdge * (p - tetrahedron.origin);
    return {1 - w.x - w.y - w.z, w.x, w.y, w.z};
}

/// Calls accepted(tetrahedron, weights) in list order until it gives true.
template <class Visit>
void CellLocator::visit(const Vec3& p, const Visit& accepted) const {
    for (const std::uint32_t c : candidates(p)) {
        if (!boxes_[c].contains(p)) continue;
        for (std::uint32_t t = perCell_ * c; t < perCell_ * (c + 1); ++t) {
            const Inverse& inverse = inverses_[t];
            auto w = weights(inverse, p);
            bool inside = true;
            for (std::size_t i = 0; i < 4; ++i) inside = inside && w[i] >= -inverse.tolerance[i];
            if (!inside) continue;
            clampWeights(w);
            if (accepted(t, w)) return;
        }
    }
}

bool CellLocator::first(const Vec3& p, CellLocation& found) const {
    bool any = false;
    visit(p, [&](std::uint32_t t, const std::array<double, 4>& w) {
        found = {t, w};
        return any = true;
    });
    return any;
}

void CellLocator::all(const Vec3& p, std::vector<CellLocation>& found) const {
    visit(p, [&](std::uint32_t t, const std::array<double, 4>& w) {
        found.push_back({t, w});
        return false;
    });
}

bool CellLocator::anyMeeting(const Box3& box, const std::function<bool(std::uint32_t)>& found) const {
    const Box3 common = intersect(box, bounds_);
    if (common.empty()) return false;
    const Vec3 centre = common.center(), half = 0.5 * common.size();
    const auto mayMeet = [&](const Inverse& inverse) {
        // No weight may be negative all over the box: the faces' planes as separating ones.
        const auto w = weights(inverse, centre);
        const Mat3 rates = glm::transpose(inverse.weightsFromEdge);
        const auto reach = [&](const Vec3& rate) { return glm::dot(glm::abs(rate), half); };
        return w[0] + reach(rates[0] + rates[1] + rates[2]) >= -2 * inverse.tolerance[0] &&
               w[1] + reach(rates[0]) >= -2 * inverse.tolerance[1] &&
               w[2] + reach(rates[1]) >= -2 * inverse.tolerance[2] &&
               w[3] + reach(rates[2]) >= -2 * inverse.tolerance[3];
    };
    const auto [first, last] = range(common);
    for (int k = first.z; k <= last.z; ++k)
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i)
                for (const std::uint32_t c : entriesOf({i, j, k})) {
                    // Only in the first grid cell that the two share, so that none comes twice.
                    if (intersect(boxes_[c], common).empty()) continue;
                    if (glm::max(range(boxes_[c]).first, first) != Index3(i, j, k)) continue;
                    for (std::uint32_t t = perCell_ * c; t < perCell_ * (c + 1); ++t)
                        if (inverses_[t].tolerance[0] >= 0 && mayMeet(inverses_[t]) && found(t)) return true;
                }
    return false;
}

bool CellLocator::wellInside(const Vec3& p, std::uint32_t& hint, CellLocation& found) const {
    const auto tries = [&](std::uint32_t t) {
        const Inverse& inverse = inverses_[t];
        const auto w = weights(inverse, p);
        for (std::size_t i = 0; i < 4; ++i)
            // A degenerate tetrahedron's weights are 1, 0, 0, 0.
            if (!(w[i] > std::abs(inverse.tolerance[i]))) return false;
        found = {t, w};
        hint = t;
        return true;
    };
    if (tries(hint)) return true;
    const std::uint32_t start = hint / perCell_ * perCell_, last = hint;
    for (std::uint32_t t = start; t < start + perCell_; ++t)
        if (t != last && tries(t)) return true;
    return false;
}

}  // namespace voledit
