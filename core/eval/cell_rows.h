#pragma once
// Which voxels of a grid lie in which tetrahedra: spans of rows, a block of rows at a time.

#include <span>
#include <vector>

#include "core/eval/scalar_chain.h"
#include "core/eval/voxel_kernels.h"

namespace voledit {

/// Rows j … j + kSide − 1 of slices k … k + kSide − 1 of a grid, with what is known of their voxels.
class RowBlock {
public:
    static constexpr int kSide = RowIntervals::kRows;

    /// @param samples  size of the volume whose samples are looked up
    RowBlock(const Index3& grid, const Index3& samples);

    /// Begins anew at (j, k), empty.
    void begin(int j, int k);
    int firstRow() const { return j_; }
    int firstSlice() const { return k_; }
    int rows() const { return rows_; }      // along j
    int slices() const { return slices_; }  // along k

    /// Adds voxels first … last of row (j, k) with samples at `start` + i · `step`: those inside the volume become
    /// spans, those at its faces asked for, those outside nothing.
    void add(int j, int k, VoxelSpan span);
    /// Voxels first … last of row (j, k) are to be asked for.
    void ask(int j, int k, int first, int last);

    /// The spans of a row, from left to right, as places; false where there is none. `slice`: the lowest that they
    /// touch.
    bool place(int j, int k, RowPlaces& places, int& slice);

private:
    struct Row {
        int spans = 0;
        std::vector<std::int32_t> asks;
    };
    std::size_t numberOf(int j, int k) const { return std::size_t((k - k_) * kSide + j - j_); }

    Index3 grid_, samples_;
    int j_ = 0, k_ = 0, rows_ = 0, slices_ = 0;
    std::vector<Row> row_;
    std::vector<VoxelSpan> spans_;
    std::vector<std::uint32_t> spanAt_;  // number + 1 of the span that begins at a voxel, 0 for none
};

/// Cells' tetrahedra over the rows of a grid.
class CellRows {
public:
    /// @param gridFromDeformed  to the grid's indices; @param indexFromSource  to the volume's. `cells` must live on.
    CellRows(const MappedCells& cells, const Mat4& gridFromDeformed, const Mat4& indexFromSource, const Index3& grid);

    /// Adds to a block, which begins at a multiple of its side, what lies in it.
    void addTo(RowBlock& block) const;

private:
    struct Piece;
    bool pieceOf(std::uint32_t tetrahedron, Piece& piece) const;
    void addTetrahedron(std::uint32_t tetrahedron, bool asks, RowBlock& block) const;
    std::size_t blockAt(int j, int k) const {
        return std::size_t(k / RowBlock::kSide) * blocksAlong_ + std::size_t(j / RowBlock::kSide);
    }

    const MappedCells& cells_;
    Index3 grid_;
    std::vector<Vec3> place_, source_;    // of the vertices: indices of the grid, of the volume
    std::size_t blocksAlong_;             // along j
    std::vector<std::uint32_t> starts_;   // of each block's list in entries_; one more at the end
    std::vector<std::uint32_t> entries_;  // cells
};

}  // namespace voledit
