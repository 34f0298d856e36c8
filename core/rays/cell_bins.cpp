#include "core/rays/cell_bins.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr std::size_t kDepths = 1024;  // classes of depth, for the order
constexpr double kMargin = 0.02;       // pixels, for rounding

/// Pixel coordinates and depth of a cell's vertices.
struct Extent {
    double minX = kInfinity, minY = kInfinity, maxX = -kInfinity, maxY = -kInfinity;
    double nearest = kInfinity, farthest = -kInfinity;

    void add(const Vec3& projected) {
        nearest = std::min(nearest, projected.z);
        farthest = std::max(farthest, projected.z);
        const double x = projected.x / projected.z, y = projected.y / projected.z;
        minX = std::min(minX, x);
        maxX = std::max(maxX, x);
        minY = std::min(minY, y);
        maxY = std::max(maxY, y);
    }
    PixelBox pixels(Index2 size, double tooNear) const {
        if (!(farthest > 0)) return {};
        // Cells about the eye's plane may be seen anywhere.
        if (!(nearest > tooNear)) return {0, 0, std::int16_t(size.x), std::int16_t(size.y)};
        const auto first = [](double x, int n) {
            return std::int16_t(std::clamp(std::ceil(x - kMargin), 0.0, double(n)));
        };
        const auto end = [](double x, int n) {
            return std::int16_t(std::clamp(std::floor(x + kMargin) + 1, 0.0, double(n)));
        };
        return {first(minX, size.x), first(minY, size.y), end(maxX, size.x), end(maxY, size.y)};
    }
};

/// The order of `class of each` by counting; items of class kDepths are left out.
std::vector<std::uint32_t> ordered(const std::vector<std::uint16_t>& classes) {
    std::vector<std::uint32_t> starts(kDepths + 2, 0);
    for (const std::uint16_t c : classes) ++starts[std::size_t(c) + 1];
    for (std::size_t c = 0; c <= kDepths; ++c) starts[c + 1] += starts[c];
    std::vector<std::uint32_t> order(starts[kDepths]);
    for (std::size_t n = 0; n < classes.size(); ++n)
        if (classes[n] < kDepths) order[starts[classes[n]]++] = std::uint32_t(n);
    return order;
}

template <class Body>
void forTiles(const PixelBox& box, int across, const Body& body) {
    constexpr int tile = CellBins::kTile;
    for (int y = box.firstY / tile; y * tile < box.endY; ++y)
        for (int x = box.firstX / tile; x * tile < box.endX; ++x) body(std::size_t(x + across * y));
}

void sortIntoTiles(CellBins& bins, const std::vector<std::uint32_t>& order) {
    bins.first.assign(std::size_t(bins.tiles.x) * std::size_t(bins.tiles.y) + 1, 0);
    for (const std::uint32_t n : order)
        forTiles(bins.boxes[n], bins.tiles.x, [&](std::size_t t) { ++bins.first[t + 1]; });
    for (std::size_t t = 1; t < bins.first.size(); ++t) bins.first[t] += bins.first[t - 1];
    bins.which.resize(bins.first.back());
    std::vector<std::uint32_t> next(bins.first.begin(), bins.first.end() - 1);
    for (const std::uint32_t n : order)
        forTiles(bins.boxes[n], bins.tiles.x, [&](std::size_t t) { bins.which[next[t]++] = n; });
}

}  // namespace

CellBins makeCellBins(const PacketCells& cells, const CellView& view, Index2 size) {
    CellBins bins;
    bins.tiles = (size + CellBins::kTile - 1) / CellBins::kTile;
    bins.boxes.resize(cells.cells.size());
    const Mat3 pixelsFromCells = glm::inverse(Mat3(view.right, view.down, view.forward));
    std::vector<Vec3> projected(cells.position.size());
    parallelFor(projected.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) projected[v] = pixelsFromCells * (cells.position[v] - view.eye);
    });
    double nearest = kInfinity, farthest = 0;
    for (int c = 0; c < 8 && !cells.bounds.empty(); ++c) {
        const double depth = (pixelsFromCells * (cells.bounds.corner(c) - view.eye)).z;
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    bins.nearest = cells.bounds.empty() ? 0 : std::max(nearest, 0.0);
    const double scale = kDepths / std::max(farthest - bins.nearest, 1e-300), tooNear = 1e-6 * farthest;
    std::vector<std::uint16_t> classes(bins.boxes.size());
    parallelFor(classes.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            Extent extent;
            for (const std::uint32_t v : cells.corners[n]) extent.add(projected[v]);
            const PixelBox box = bins.boxes[n] = extent.pixels(size, tooNear);
            const bool seen = box.firstX < box.endX && box.firstY < box.endY;
            const double depth = (extent.nearest - bins.nearest) * scale;
            classes[n] = std::uint16_t(seen ? std::clamp(depth, 0.0, double(kDepths - 1)) : kDepths);
        }
    });
    sortIntoTiles(bins, ordered(classes));
    return bins;
}

}  // namespace voledit
