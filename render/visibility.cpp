#include "render/visibility.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

constexpr int kSide = BrickRanges::kSide;

struct Range {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();
    // NaN compares false both times, hence never counts.
    void take(float v) {
        low = v < low ? v : low;
        high = v > high ? v : high;
    }
    void take(const Range& r) {
        low = std::min(low, r.low);
        high = std::max(high, r.high);
    }
};

/// Ranges of the bricks along one row of voxels, overlapping as BrickRanges says, joined into `row`.
template <class T>
void rangesOfRow(const T* voxels, std::size_t channels, int n, std::vector<Range>& row) {
    for (std::size_t b = 0; b < row.size(); ++b) {
        const int first = std::max(int(b) * kSide - 1, 0), last = std::min(int(b + 1) * kSide + 1, n - 1);
        Range range = row[b];
        for (int i = first; i <= last; ++i) range.take(float(voxels[std::size_t(i) * channels]));
        row[b] = range;
    }
}

/// Ranges of all bricks of layer k.
template <class T>
void rangesOfLayer(const Volume& volume, int channel, int k, T, BrickRanges& result) {
    const VolumeGrid& grid = volume.grid();
    const T* voxels = reinterpret_cast<const T*>(volume.voxels().data()) + channel;
    const std::size_t channels = std::size_t(grid.channels), width = std::size_t(grid.size.x) * channels;
    const int firstZ = std::max(k * kSide - 1, 0), lastZ = std::min((k + 1) * kSide + 1, grid.size.z - 1);
    // Every row is read once: its ranges serve the two layers of bricks that overlap in it.
    std::vector<std::vector<Range>> rows(std::size_t(grid.size.y), std::vector<Range>(std::size_t(result.bricks.x)));
    for (int z = firstZ; z <= lastZ; ++z)
        for (int y = 0; y < grid.size.y; ++y)
            rangesOfRow(voxels + (std::size_t(z) * std::size_t(grid.size.y) + std::size_t(y)) * width, channels,
                        grid.size.x, rows[std::size_t(y)]);
    for (int j = 0; j < result.bricks.y; ++j)
        for (int i = 0; i < result.bricks.x; ++i) {
            Range range;
            for (int y = std::max(j * kSide - 1, 0); y <= std::min((j + 1) * kSide + 1, grid.size.y - 1); ++y)
                range.take(rows[std::size_t(y)][std::size_t(i)]);
            const std::size_t at =
                std::size_t(i) +
                std::size_t(result.bricks.x) * (std::size_t(j) + std::size_t(result.bricks.y) * std::size_t(k));
            result.low[at] = range.low;
            result.high[at] = range.high;
        }
}

}  // namespace

BrickRanges brickRanges(const Volume& volume, int channel) {
    BrickRanges result;
    const Index3 size = volume.grid().size;
    for (int a = 0; a < 3; ++a) result.bricks[a] = std::max((size[a] - 1 + kSide - 1) / kSide, 1);
    const std::size_t count =
        std::size_t(result.bricks.x) * std::size_t(result.bricks.y) * std::size_t(result.bricks.z);
    result.low.resize(count);
    result.high.resize(count);
    parallelFor(std::size_t(result.bricks.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            withVoxelType(volume.type(), [&](auto t) { rangesOfLayer(volume, channel, int(k), t, result); });
    });
    double low = kInfinity, high = -kInfinity;
    for (std::size_t n = 0; n < count; ++n) {
        if (std::isfinite(result.low[n])) low = std::min(low, double(result.low[n]));
        if (std::isfinite(result.high[n])) high = std::max(high, double(result.high[n]));
    }
    if (low <= high) {
        result.min = low;
        result.max = high;
    }
    return result;
}

Visibility::Visibility(const BrickRanges& ranges, const TransferTable& table) : bricks_(ranges.bricks) {
    const auto at = [&](int i, int j, int k) {
        return std::size_t(i) +
               std::size_t(bricks_.x + 1) * (std::size_t(j) + std::size_t(bricks_.y + 1) * std::size_t(k));
    };
    sums_.assign(at(0, 0, bricks_.z + 1), 0);
    std::size_t n = 0;
    for (int k = 0; k < bricks_.z; ++k)
        for (int j = 0; j < bricks_.y; ++j) {
            int row = 0;
            for (int i = 0; i < bricks_.x; ++i, ++n) {
                row += ranges.low[n] <= ranges.high[n] && table.visible(ranges.low[n], ranges.high[n]);
                sums_[at(i + 1, j + 1, k + 1)] =
                    row + sums_[at(i + 1, j, k + 1)] + sums_[at(i + 1, j + 1, k)] - sums_[at(i + 1, j, k)];
            }
        }
}

bool Visibility::visible(const Box3& box) const {
    if (sums_.empty()) return true;
    Index3 first, end;
    for (int a = 0; a < 3; ++a) {
        first[a] = int(std::clamp(std::floor(box.min[a] / kSide), 0.0, double(bricks_[a] - 1)));
        end[a] = int(std::clamp(std::ceil(box.max[a] / kSide), first[a] + 1.0, double(bricks_[a])));
    }
    const auto sum = [&](int i, int j, int k) {
        return sums_[std::size_t(i) +
                     std::size_t(bricks_.x + 1) * (std::size_t(j) + std::size_t(bricks_.y + 1) * std::size_t(k))];
    };
    const int inFront = sum(end.x, end.y, first.z) - sum(first.x, end.y, first.z) - sum(end.x, first.y, first.z) +
                        sum(first.x, first.y, first.z);
    const int atBack = sum(end.x, end.y, end.z) - sum(first.x, end.y, end.z) - sum(end.x, first.y, end.z) +
                       sum(first.x, first.y, end.z);
    return atBack > inFront;
}

}  // namespace voledit
