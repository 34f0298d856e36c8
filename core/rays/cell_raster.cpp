#include "core/rays/cell_raster.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/rays/cell_raster.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

#include "core/rays/packet_caster.h"
#include "core/rays/packet_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

constexpr std::size_t kMostPlanes = 10;

/// The planes of a cell over a tile: at pixel (x, y) the value at t = 0 is at[0] + x · at[1] + y · at[2], and it grows
/// by along[0] + x · along[1] + y · along[2] for each t.
struct TilePlanes {
    alignas(16) float at[3][kMostPlanes + 2], along[3][kMostPlanes + 2];
    std::size_t count = 4;
};

HWY_INLINE void projectPlanes(const PacketCell& cell, const TileRays& rays, TilePlanes& planes) {
    const Quad x = quad(cell.plane[0]), y = quad(cell.plane[1]), z = quad(cell.plane[2]), w = quad(cell.plane[3]);
    const auto dot = [&](const std::array<float, 3>& v) HWY_ATTR { return x * v[0] + y * v[1] + z * v[2]; };
    const auto store = [](Quad value, float* to) HWY_ATTR { std::memcpy(to, &value, sizeof value); };
    store(dot(rays.base[0]) + w, planes.at[0]);
    store(dot(rays.base[1]), planes.at[1]);
    store(dot(rays.base[2]), planes.at[2]);
    for (std::size_t n = 0; n < 3; ++n) store(dot(rays.along[n]), planes.along[n]);
    planes.count = 4;
}

/// Planes where the cell leaves the volume's domain.
void addSides(const PacketCell& cell, unsigned sides, const std::array<float, 3>& last, const TileRays& rays,
              TilePlanes& planes) {
    for (std::size_t side = 0; side < 6; ++side) {
        if (!(sides >> side & 1U)) continue;
        const std::size_t a = side / 2, n = planes.count++;
        const float sign = side % 2 ? -1.F : 1.F;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto dot = [&](const std::array<float, 3>& v) {
                return sign * (cell.index[0][a] * v[0] + cell.index[1][a] * v[1] + cell.index[2][a] * v[2]);
            };
            planes.at[k][n] = dot(rays.base[k]);
            planes.along[k][n] = dot(rays.along[k]);
        }
        planes.at[0][n] += sign * cell.index[3][a] + (side % 2 ? last[a] : 0.F);
    }
}

void rasterCellsHere(const PacketCells& cells, const CellBins& bins, const TileRays& rays, HitLists& hits) {
    const Index2 shape = packetShape();
    alignas(64) float offsetX[RayPacket::kMost], offsetY[RayPacket::kMost];
    for (int l = 0; l < shape.x * shape.y; ++l) {
        offsetX[l] = float(l % shape.x);
        offsetY[l] = float(l / shape.x);
    }
    const Real laneX = load(offsetX), laneY = load(offsetY);
    alignas(64) std::array<float, RayPacket::kMost> begin, end;
    const Index2 tile = rays.first / CellBins::kTile;
    TilePlanes planes;
    for (const std::uint32_t n : bins.at(tile)) {
        const PixelBox& box = bins.boxes[n];
        const Index2 from(std::max(int(box.firstX), rays.first.x) - rays.first.x,
                          std::max(int(box.firstY), rays.first.y) - rays.first.y);
        const Index2 to(std::min(int(box.endX), rays.end.x) - rays.first.x,
                        std::min(int(box.endY), rays.end.y) - rays.first.y);
        if (from.x >= to.x || from.y >= to.y) continue;
        projectPlanes(cells.cells[n], rays, planes);
        if (HWY_UNLIKELY(cells.beyond[n] != 0)) addSides(cells.cells[n], cells.beyond[n], cells.last, rays, planes);
        for (int py = from.y / shape.y * shape.y; py < to.y; py += shape.y)
            for (int px = from.x / shape.x * shape.x; px < to.x; px += shape.x) {
                const Real x = hn::Add(laneX, real(float(px))), y = hn::Add(laneY, real(float(py)));
                Real near = hn::Zero(F()), far = real(1e30F);
                for (std::size_t v = 0; v < planes.count; ++v) {
                    const Real value = hn::Add(hn::Add(real(planes.at[0][v]), hn::Mul(x, real(planes.at[1][v]))),
                                               hn::Mul(y, real(planes.at[2][v])));
                    const Real slope = hn::Add(hn::Add(real(planes.along[0][v]), hn::Mul(x, real(planes.along[1][v]))),
                                               hn::Mul(y, real(planes.along[2][v])));
                    const Mask flat = hn::Eq(slope, hn::Zero(F()));
                    const Real t = hn::Div(value, hn::IfThenElse(flat, real(-1e-30F), hn::Neg(slope)));
                    const Mask entering = hn::Or(flat, hn::Gt(slope, hn::Zero(F())));
                    near = hn::IfThenElse(entering, hn::Max(near, t), near);
                    far = hn::IfThenElse(entering, far, hn::Min(far, t));
                }
                const std::uint32_t met = bitsOf(hn::Lt(near, far));
                if (!met) continue;
                hn::Store(near, F(), begin.data());
                hn::Store(far, F(), end.data());
                forLanes(met, [&](std::size_t l) {
                    const int lx = px + int(l) % shape.x, ly = py + int(l) / shape.x;
                    const auto pixel = std::size_t(lx + CellBins::kTile * ly);
                    hits.add(pixel, {begin[l] * rays.steps[pixel], end[l] * rays.steps[pixel], n});
                });
            }
    }
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voledit {

HWY_EXPORT(rasterCellsHere);

void HitLists::grow() {
    std::vector<CellHit> hits(2 * hits_.size());
    for (std::size_t pixel = 0; pixel < counts_.size(); ++pixel)
        std::copy_n(hits_.begin() + std::ptrdiff_t(pixel * capacity_), counts_[pixel],
                    hits.begin() + std::ptrdiff_t(2 * pixel * capacity_));
    hits_ = std::move(hits);
    capacity_ *= 2;
}

void rasterCells(const PacketCells& cells, const CellBins& bins, const TileRays& rays, HitLists& hits) {
    HWY_DYNAMIC_DISPATCH(rasterCellsHere)(cells, bins, rays, hits);
}

}  // namespace voledit
#endif
