#include "core/fields/value_bricks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

constexpr int kSide = ValueBricks::kSide;

template <class T>
struct Range {
    T low = std::numeric_limits<T>::max(), high = std::numeric_limits<T>::lowest();
    bool any = false;

    // Written so that a NaN changes nothing and the compiler needs no branch.
    void take(T v) {
        low = v < low ? v : low;
        high = v > high ? v : high;
        any = any || v == v;
    }
    void take(const Range& r) {
        low = std::min(low, r.low);
        high = std::max(high, r.high);
        any = any || r.any;
    }
};

float below(double v) {
    const float f = static_cast<float>(v);
    return double(f) > v ? std::nextafter(f, -INFINITY) : f;
}
float above(double v) {
    const float f = static_cast<float>(v);
    return double(f) < v ? std::nextafter(f, INFINITY) : f;
}

/// Samples of brick b along an axis of n: the first, and one past the last.
Index2 samplesOf(int b, int margin, int n) {
    return {std::max(b * kSide - margin, 0), std::min((b + 1) * kSide + margin, n - 1) + 1};
}

/// Ranges along the rows of voxels of one slice z, joined into `rows` [y][brick].
template <class T>
void takeSlice(const VolumeGrid& grid, const T* slice, int margin, std::vector<Range<T>>& rows, int bricks) {
    const auto channels = std::size_t(grid.channels);
    for (int y = 0; y < grid.size.y; ++y) {
        const T* row = slice + std::size_t(y) * std::size_t(grid.size.x) * channels;
        for (int b = 0; b < bricks; ++b) {
            Range<T> range = rows[std::size_t(y * bricks + b)];
            const Index2 samples = samplesOf(b, margin, grid.size.x);
            for (int i = samples[0]; i < samples[1]; ++i) range.take(row[std::size_t(i) * channels]);
            rows[std::size_t(y * bricks + b)] = range;
        }
    }
}

template <class T>
void fillLayer(const VolumeGrid& grid, const T* voxels, int margin, int k, ValueBricks& result) {
    std::vector<Range<T>> rows(std::size_t(grid.size.y) * std::size_t(result.count.x));
    const std::size_t slice = std::size_t(grid.size.x) * std::size_t(grid.size.y) * std::size_t(grid.channels);
    const Index2 slices = samplesOf(k, margin, grid.size.z);
    for (int z = slices[0]; z < slices[1]; ++z)
        takeSlice(grid, voxels + std::size_t(z) * slice, margin, rows, result.count.x);
    for (int j = 0; j < result.count.y; ++j)
        for (int i = 0; i < result.count.x; ++i) {
            Range<T> range;
            const Index2 samples = samplesOf(j, margin, grid.size.y);
            for (int y = samples[0]; y < samples[1]; ++y) range.take(rows[std::size_t(y * result.count.x + i)]);
            const std::size_t at = result.indexOf({i, j, k});
            result.low[at] = range.any ? below(double(range.low)) : INFINITY;
            result.high[at] = range.any ? above(double(range.high)) : -INFINITY;
        }
}

}  // namespace

ValueBricks makeValueBricks(const Volume& volume, int channel, int margin) {
    ValueBricks result;
    const VolumeGrid& grid = volume.grid();
    for (int a = 0; a < 3; ++a) result.count[a] = std::max((grid.size[a] - 1 + kSide - 1) / kSide, 1);
    result.low.resize(result.indexOf({0, 0, result.count.z}));
    result.high.resize(result.low.size());
    withVoxelType(volume.type(), [&](auto t) {
        const auto* voxels = reinterpret_cast<const decltype(t)*>(volume.voxels().data()) + channel;
        parallelFor(std::size_t(result.count.z), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) fillLayer(grid, voxels, margin, int(k), result);
        });
    });
    return result;
}

Interval rangeWithin(const Volume& volume, int channel, Interpolation interpolation, const Box3& box) {
    const ValueBricks& bricks = volume.bricks(channel);
    // A point a thousandth of a voxel outside still counts as inside; a B-spline reaches one sample further.
    const double reach = interpolation == Interpolation::Cubic ? 1.002 : 0.002;
    const Interval nothing{kInfinity, -kInfinity};
    if (intersect({box.min - 0.002, box.max + 0.002}, volume.grid().indexDomain()).empty()) return nothing;
    const auto brick = [&](const Vec3& x) {
        const Vec3 inside = glm::clamp(x, Vec3(0), Vec3(volume.grid().size - 1));
        return glm::min(Index3(inside / double(kSide)), bricks.count - 1);
    };
    const Index3 first = brick(box.min - reach), last = brick(box.max + reach);
    Interval range = nothing;
    for (int k = first.z; k <= last.z; ++k)
        for (int j = first.y; j <= last.y; ++j)
            for (int i = first.x; i <= last.x; ++i) {
                const std::size_t n = bricks.indexOf({i, j, k});
                range = join(range, Interval{bricks.low[n], bricks.high[n]});
            }
    return range;
}

}  // namespace voledit
