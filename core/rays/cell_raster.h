#pragma once
// The cells of a tile drawn into lists of what each of its rays passes.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/rays/cell_bins.h"

namespace voledit {

/// The rays of a tile's pixels in cell space: pixel (x, y), counted from the tile's first, passes
/// base[0] + x · base[1] + y · base[2] + t · (along[0] + x · along[1] + y · along[2]) for t ≥ 0.
struct TileRays {
    static constexpr std::size_t kPixels = std::size_t(CellBins::kTile) * CellBins::kTile;
    Index2 first, end;  // pixels of the picture; within one tile
    std::array<std::array<float, 3>, 3> base{}, along{};
    alignas(64) std::array<float, kPixels> steps{};  // in t = 1, at x + kTile · y
};

/// What each ray of a tile passes.
class HitLists {
public:
    void clear() { counts_.fill(0); }
    void add(std::size_t pixel, const CellHit& hit) {
        if (counts_[pixel] == capacity_) grow();
        hits_[pixel * capacity_ + counts_[pixel]++] = hit;
    }
    /// Keeps `first` only, which begins where of(pixel) does.
    void shorten(std::size_t pixel, std::span<CellHit> first) { counts_[pixel] = std::uint32_t(first.size()); }
    std::span<CellHit> of(std::size_t pixel) { return {hits_.data() + pixel * capacity_, counts_[pixel]}; }

private:
    void grow();

    std::size_t capacity_ = 32;
    std::vector<CellHit> hits_ = std::vector<CellHit>(TileRays::kPixels * 32);
    std::array<std::uint32_t, TileRays::kPixels> counts_{};
};

/// Appends to `hits` where the rays of a tile pass the cells of `bins` there, in the cells' order.
void rasterCells(const PacketCells& cells, const CellBins& bins, const TileRays& rays, HitLists& hits);

}  // namespace voledit
