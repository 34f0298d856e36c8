#include "core/fields/reduced_volume.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/base/parallel.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

VolumeGrid reducedGrid(const VolumeGrid& grid, const Index3& box) {
    VolumeGrid reduced = grid;
    reduced.size = grid.size / box;
    for (int a = 0; a < 3; ++a) {
        reduced.worldFromIndex[3] += (box[a] - 1) / 2.0 * grid.worldFromIndex[a];
        reduced.worldFromIndex[a] *= double(box[a]);
    }
    return reduced;
}

/// Adds each box's values of one row of samples to its sums.
template <class T>
void addRow(const T* row, int channels, int box, std::span<double> sums) {
    for (std::size_t at = 0; at < sums.size(); at += std::size_t(channels))
        for (int i = 0; i < box; ++i)
            for (int c = 0; c < channels; ++c) sums[at + std::size_t(c)] += double(*row++);
}

}  // namespace

std::shared_ptr<const Volume> reducedVolume(const Volume& volume, const Index3& box) {
    const VolumeGrid& from = volume.grid();
    assert(box.x >= 1 && box.y >= 1 && box.z >= 1 && box.x <= from.size.x && box.y <= from.size.y &&
           box.z <= from.size.z);
    const VolumeGrid to = reducedGrid(from, box);
    return withVoxelType(volume.type(), [&](auto t) {
        using T = decltype(t);
        const T* voxels = reinterpret_cast<const T*>(volume.voxels().data());
        const auto sourceRow = std::size_t(from.size.x) * std::size_t(from.channels);
        const auto row = std::size_t(to.size.x) * std::size_t(to.channels);
        const double count = double(box.x) * box.y * box.z;
        std::vector<T> values(to.valueCount());
        parallelFor(std::size_t(to.size.y) * std::size_t(to.size.z), 16, [&](std::size_t begin, std::size_t end) {
            std::vector<double> sums(row);
            for (std::size_t n = begin; n < end; ++n) {
                std::fill(sums.begin(), sums.end(), 0.0);
                const std::size_t j = n % std::size_t(to.size.y), k = n / std::size_t(to.size.y);
                for (std::size_t z = k * std::size_t(box.z); z < (k + 1) * std::size_t(box.z); ++z)
                    for (std::size_t y = j * std::size_t(box.y); y < (j + 1) * std::size_t(box.y); ++y)
                        addRow(voxels + (z * std::size_t(from.size.y) + y) * sourceRow, from.channels, box.x, sums);
                for (std::size_t i = 0; i < row; ++i)
                    values[n * row + i] = std::is_integral_v<T> ? T(std::round(sums[i] / count)) : T(sums[i] / count);
            }
        });
        return Volume::fromValues(to, std::move(values));
    });
}

}  // namespace voledit
