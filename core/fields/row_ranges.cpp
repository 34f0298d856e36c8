#include "core/fields/row_ranges.h"

#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/fields/voxel_type.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/fields/row_ranges.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Comparisons of a NaN are false: it never gets in.
template <class V>
HWY_INLINE V lesser(V value, V least) {
    if constexpr (hwy::IsFloat<hn::TFromV<V>>()) return hn::IfThenElse(hn::Lt(value, least), value, least);
    return hn::Min(value, least);
}
template <class V>
HWY_INLINE V greater(V value, V most) {
    if constexpr (hwy::IsFloat<hn::TFromV<V>>()) return hn::IfThenElse(hn::Lt(most, value), value, most);
    return hn::Max(value, most);
}

template <class D, class T = hn::TFromD<D>>
HWY_INLINE void rangeAt(D d, std::span<const void* const> lowRows, std::span<const void* const> highRows,
                        std::size_t at, T* low, T* high) {
    using Limits = std::numeric_limits<T>;
    auto least = hn::Set(d, Limits::has_infinity ? Limits::infinity() : Limits::max());
    auto most = hn::Set(d, Limits::has_infinity ? -Limits::infinity() : Limits::lowest());
    for (std::size_t r = 0; r < lowRows.size(); ++r) {
        least = lesser(hn::LoadU(d, static_cast<const T*>(lowRows[r]) + at), least);
        most = greater(hn::LoadU(d, static_cast<const T*>(highRows[r]) + at), most);
    }
    hn::StoreU(least, d, low + at);
    hn::StoreU(most, d, high + at);
}

template <class T>
void ranges(std::span<const void* const> lowRows, std::span<const void* const> highRows, std::size_t count, T* low,
            T* high) {
    const hn::ScalableTag<T> d;
    const hn::CappedTag<T, 1> one;
    std::size_t at = 0;
    for (; at + hn::Lanes(d) <= count; at += hn::Lanes(d)) rangeAt(d, lowRows, highRows, at, low, high);
    // A last whole vector that overlaps the one before does the rest, where there is one.
    if (at < count && count >= hn::Lanes(d)) return rangeAt(d, lowRows, highRows, count - hn::Lanes(d), low, high);
    for (; at < count; ++at) rangeAt(one, lowRows, highRows, at, low, high);
}

void rangesOfType(VoxelType type, std::span<const void* const> lowRows, std::span<const void* const> highRows,
                  std::size_t count, void* low, void* high) {
    withVoxelType(type, [&](auto sample) {
        using T = decltype(sample);
        ranges<T>(lowRows, highRows, count, static_cast<T*>(low), static_cast<T*>(high));
    });
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace voledit {

HWY_EXPORT(rangesOfType);
void rangesOfRows(VoxelType type, std::span<const void* const> lowRows, std::span<const void* const> highRows,
                  std::size_t count, void* low, void* high) {
    HWY_DYNAMIC_DISPATCH(rangesOfType)(type, lowRows, highRows, count, low, high);
}

}  // namespace voledit

// libhwy measures the resolution of the processor's timer whenever it is loaded, for its benchmarks, which takes 5 ms
// of every start of every program. It calls this by its table of symbols, in which those of the program come first.
namespace hwy::platform {
std::uint64_t TimerResolution();
std::uint64_t TimerResolution() {
    return 1;
}
}  // namespace hwy::platform

#endif
