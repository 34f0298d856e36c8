#include "core/eval/cell_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/base/parallel.h"

namespace voledit {

namespace {

// Voxels nearer than this to a face, in voxels, are in doubt: much more than rounding makes of it.
constexpr double kGuard = 1e-7;
// Tetrahedra thinner than this, in voxels, are in doubt altogether.
constexpr double kThinnest = 1e-4;
// Around a volume's domain, which reaches a thousandth of a voxel beyond its samples: surely inside, surely outside.
constexpr double kInside = 5e-4, kOutside = 2e-3;

/// Voxels of [first, last] where start + i · step lies within [low, high].
Index2 within(double start, double step, double low, double high, Index2 range) {
    if (step == 0) return start >= low && start <= high ? range : Index2(0, -1);
    double from = (low - start) / step, to = (high - start) / step;
    if (step < 0) std::swap(from, to);
    return {int(std::clamp(std::ceil(from), double(range[0]), double(range[1]) + 1)),
            int(std::clamp(std::floor(to), double(range[0]) - 1, double(range[1])))};
}

}  // namespace

RowBlock::RowBlock(const Index3& grid, const Index3& samples)
    : grid_(grid),
      samples_(samples),
      row_(kSide * kSide),
      unit_(1.0 / (1 << RowPlaces(samples).bits)),
      beginning_(row_.size() * std::size_t(grid.x)) {}

void RowBlock::setPlaces(const SamplePlaces& places) {
    SamplePlaces inUnits = places;
    for (auto* numbers : {&inUnits.start, &inUnits.alongI, &inUnits.alongJ, &inUnits.alongK})
        for (double& number : *numbers) number /= unit_;
    // Steps that would not fit are those of single voxels.
    for (std::size_t a = 0; a < 3; ++a)
        inUnits.step[a] = std::int32_t(std::round(std::clamp(inUnits.alongI[a], -2e9, 2e9)));
    current_ = std::uint32_t(places_.size());
    places_.push_back(inUnits);
}

void RowBlock::begin(int j, int k) {
    j_ = j;
    k_ = k;
    rows_ = std::min(kSide, grid_.y - j);
    slices_ = std::min(kSide, grid_.z - k);
    places_.clear();
    for (Row& row : row_) {
        row.spans = false;
        row.asks.clear();
    }
}

void RowBlock::ask(int j, int k, int first, int last) {
    auto& asks = row_[numberOf(j, k)].asks;
    for (int i = first; i <= last; ++i) asks.push_back(i);
}

namespace {

/// Where voxel 0 of row (j, k) would have its sample, along axis a, in voxels.
double startOf(const SamplePlaces& p, std::size_t a, int j, int k, double unit) {
    return (p.start[a] + p.alongJ[a] * j + p.alongK[a] * k) * unit;
}

}  // namespace

bool RowBlock::holds(int j, int k, const VoxelSpan& span) const {
    const SamplePlaces& p = places_[span.places];
    for (std::size_t a = 0; a < 3; ++a)
        for (const int i : {span.first, span.last}) {
            const double at = startOf(p, a, j, k, unit_) + i * p.alongI[a] * unit_;
            if (!(at >= -kInside && at <= samples_[int(a)] - 1 + kInside)) return false;
        }
    return true;
}

void RowBlock::addPart(int j, int k, VoxelSpan span) {
    const SamplePlaces& p = places_[span.places];
    Index2 sure(span.first, span.last), may = sure;
    for (std::size_t a = 0; a < 3; ++a) {
        const double start = startOf(p, a, j, k, unit_), step = p.alongI[a] * unit_, last = samples_[int(a)] - 1;
        if (sure[0] <= sure[1]) sure = within(start, step, -kInside, last + kInside, sure);
        if (may[0] <= may[1]) may = within(start, step, -kOutside, last + kOutside, may);
    }
    if (sure[0] > sure[1]) return ask(j, k, may[0], may[1]);
    ask(j, k, may[0], sure[0] - 1);
    ask(j, k, sure[1] + 1, may[1]);
    addInside(j, k, {span.places, sure[0], sure[1]});
}

bool RowBlock::place(int j, int k, RowPlaces& places) {
    const Row& row = row_[numberOf(j, k)];
    if (!row.spans && row.asks.empty()) return false;
    places.clear(std::size_t(grid_.x));
    Beginning* at = beginning_.data() + numberOf(j, k) * std::size_t(grid_.x);
    ofRow_.clear();
    for (int i = 0; i < grid_.x; ++i) {
        if (at[i].places == 0) continue;
        const Beginning found = std::exchange(at[i], {});
        ofRow_.push_back({found.places - 1, i, found.last});
        i = found.last;  // spans do not overlap, as their cells do not
    }
    placeSpans(ofRow_, places_, j, k, samples_, places);
    for (const std::int32_t i : row.asks) places.state[std::size_t(i)] = RowPlaces::Ask;
    return true;
}

// ---- Tetrahedra ---------------------------------------------------------------------------------------------------

/// A tetrahedron over the grid.
struct CellRows::Piece {
    Index3 first, end;  // voxels of the block that it may hold
    bool thin;
    bool inside;  // all of its samples lie in the volume
    HalfSpaces faces;
    SamplePlaces places;
};

CellRows::CellRows(const MappedCells& cells, const Mat4& gridFromDeformed, const Mat4& indexFromSource,
                   const Index3& grid, const Index3& samples)
    : cells_(cells),
      grid_(grid),
      place_(cells.deformed().size()),
      source_(place_.size()),
      blocksAlong_(std::size_t((grid.y + RowBlock::kSide - 1) / RowBlock::kSide)) {
    parallelFor(place_.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            place_[v] = transformPoint(gridFromDeformed, cells.deformed()[v]);
            source_[v] = transformPoint(indexFromSource, cells.source()[v]);
        }
    });
    findInside(Vec3(samples - 1));
    const auto forEntries = [&](const auto& body) {
        for (std::uint32_t c = 0; c < cells.cellCount(); ++c) {
            Box3 box;
            for (const std::uint32_t v : cells.cellVertices(c)) box = join(box, place_[v]);
            // Voxels of half a block more are in doubt at most.
            const Vec3 most(grid - 1);
            if (!(box.max.x >= -0.5 && box.max.y >= -0.5 && box.max.z >= -0.5)) continue;
            if (!(box.min.x <= most.x + 0.5 && box.min.y <= most.y + 0.5 && box.min.z <= most.z + 0.5)) continue;
            const Index3 first(glm::clamp(box.min - 0.5, Vec3(0), most)),
                last(glm::clamp(box.max + 0.5, Vec3(0), most));
            for (int k = first.z / RowBlock::kSide; k <= last.z / RowBlock::kSide; ++k)
                for (int j = first.y / RowBlock::kSide; j <= last.y / RowBlock::kSide; ++j)
                    body(c, blockAt(j * RowBlock::kSide, k * RowBlock::kSide));
        }
    };
    starts_.assign(blockAt(0, grid.z - 1) + blocksAlong_ + 1, 0);
    forEntries([&](std::uint32_t, std::size_t block) { ++starts_[block + 1]; });
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    entries_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    forEntries([&](std::uint32_t c, std::size_t block) { entries_[next[block]++] = c; });
}

/// False where the tetrahedron is degenerate or holds no voxel of the block.
bool CellRows::boxOf(std::uint32_t n, const RowBlock& block, Piece& piece) const {
    if (cells_.determinants()[n] == 0) return false;
    const auto& t = cells_.tetrahedra()[n];
    Vec3 low = place_[t[0]], high = low;
    for (std::size_t v = 1; v < 4; ++v) {
        low = glm::min(low, place_[t[v]]);
        high = glm::max(high, place_[t[v]]);
    }
    const Vec3 from(0, block.firstRow(), block.firstSlice());
    const Vec3 to(grid_.x, block.firstRow() + block.rows(), block.firstSlice() + block.slices());
    for (int a = 2; a >= 0; --a) {
        if (high[a] < from[a] - 0.01 || low[a] > to[a] - 0.99) return false;
        piece.first[a] = int(std::clamp(std::ceil(low[a] - 0.01), from[a], to[a]));
        piece.end[a] = int(std::clamp(std::floor(high[a] + 0.01) + 1, from[a], to[a]));
        if (piece.first[a] >= piece.end[a]) return false;
    }
    piece.inside = inside_[n / cells_.tetrahedraPerCell()] != 0;
    return true;
}

void CellRows::findInside(const Vec3& lastSample) {
    inside_.resize(cells_.cellCount());
    parallelFor(inside_.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            Box3 box;
            for (const std::uint32_t v : cells_.cellVertices(c)) box = join(box, source_[v]);
            inside_[c] = 1;
            for (int a = 0; a < 3; ++a)
                if (!(box.min[a] >= -0.5 * kInside && box.max[a] <= lastSample[a] + 0.5 * kInside)) inside_[c] = 0;
        }
    });
}

void CellRows::facesOf(std::uint32_t n, Piece& piece) const {
    const auto& t = cells_.tetrahedra()[n];
    const Vec3& origin = place_[t[0]];
    const Vec3 e1 = place_[t[1]] - origin, e2 = place_[t[2]] - origin, e3 = place_[t[3]] - origin;
    const double volume = glm::dot(e1, glm::cross(e2, e3));
    // Gradients of the weights of vertices 0 … 3; their lengths are 1 / the heights.
    std::array<Vec3, 4> gradient{Vec3(0), glm::cross(e2, e3) / volume, glm::cross(e3, e1) / volume,
                                 glm::cross(e1, e2) / volume};
    gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
    piece.thin = false;
    std::array<Vec3, 3> change{Vec3(0), Vec3(0), Vec3(0)};
    for (std::size_t v = 0; v < 4; ++v) {
        const Vec3& g = gradient[v];
        const Vec3 size = glm::abs(g);
        piece.faces.c[v] = (v == 0 ? 1 : 0) - glm::dot(g, origin);
        piece.faces.guard[v] = kGuard * (size.x + size.y + size.z);
        // What changes less than the guard along a whole row does not bound it.
        piece.faces.x[v] = size.x * grid_.x < 1e-3 * piece.faces.guard[v] ? 0 : g.x;
        piece.faces.perX[v] = 1 / g.x;
        piece.faces.y[v] = g.y;
        piece.faces.z[v] = g.z;
        piece.thin = piece.thin || !(glm::length(g) < 1 / kThinnest);
        const Vec3 edge = source_[t[v]] - source_[t[0]];
        for (int a = 0; a < 3; ++a) change[std::size_t(a)] += g[a] * edge;
    }
    const Vec3 start = source_[t[0]] - origin.x * change[0] - origin.y * change[1] - origin.z * change[2];
    const auto numbers = [](const Vec3& v) { return std::array<double, 4>{v.x, v.y, v.z, 0}; };
    piece.places = {numbers(start), numbers(change[0]), numbers(change[1]), numbers(change[2]), {}};
}

void CellRows::addTetrahedron(std::uint32_t n, bool asks, RowBlock& block) const {
    Piece piece;
    if (!boxOf(n, block, piece)) return;
    facesOf(n, piece);
    const Index3 first = piece.first, count = piece.end - first;
    std::array<RowIntervals, RowBlock::kSide> slices;
    intervalsOfRows(piece.faces, first.y, count.y, first.z, grid_.x, std::span(slices).first(std::size_t(count.z)));
    block.setPlaces(piece.places);
    for (int k = piece.first.z; k < piece.end.z; ++k) {
        const RowIntervals& found = slices[std::size_t(k - first.z)];
        const unsigned plain = asks || piece.thin ? 0 : found.plain;
        for (unsigned rows = plain; rows != 0; rows &= rows - 1) {
            const int row = std::countr_zero(rows);
            block.add(first.y + row, k, found.first[std::size_t(row)], found.last[std::size_t(row)], piece.inside);
        }
        for (unsigned rows = found.any & ~plain; rows != 0; rows &= rows - 1) {
            const int row = std::countr_zero(rows);
            addDoubtful(found, std::size_t(row), asks || piece.thin, {first.y + row, k}, piece, block);
        }
    }
}

/// Row `at` of a piece of which some voxels are in doubt, or all.
void CellRows::addDoubtful(const RowIntervals& found, std::size_t row, bool all, Index2 at, const Piece& piece,
                           RowBlock& block) {
    const int from = found.first[row], to = found.last[row], mayFrom = found.mayFirst[row], mayTo = found.mayLast[row];
    if (all || from > to) return block.ask(at[0], at[1], mayFrom, mayTo);
    block.ask(at[0], at[1], mayFrom, from - 1);
    block.ask(at[0], at[1], to + 1, mayTo);
    block.add(at[0], at[1], from, to, piece.inside);
}

void CellRows::addTo(RowBlock& block) const {
    const std::size_t at = blockAt(block.firstRow(), block.firstSlice());
    const auto overlapping = cells_.overlapping();
    const std::uint32_t perCell = cells_.tetrahedraPerCell();
    for (std::uint32_t e = starts_[at]; e < starts_[at + 1]; ++e) {
        const std::uint32_t cell = entries_[e];
        for (std::uint32_t t = perCell * cell; t < perCell * (cell + 1); ++t)
            addTetrahedron(t, overlapping[cell] != 0, block);
    }
}

}  // namespace voledit
