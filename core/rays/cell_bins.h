#pragma once
// Which cells each tile of a picture sees.

#include <cstdint>
#include <span>
#include <vector>

#include "core/rays/packet_cells.h"

namespace voledit {

/// Pixels [first, end); empty where first ≥ end on an axis.
struct PixelBox {
    std::int16_t firstX = 0, firstY = 0, endX = 0, endY = 0;
};

/// Cells by square tiles of kTile pixels, the nearest first but for a little: lists that hardly need sorting.
struct CellBins {
    static constexpr int kTile = 16;
    Index2 tiles{0};
    std::vector<PixelBox> boxes;       // pixels of each cell
    std::vector<std::uint32_t> first;  // of each tile in `which`, and the end of the last
    std::vector<std::uint32_t> which;  // cells
    double nearest = 0;                // depth before which no cell lies, in lengths of `forward`; ≥ 0

    std::span<const std::uint32_t> at(Index2 tile) const {
        const auto n = std::size_t(tile.x) + std::size_t(tiles.x) * std::size_t(tile.y);
        return std::span(which).subspan(first[n], first[n + 1] - first[n]);
    }
};

/// The rays of pixel centres in the space of the deformed cells: eye + t · (forward + x · right + y · down).
struct CellView {
    Vec3 eye, forward, right, down;
};

/// Bins for a picture of `size` pixels, each side below 32,768.
CellBins makeCellBins(const PacketCells& cells, const CellView& view, Index2 size);

}  // namespace voledit
