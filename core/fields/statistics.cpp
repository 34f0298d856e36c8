#include "core/fields/statistics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/base/parallel.h"
#include "core/fields/row_ranges.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

constexpr std::size_t kChunk = std::size_t(1) << 18;  // samples summed at a time: fixed, so that means are reproducible
constexpr int kBins = 256;

std::size_t binOf(double value, double min, double max) {
    const double bin = (value - min) / (max - min) * kBins;
    return bin < kBins - 1 ? std::size_t(bin) : kBins - 1;  // not a number where all values are one
}

template <class T>
bool finite(T value) {
    if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
    return true;
}

struct Partial {
    double min = kInfinity, max = -kInfinity, sum = 0;
    std::uint64_t count = 0;
    std::vector<std::uint64_t> histogram = std::vector<std::uint64_t>(kBins);
};

/// Every value of an 8- or 16-bit type has a counter of its own, from which all else follows exactly in one pass.
template <class T>
VolumeStatistics countedStatistics(const T* voxels, std::size_t samples, std::size_t stride) {
    constexpr std::size_t kValues = std::size_t(1) << (8 * sizeof(T));
    constexpr int kLow = std::numeric_limits<T>::min();
    const std::size_t part = std::max(kChunk * 4, (samples + 7) / 8);
    std::vector<std::vector<std::uint64_t>> counts((samples + part - 1) / part);
    parallelFor(counts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            // Two tables by turns: runs of one value would wait for each other's increments in a single one.
            std::vector<std::uint32_t> even(kValues), odd(kValues);
            const std::size_t last = std::min(samples, (c + 1) * part);
            std::size_t i = c * part;
            for (; i + 1 < last; i += 2) {
                ++even[std::size_t(voxels[i * stride] - kLow)];
                ++odd[std::size_t(voxels[(i + 1) * stride] - kLow)];
            }
            if (i < last) ++even[std::size_t(voxels[i * stride] - kLow)];
            counts[c].resize(kValues);
            for (std::size_t v = 0; v < kValues; ++v) counts[c][v] = std::uint64_t(even[v]) + odd[v];
        }
    });
    std::vector<std::uint64_t> total(kValues);
    for (const auto& count : counts)
        for (std::size_t v = 0; v < kValues; ++v) total[v] += count[v];

    VolumeStatistics result{0, 0, 0, std::vector<std::uint64_t>(kBins)};
    std::size_t low = 0, high = kValues - 1;
    while (low < kValues && !total[low]) ++low;
    if (low == kValues) return result;
    while (!total[high]) --high;
    result.min = double(low) + kLow;
    result.max = double(high) + kLow;
    double sum = 0;
    for (std::size_t v = low; v <= high; ++v) {
        sum += (double(v) + kLow) * double(total[v]);
        if (total[v]) result.histogram[binOf(double(v) + kLow, result.min, result.max)] += total[v];
    }
    result.mean = sum / double(samples);
    return result;
}

template <class T>
VolumeStatistics scannedStatistics(const T* voxels, std::size_t samples, std::size_t stride) {
    std::vector<Partial> parts((samples + kChunk - 1) / kChunk);
    const auto forParts = [&](const auto& body) {
        parallelFor(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c)
                body(parts[c], c * kChunk * stride, std::min(samples, (c + 1) * kChunk) * stride);
        });
    };
    forParts([&](Partial& part, std::size_t begin, std::size_t end) {
        // In variables of its own, which need not go to memory for every value.
        double min = kInfinity, max = -kInfinity, sum = 0;
        std::uint64_t count = 0;
        for (std::size_t i = begin; i < end; i += stride) {
            if (!finite(voxels[i])) continue;
            const auto v = double(voxels[i]);
            min = v < min ? v : min;
            max = v > max ? v : max;
            sum += v;
            ++count;
        }
        part.min = min;
        part.max = max;
        part.sum = sum;
        part.count = count;
    });
    Partial all;
    for (const Partial& part : parts) {
        all.min = std::min(all.min, part.min);
        all.max = std::max(all.max, part.max);
        all.sum += part.sum;
        all.count += part.count;
    }
    if (!all.count) return {0, 0, 0, std::vector<std::uint64_t>(kBins)};
    forParts([&](Partial& part, std::size_t begin, std::size_t end) {
        std::uint64_t* const histogram = part.histogram.data();
        const double min = all.min, max = all.max;
        for (std::size_t i = begin; i < end; i += stride)
            if (finite(voxels[i])) ++histogram[binOf(double(voxels[i]), min, max)];
    });
    for (const Partial& part : parts)
        for (int b = 0; b < kBins; ++b) all.histogram[std::size_t(b)] += part.histogram[std::size_t(b)];
    return {all.min, all.max, all.sum / double(all.count), std::move(all.histogram)};
}

/// Extremes of consecutive values, of all of them; low > high where all are NaN.
template <class T>
std::pair<T, T> extremes(const T* values, std::size_t count) {
    constexpr std::size_t kLength = 1024;  // of rows that are joined element by element
    std::array<T, kLength> low, high;
    std::vector<const void*> rows;
    T least = std::numeric_limits<T>::max(), most = std::numeric_limits<T>::lowest();
    const auto join = [&](std::size_t length) {
        rangesOfRows(voxelTypeFor<T>(), rows, rows, length, low.data(), high.data());
        for (std::size_t i = 0; i < length; ++i) {
            least = std::min(least, low[i]);
            most = std::max(most, high[i]);
        }
    };
    for (std::size_t at = 0; at + kLength <= count; at += kLength) rows.push_back(values + at);
    if (!rows.empty()) join(kLength);
    rows = {values + count / kLength * kLength};
    if (count % kLength > 0) join(count % kLength);
    return {least, most};
}

}  // namespace

VolumeStatistics extremesOf(VoxelType type, std::span<const std::byte> voxels, int channels) {
    return withVoxelType(type, [&](auto t) {
        using T = decltype(t);
        const T* values = reinterpret_cast<const T*>(voxels.data());
        const std::size_t samples = voxels.size() / sizeof(T);
        if (channels != 1 || samples == 0) return statisticsOf(type, voxels, channels);
        std::vector<std::pair<T, T>> parts((samples + kChunk - 1) / kChunk);
        parallelFor(parts.size(), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c)
                parts[c] = extremes(values + c * kChunk, std::min(kChunk, samples - c * kChunk));
        });
        double min = kInfinity, max = -kInfinity;
        for (const auto& [least, most] : parts) {
            min = std::min(min, double(least));
            max = std::max(max, double(most));
        }
        // Finite values alone count: those of such volumes are looked at one by one.
        if (!(min <= max) || !std::isfinite(min) || !std::isfinite(max)) return statisticsOf(type, voxels, channels);
        return VolumeStatistics{min, max, kNaN, {}};
    });
}

VolumeStatistics countedStatistics(const Volume& volume) {
    const VolumeStatistics& known = volume.statistics();
    if (!known.histogram.empty()) return known;
    return statisticsOf(volume.type(), volume.voxels(), volume.grid().channels);
}

VolumeStatistics statisticsOf(VoxelType type, std::span<const std::byte> voxels, int channels) {
    assert(channels > 0 && voxels.size() % (byteSize(type) * std::size_t(channels)) == 0);
    const std::size_t samples = voxels.size() / (byteSize(type) * std::size_t(channels));
    return withVoxelType(type, [&](auto t) {
        using T = decltype(t);
        const T* values = reinterpret_cast<const T*>(voxels.data());
        if constexpr (sizeof(T) <= 2)
            return countedStatistics(values, samples, std::size_t(channels));
        else
            return scannedStatistics(values, samples, std::size_t(channels));
    });
}

}  // namespace voledit
