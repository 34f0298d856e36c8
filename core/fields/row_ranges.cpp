#include "core/fields/row_ranges.h"

#include <cstdint>
#include <limits>
#include <type_traits>

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

template <class D, class T>
HWY_INLINE void rangeAt(D d, std::span<const T* const> lowRows, std::span<const T* const> highRows, std::size_t at,
                        T* low, T* high) {
    using Limits = std::numeric_limits<T>;
    auto least = hn::Set(d, Limits::has_infinity ? Limits::infinity() : Limits::max());
    auto most = hn::Set(d, Limits::has_infinity ? -Limits::infinity() : Limits::lowest());
    for (std::size_t r = 0; r < lowRows.size(); ++r) {
        least = lesser(hn::LoadU(d, lowRows[r] + at), least);
        most = greater(hn::LoadU(d, highRows[r] + at), most);
    }
    hn::StoreU(least, d, low + at);
    hn::StoreU(most, d, high + at);
}

template <class T>
void ranges(std::span<const T* const> lowRows, std::span<const T* const> highRows, std::size_t count, T* low, T* high) {
    const hn::ScalableTag<T> d;
    const hn::CappedTag<T, 1> one;
    std::size_t at = 0;
    for (; at + hn::Lanes(d) <= count; at += hn::Lanes(d)) rangeAt(d, lowRows, highRows, at, low, high);
    // A last whole vector that overlaps the one before does the rest, where there is one.
    if (at < count && count >= hn::Lanes(d)) return rangeAt(d, lowRows, highRows, count - hn::Lanes(d), low, high);
    for (; at < count; ++at) rangeAt(one, lowRows, highRows, at, low, high);
}

#define VOLEDIT_RANGES(Name, T)                                                                                 \
    void ranges##Name(std::span<const T* const> lowRows, std::span<const T* const> highRows, std::size_t count, \
                      T* low, T* high) {                                                                        \
        ranges(lowRows, highRows, count, low, high);                                                            \
    }
VOLEDIT_RANGES(Int8, std::int8_t)
VOLEDIT_RANGES(UInt8, std::uint8_t)
VOLEDIT_RANGES(Int16, std::int16_t)
VOLEDIT_RANGES(UInt16, std::uint16_t)
VOLEDIT_RANGES(Int32, std::int32_t)
VOLEDIT_RANGES(UInt32, std::uint32_t)
VOLEDIT_RANGES(Float, float)
VOLEDIT_RANGES(Double, double)
#undef VOLEDIT_RANGES

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace voledit {

#define VOLEDIT_RANGES(Name, T)                                                                                 \
    HWY_EXPORT(ranges##Name);                                                                                   \
    template <>                                                                                                 \
    void rangesOfRows(std::span<const T* const> lowRows, std::span<const T* const> highRows, std::size_t count, \
                      T* low, T* high) {                                                                        \
        HWY_DYNAMIC_DISPATCH(ranges##Name)(lowRows, highRows, count, low, high);                                \
    }
VOLEDIT_RANGES(Int8, std::int8_t)
VOLEDIT_RANGES(UInt8, std::uint8_t)
VOLEDIT_RANGES(Int16, std::int16_t)
VOLEDIT_RANGES(UInt16, std::uint16_t)
VOLEDIT_RANGES(Int32, std::int32_t)
VOLEDIT_RANGES(UInt32, std::uint32_t)
VOLEDIT_RANGES(Float, float)
VOLEDIT_RANGES(Double, double)
#undef VOLEDIT_RANGES

}  // namespace voledit

#endif
