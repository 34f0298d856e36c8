#include "core/fields/value_bricks.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <type_traits>

#include "core/base/parallel.h"
#include "core/fields/row_ranges.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

constexpr int kSide = ValueBricks::kSide;

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

using Rows = std::vector<const void*>;

/// A row's ranges, element by element, with room for what stands beyond its ends.
template <class T>
struct RowRange {
    std::vector<T> low, high;
    explicit RowRange(std::size_t length = 0) : low(length), high(length) {}
};

/// Ranges of one layer of bricks: rows of voxels are joined across the slices, then across the rows, then along.
template <class T>
class Layer {
public:
    Layer(const VolumeGrid& grid, const T* voxels, int margin, ValueBricks& result)
        : grid_(grid), voxels_(voxels), margin_(margin), result_(result), length_(std::size_t(grid.size.x)) {
        const auto window = std::size_t(kSide + 1 + 2 * margin);
        const std::size_t padded = std::size_t(result.count.x * kSide) + window;
        rows_.assign(window, RowRange<T>(length_));
        joined_ = RowRange<T>(std::max(padded, length_ + std::size_t(margin)));
        windows_ = RowRange<T>(std::size_t(result.count.x * kSide));
    }

    void fill(int k) {
        int known = 0;  // rows below this one have been joined across the slices
        for (int j = 0; j < result_.count.y; ++j) {
            const Index2 rows = samplesOf(j, margin_, grid_.size.y);
            for (known = std::max(known, rows[0]); known < rows[1]; ++known) joinSlices(known, k);
            joinRows(rows);
            joinAlong();
            store(result_.indexOf({0, j, k}));
        }
    }

private:
    RowRange<T>& rowRange(int y) { return rows_[std::size_t(y) % rows_.size()]; }

    void joinSlices(int y, int k) {
        const Index2 slices = samplesOf(k, margin_, grid_.size.z);
        const auto channels = std::size_t(grid_.channels);
        first_.clear();
        if (channels > 1) picked_.resize(length_ * std::size_t(slices[1] - slices[0]));
        for (int z = slices[0]; z < slices[1]; ++z) {
            const T* row = voxels_ + (std::size_t(z) * std::size_t(grid_.size.y) + std::size_t(y)) * length_ * channels;
            if (channels > 1) {
                T* picked = picked_.data() + length_ * std::size_t(z - slices[0]);
                for (std::size_t i = 0; i < length_; ++i) picked[i] = row[i * channels];
                row = picked;
            }
            first_.push_back(row);
        }
        rangesOfRows(voxelTypeFor<T>(), first_, first_, length_, rowRange(y).low.data(), rowRange(y).high.data());
    }

    void joinRows(const Index2& rows) {
        first_.clear();
        second_.clear();
        for (int y = rows[0]; y < rows[1]; ++y) {
            first_.push_back(rowRange(y).low.data());
            second_.push_back(rowRange(y).high.data());
        }
        const auto before = std::size_t(margin_);
        rangesOfRows(voxelTypeFor<T>(), first_, second_, length_, joined_.low.data() + before,
                     joined_.high.data() + before);
        // Repeated end samples change no brick's range: they lie in that of each brick which reaches beyond the end.
        for (auto* side : {&joined_.low, &joined_.high}) {
            const auto start = side->begin() + std::ptrdiff_t(before), end = start + std::ptrdiff_t(length_);
            std::fill(side->begin(), start, *start);
            std::fill(end, side->end(), *(end - 1));
        }
    }

    /// windows_[x] = the range of all samples within a window's length from x on.
    void joinAlong() {
        first_.clear();
        second_.clear();
        for (std::size_t shift = 0; shift < rows_.size(); ++shift) {
            first_.push_back(joined_.low.data() + shift);
            second_.push_back(joined_.high.data() + shift);
        }
        rangesOfRows(voxelTypeFor<T>(), first_, second_, windows_.low.size(), windows_.low.data(),
                     windows_.high.data());
    }

    void store(std::size_t at) {
        constexpr bool kExact = sizeof(T) <= 2 || std::is_same_v<T, float>;
        for (std::size_t b = 0; b < std::size_t(result_.count.x); ++b) {
            const T low = windows_.low[b * kSide], high = windows_.high[b * kSide];
            result_.low[at + b] = kExact ? static_cast<float>(low) : below(double(low));
            result_.high[at + b] = kExact ? static_cast<float>(high) : above(double(high));
        }
    }

    const VolumeGrid& grid_;
    const T* voxels_;  // of the channel
    int margin_;
    ValueBricks& result_;
    std::size_t length_;
    std::vector<RowRange<T>> rows_;  // of the last rows, by turns
    RowRange<T> joined_, windows_;
    std::vector<T> picked_;  // one channel of interleaved rows
    Rows first_, second_;
};

}  // namespace

ValueBricks makeValueBricks(const Volume& volume, int channel, int margin) {
    ValueBricks result;
    const VolumeGrid& grid = volume.grid();
    for (int a = 0; a < 3; ++a) result.count[a] = std::max((grid.size[a] - 1 + kSide - 1) / kSide, 1);
    result.low.resize(result.indexOf({0, 0, result.count.z}));
    result.high.resize(result.low.size());
    withVoxelType(volume.type(), [&](auto t) {
        const auto* voxels = reinterpret_cast<const decltype(t)*>(volume.voxels().data()) + channel;
        // Neighbouring layers share a slice, which the second finds in the cache.
        parallelFor(std::size_t(result.count.z), 4, [&](std::size_t begin, std::size_t end) {
            Layer layer(grid, voxels, margin, result);
            for (std::size_t k = begin; k < end; ++k) layer.fill(int(k));
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
