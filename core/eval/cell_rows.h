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

    /// Says where voxels have their samples, for spans to come.
    void setPlaces(const SamplePlaces& places);
    /// Adds voxels first … last of row (j, k): those with samples inside the volume become a span, those at its faces
    /// are asked for, those outside are nothing. `inside`: all are known to have theirs inside.
    void add(int j, int k, int first, int last, bool inside) {
        const VoxelSpan span{current_, first, last};
        if (inside || holds(j, k, span))
            addInside(j, k, span);
        else
            addPart(j, k, span);
    }
    /// Voxels first … last of row (j, k) are to be asked for.
    void ask(int j, int k, int first, int last);

    /// What is known of a row, as places; it is forgotten here. False where nothing is in it.
    bool place(int j, int k, RowPlaces& places);

private:
    struct Row {
        bool spans = false;
        std::vector<std::int32_t> asks;
    };
    struct Beginning {
        std::uint32_t places = 0;  // number + 1; 0: none begins here
        std::int32_t last = 0;
    };
    void addInside(int j, int k, const VoxelSpan& span) {
        const std::size_t row = numberOf(j, k);
        beginning_[row * std::size_t(grid_.x) + std::size_t(span.first)] = {span.places + 1, span.last};
        row_[row].spans = true;
    }
    bool holds(int j, int k, const VoxelSpan& span) const;
    void addPart(int j, int k, VoxelSpan span);
    std::size_t numberOf(int j, int k) const { return std::size_t((k - k_) * kSide + j - j_); }

    Index3 grid_, samples_;
    int j_ = 0, k_ = 0, rows_ = 0, slices_ = 0;
    std::vector<Row> row_;
    double unit_;                       // of RowPlaces, voxels
    std::vector<SamplePlaces> places_;  // in units
    std::uint32_t current_ = 0;         // the last one
    std::vector<VoxelSpan> ofRow_;
    std::vector<Beginning> beginning_;  // of a span at each voxel
};

/// Cells' tetrahedra over the rows of a grid.
class CellRows {
public:
    /// @param gridFromDeformed  to the grid's indices; @param indexFromSource  to the volume's. `cells` must live on.
    /// @param samples  the volume's size
    CellRows(const MappedCells& cells, const Mat4& gridFromDeformed, const Mat4& indexFromSource, const Index3& grid,
             const Index3& samples);

    /// Adds to a block, which begins at a multiple of its side, what lies in it.
    void addTo(RowBlock& block) const;

private:
    struct Piece;
    void findInside(const Vec3& lastSample);
    bool boxOf(std::uint32_t tetrahedron, const RowBlock& block, Piece& piece) const;
    void facesOf(std::uint32_t tetrahedron, Piece& piece) const;
    static void addDoubtful(const RowIntervals& found, std::size_t row, bool all, Index2 at, const Piece& piece,
                            RowBlock& block);
    void addTetrahedron(std::uint32_t tetrahedron, bool asks, RowBlock& block) const;
    std::size_t blockAt(int j, int k) const {
        return std::size_t(k / RowBlock::kSide) * blocksAlong_ + std::size_t(j / RowBlock::kSide);
    }

    const MappedCells& cells_;
    Index3 grid_;
    std::vector<char> inside_;            // of the cells: 1 where all samples lie in the volume
    std::vector<Vec3> place_, source_;    // of the vertices: indices of the grid, of the volume
    std::size_t blocksAlong_;             // along j
    std::vector<std::uint32_t> starts_;   // of each block's list in entries_; one more at the end
    std::vector<std::uint32_t> entries_;  // cells
};

}  // namespace voledit
