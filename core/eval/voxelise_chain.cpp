#include "core/eval/voxelise_chain.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <glm/matrix.hpp>
#include <optional>

#include "core/base/parallel.h"
#include "core/eval/cell_rows.h"
#include "core/eval/rounded.h"
#include "core/fields/statistics.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

template <class T>
constexpr bool kTaken = std::is_integral_v<T> && sizeof(T) <= 2;

/// One block of rows after the other, by one thread.
template <class T>
class BlockVoxeliser {
public:
    BlockVoxeliser(const ScalarChain& chain, const VoxeliseRequest& request, const CellRows* cells,
                   const ScalarsAt& scalarsAt, std::span<T> out)
        : chain_(chain),
          request_(request),
          cells_(cells),
          scalarsAt_(scalarsAt),
          out_(out),
          size_(request.grid.size),
          block_(size_, chain.volume->grid().size),
          places_(chain.volume->grid().size) {
        const VolumeGrid& grid = chain.volume->grid();
        const VolumeStatistics& values = chain.volume->statistics();
        rows_ = {reinterpret_cast<const T*>(chain.volume->voxels().data()), grid.size, values.max - values.min};
        indexFromVoxel_ = chain.indexFromSource * chain.deformedFromWorld * request.grid.worldFromIndex;
        nothing_ = rounded<T>(request.fill);
    }

    void fill(int j, int k) {
        block_.begin(j, k);
        if (cells_)
            cells_->addTo(block_);
        else
            addWholeRows();
        asked_.clear();
        for (int z = k; z < k + block_.slices(); ++z)
            for (int y = j; y < j + block_.rows(); ++y) fillRow(y, z);
        answer();
    }

private:
    /// Without cells a row is one span.
    void addWholeRows() {
        const Mat4& m = indexFromVoxel_;
        const auto column = [&](int c) { return std::array<double, 4>{m[c].x, m[c].y, m[c].z, 0}; };
        block_.setPlaces({column(3), column(0), column(1), column(2), {}});
        for (int k = block_.firstSlice(); k < block_.firstSlice() + block_.slices(); ++k)
            for (int j = block_.firstRow(); j < block_.firstRow() + block_.rows(); ++j)
                block_.add(j, k, 0, size_.x - 1, false);
    }

    void fillRow(int j, int k) {
        const std::size_t at = (std::size_t(k) * std::size_t(size_.y) + std::size_t(j)) * std::size_t(size_.x);
        const std::span<T> row = out_.subspan(at, std::size_t(size_.x));
        const bool keeps = chain_.cells && chain_.keepsOutside;
        if (!block_.place(j, k, places_)) {
            if (!keeps) return std::fill(row.begin(), row.end(), nothing_);
            places_.clear(row.size());
        }
        if (keeps)
            std::replace(places_.state.begin(), places_.state.begin() + size_.x, std::uint8_t(RowPlaces::Nothing),
                         std::uint8_t(RowPlaces::Ask));
        valuesOfRow(rows_, places_, nothing_, row);
        const std::uint8_t* state = places_.state.data();
        for (int i = 0; i < size_.x; ++i) {
            const void* found = std::memchr(state + i, RowPlaces::Ask, std::size_t(size_.x - i));
            if (!found) return;
            i = int(static_cast<const std::uint8_t*>(found) - state);
            asked_.push_back(at + std::size_t(i));
            points_.push_back(transformPoint(request_.grid.worldFromIndex, Vec3(i, j, k)));
        }
    }

    void answer() {
        values_.resize(points_.size());
        if (!points_.empty()) scalarsAt_(points_, values_);
        for (std::size_t n = 0; n < asked_.size(); ++n) out_[asked_[n]] = rounded<T>(values_[n]);
        points_.clear();
    }

    const ScalarChain& chain_;
    const VoxeliseRequest& request_;
    const CellRows* cells_;
    const ScalarsAt& scalarsAt_;
    std::span<T> out_;
    Index3 size_;
    RowBlock block_;
    RowPlaces places_;
    VoxelRows<T> rows_;
    Mat4 indexFromVoxel_;
    T nothing_;
    std::vector<std::size_t> asked_;
    std::vector<Vec3> points_;
    std::vector<double> values_;
};

template <class T>
std::shared_ptr<const Volume> voxelised(const ScalarChain& chain, const VoxeliseRequest& request,
                                        const ScalarsAt& scalarsAt, Progress* progress) {
    VolumeGrid grid = request.grid;
    grid.channels = 1;
    // Not zeroed first: every voxel is written, by the thread that will have its memory near.
    const std::shared_ptr<T[]> values = std::make_shared_for_overwrite<T[]>(grid.valueCount());
    const std::span<T> out(values.get(), grid.valueCount());
    std::optional<CellRows> cells;
    if (chain.cells)
        cells.emplace(*chain.cells, glm::inverse(chain.deformedFromWorld * grid.worldFromIndex), chain.indexFromSource,
                      grid.size, chain.volume->grid().size);
    constexpr int kSide = RowBlock::kSide;
    const Index3 blocks = (grid.size + (kSide - 1)) / kSide;
    const std::size_t count = std::size_t(blocks.y) * std::size_t(blocks.z);
    std::atomic<std::size_t> done{0};
    parallelFor(count, 8, [&](std::size_t begin, std::size_t end) {
        BlockVoxeliser<T> voxeliser(chain, request, cells ? &*cells : nullptr, scalarsAt, out);
        for (std::size_t b = begin; b < end; ++b)
            voxeliser.fill(int(b % std::size_t(blocks.y)) * kSide, int(b / std::size_t(blocks.y)) * kSide);
        report(progress, double(done += end - begin) / double(count));
    });
    return std::make_shared<const Volume>(grid, request.type, std::as_bytes(out), values,
                                          extremesOf(request.type, std::as_bytes(out), 1));
}

}  // namespace

bool mayVoxeliseChain(const ScalarChain& chain, const VoxeliseRequest& request) {
    const VolumeGrid& grid = chain.volume->grid();
    const std::size_t bytes = chain.volume->voxels().size();
    // Rows are long enough for reads of four bytes, axes for their places, the whole for 32-bit offsets.
    return grid.channels == 1 && request.type == chain.volume->type() &&
           withVoxelType(request.type, [](auto t) { return kTaken<decltype(t)>; }) && grid.size.x >= 8 &&
           std::min(grid.size.y, grid.size.z) >= 2 &&
           std::max({grid.size.x, grid.size.y, grid.size.z}) <= RowPlaces::kMostVoxels && bytes < (1ULL << 31) &&
           request.grid.size.x <= (1 << 20);
}

std::shared_ptr<const Volume> voxeliseChain(const ScalarChain& chain, const VoxeliseRequest& request,
                                            const ScalarsAt& scalarsAt, Progress* progress) {
    return withVoxelType(request.type, [&](auto t) -> std::shared_ptr<const Volume> {
        if constexpr (kTaken<decltype(t)>) return voxelised<decltype(t)>(chain, request, scalarsAt, progress);
        return nullptr;
    });
}

}  // namespace voledit
