#include "core/eval/cell_rows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

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

/// Voxels of a span whose samples lie within `reach` of a volume's.
Index2 near(const VoxelSpan& span, const Index3& samples, double reach) {
    Index2 range(span.first, span.last);
    for (std::size_t a = 0; a < 3 && range[0] <= range[1]; ++a)
        range = within(span.start[a], span.step[a], -reach, samples[int(a)] - 1 + reach, range);
    return range;
}

bool holds(const VoxelSpan& span, const Index3& samples) {
    for (std::size_t a = 0; a < 3; ++a)
        for (const int i : {span.first, span.last}) {
            const double at = span.start[a] + i * span.step[a];
            if (!(at >= -kInside && at <= samples[int(a)] - 1 + kInside)) return false;
        }
    return true;
}

}  // namespace

RowBlock::RowBlock(const Index3& grid, const Index3& samples)
    : grid_(grid), samples_(samples), row_(kSide * kSide), spanAt_(row_.size() * std::size_t(grid.x)) {}

void RowBlock::begin(int j, int k) {
    j_ = j;
    k_ = k;
    rows_ = std::min(kSide, grid_.y - j);
    slices_ = std::min(kSide, grid_.z - k);
    spans_.clear();
    for (Row& row : row_) {
        row.spans = 0;
        row.asks.clear();
    }
    std::fill(spanAt_.begin(), spanAt_.end(), 0);
}

void RowBlock::ask(int j, int k, int first, int last) {
    auto& asks = row_[numberOf(j, k)].asks;
    for (int i = first; i <= last; ++i) asks.push_back(i);
}

void RowBlock::add(int j, int k, VoxelSpan span) {
    if (!holds(span, samples_)) {
        const Index2 sure = near(span, samples_, kInside), may = near(span, samples_, kOutside);
        if (sure[0] > sure[1]) return ask(j, k, may[0], may[1]);
        ask(j, k, may[0], sure[0] - 1);
        ask(j, k, sure[1] + 1, may[1]);
        span.first = sure[0];
        span.last = sure[1];
    }
    const std::size_t row = numberOf(j, k);
    spans_.push_back(span);
    spanAt_[row * std::size_t(grid_.x) + std::size_t(span.first)] = std::uint32_t(spans_.size());
    ++row_[row].spans;
}

bool RowBlock::place(int j, int k, RowPlaces& places, int& slice) {
    const Row& row = row_[numberOf(j, k)];
    places.clear(std::size_t(grid_.x));
    const std::uint32_t* at = spanAt_.data() + numberOf(j, k) * std::size_t(grid_.x);
    double lowest = samples_.z - 2;
    for (int i = 0, left = row.spans; i < grid_.x && left > 0;) {
        if (at[i] == 0) {
            ++i;
            continue;
        }
        const VoxelSpan& span = spans_[at[i] - 1];
        placeSpan(span, samples_, places);
        lowest =
            std::min({lowest, span.start[2] + span.first * span.step[2], span.start[2] + span.last * span.step[2]});
        i = span.last + 1;
        --left;
    }
    slice = std::max(int(lowest - 1e-3), 0);
    for (const std::int32_t i : row.asks) places.state[std::size_t(i)] = RowPlaces::Ask;
    return row.spans > 0 || !row.asks.empty();
}

// ---- Tetrahedra ---------------------------------------------------------------------------------------------------

/// A tetrahedron over the grid.
struct CellRows::Piece {
    Index3 first, last;  // voxels that it may hold
    bool thin;
    HalfSpaces faces;
    Vec3 source;                 // where the voxel (0, 0, 0) would have its sample
    std::array<Vec3, 3> change;  // of that along i, j, k
};

CellRows::CellRows(const MappedCells& cells, const Mat4& gridFromDeformed, const Mat4& indexFromSource,
                   const Index3& grid)
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

/// False where the tetrahedron is degenerate or holds no voxel.
bool CellRows::pieceOf(std::uint32_t n, Piece& piece) const {
    if (cells_.determinants()[n] == 0) return false;
    const auto& t = cells_.tetrahedra()[n];
    const Vec3& origin = place_[t[0]];
    Box3 box;
    for (const std::uint32_t v : t) box = join(box, place_[v]);
    for (int a = 0; a < 3; ++a) {
        piece.first[a] = int(std::clamp(std::ceil(box.min[a] - 0.01), 0.0, double(grid_[a])));
        piece.last[a] = int(std::clamp(std::floor(box.max[a] + 0.01), -1.0, double(grid_[a] - 1)));
        if (piece.first[a] > piece.last[a]) return false;
    }
    const Vec3 e1 = place_[t[1]] - origin, e2 = place_[t[2]] - origin, e3 = place_[t[3]] - origin;
    const double volume = glm::dot(e1, glm::cross(e2, e3));
    // Gradients of the weights of vertices 0 … 3; their lengths are 1 / the heights.
    std::array<Vec3, 4> gradient{Vec3(0), glm::cross(e2, e3) / volume, glm::cross(e3, e1) / volume,
                                 glm::cross(e1, e2) / volume};
    gradient[0] = -(gradient[1] + gradient[2] + gradient[3]);
    piece.thin = false;
    piece.change = {Vec3(0), Vec3(0), Vec3(0)};
    for (std::size_t v = 0; v < 4; ++v) {
        const Vec3& g = gradient[v];
        const Vec3 size = glm::abs(g);
        piece.faces.c[v] = (v == 0 ? 1 : 0) - glm::dot(g, origin);
        piece.faces.guard[v] = kGuard * (size.x + size.y + size.z);
        // What changes less than the guard along a whole row does not bound it.
        piece.faces.x[v] = size.x * grid_.x < 1e-3 * piece.faces.guard[v] ? 0 : g.x;
        piece.faces.y[v] = g.y;
        piece.faces.z[v] = g.z;
        piece.thin = piece.thin || !(glm::length(g) < 1 / kThinnest);
        const Vec3 edge = source_[t[v]] - source_[t[0]];
        for (int a = 0; a < 3; ++a) piece.change[std::size_t(a)] += g[a] * edge;
    }
    piece.source = source_[t[0]];
    for (int a = 0; a < 3; ++a) piece.source -= origin[a] * piece.change[std::size_t(a)];
    return true;
}

void CellRows::addTetrahedron(std::uint32_t n, bool asks, RowBlock& block) const {
    Piece piece;
    if (!pieceOf(n, piece)) return;
    const int firstJ = std::max(piece.first.y, block.firstRow());
    const int endJ = std::min(piece.last.y + 1, block.firstRow() + block.rows());
    const int firstK = std::max(piece.first.z, block.firstSlice());
    const int endK = std::min(piece.last.z + 1, block.firstSlice() + block.slices());
    if (firstJ >= endJ) return;
    RowIntervals found;
    for (int k = firstK; k < endK; ++k) {
        intervalsOfRows(piece.faces, firstJ, endJ - firstJ, k, grid_.x, found);
        for (int j = firstJ; j < endJ; ++j) {
            const auto row = std::size_t(j - firstJ);
            const int first = found.first[row], last = found.last[row];
            const int mayFirst = found.mayFirst[row], mayLast = found.mayLast[row];
            if (mayFirst > mayLast) continue;
            if (asks || piece.thin || first > last) {
                block.ask(j, k, mayFirst, mayLast);
                continue;
            }
            if (mayFirst < first) block.ask(j, k, mayFirst, first - 1);
            if (last < mayLast) block.ask(j, k, last + 1, mayLast);
            const Vec3 start = piece.source + double(j) * piece.change[1] + double(k) * piece.change[2];
            const Vec3& step = piece.change[0];
            block.add(j, k, {{start.x, start.y, start.z}, {step.x, step.y, step.z}, first, last});
        }
    }
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
