#include "core/eval/voxel_kernels.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/eval/voxel_kernels.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = HWY_CAPPED(double, 8);
using F = HWY_CAPPED(float, 16);
using I = hn::RebindToSigned<F>;
using DI = hn::Rebind<std::int32_t, D>;
using Double = hn::Vec<D>;
using Real = hn::Vec<F>;
using Whole = hn::Vec<I>;

constexpr double kFar = 1e9;  // beyond any row, within 32 bits

// ---- Intervals ----------------------------------------------------------------------------------------------------

struct Bounds {
    Double low, high;
};

/// A face over some rows of a slice.
struct Face {
    Double missing;  // guard − (c + y·j + z·k): what x·i must make up for
    Double perX;
    Double twice;  // how much further the voxels in doubt reach, voxels
};

/// Cuts off what lies beyond a face, which bounds rows from below (x > 0), from above, or not at all (x = 0).
HWY_INLINE void cut(const Face& face, double x, double guard, Bounds& sure, Bounds& may) {
    if (HWY_UNLIKELY(x == 0)) {
        const Double far = hn::Set(D(), kFar);
        sure.low = hn::IfThenElse(hn::Gt(face.missing, hn::Zero(D())), far, sure.low);
        may.low = hn::IfThenElse(hn::Gt(face.missing, hn::Set(D(), 2 * guard)), far, may.low);
        return;
    }
    const Double at = hn::Mul(face.missing, face.perX), further = hn::Sub(at, face.twice);
    if (x > 0) {
        sure.low = hn::Max(sure.low, at);
        may.low = hn::Max(may.low, further);
    } else {
        sure.high = hn::Min(sure.high, at);
        may.high = hn::Min(may.high, further);
    }
}

/// To whole voxels, `last` being that of the rows.
HWY_INLINE Bounds wholeOf(const Bounds& bounds, double last) {
    return {hn::Min(hn::Ceil(bounds.low), hn::Set(D(), kFar)),
            hn::Max(hn::Floor(hn::Min(bounds.high, hn::Set(D(), last))), hn::Set(D(), -1))};
}

HWY_INLINE void store(const Bounds& bounds, std::int32_t* firsts, std::int32_t* lasts) {
    hn::StoreU(hn::DemoteTo(DI(), bounds.low), DI(), firsts);
    hn::StoreU(hn::DemoteTo(DI(), bounds.high), DI(), lasts);
}

HWY_INLINE unsigned bitsOf(hn::Mask<D> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), mask, bits);
    return bits[0];
}

void intervals(const HalfSpaces& piece, int j, int rows, int k, int length, std::span<RowIntervals> result) {
    constexpr std::size_t kFaces = HalfSpaces::kMost;
    const auto lanes = static_cast<int>(hn::Lanes(D()));
    for (RowIntervals& slice : result) slice.any = slice.plain = 0;
    for (int row = 0; row < rows; row += lanes) {
        Face faces[kFaces];
        for (std::size_t f = 0; f < kFaces; ++f) {
            const Double rest = hn::Add(hn::Mul(hn::Set(D(), piece.y[f]), hn::Iota(D(), j + row)),
                                        hn::Set(D(), piece.c[f] + piece.z[f] * k));
            faces[f] = {hn::Sub(hn::Set(D(), piece.guard[f]), rest), hn::Set(D(), piece.perX[f]),
                        hn::Set(D(), 2 * piece.guard[f] * piece.perX[f])};
        }
        for (RowIntervals& slice : result) {
            Bounds sure{hn::Zero(D()), hn::Set(D(), kFar)}, may = sure;
            for (std::size_t f = 0; f < kFaces; ++f) {
                cut(faces[f], piece.x[f], piece.guard[f], sure, may);
                faces[f].missing = hn::Sub(faces[f].missing, hn::Set(D(), piece.z[f]));
            }
            const auto to = static_cast<std::size_t>(row);
            sure = wholeOf(sure, length - 1);
            may = wholeOf(may, length - 1);
            const auto any = hn::Le(may.low, may.high);
            if (hn::AllFalse(D(), any)) continue;
            store(sure, &slice.first[to], &slice.last[to]);
            store(may, &slice.mayFirst[to], &slice.mayLast[to]);
            const auto same = hn::And(hn::Eq(sure.low, may.low), hn::Eq(sure.high, may.high));
            slice.any |= bitsOf(any) << row;
            slice.plain |= bitsOf(hn::And(any, same)) << row;
        }
    }
    for (RowIntervals& slice : result) {
        slice.any &= (1U << rows) - 1;
        slice.plain &= slice.any;
    }
}

// ---- Places -------------------------------------------------------------------------------------------------------

using P = HWY_CAPPED(std::int32_t, 8);

/// `voxel`'s place along the three axes, rounded to units.
HWY_INLINE void placeOf(const SamplePlaces& p, int voxel, int j, int k, std::int32_t* place) {
    using A = HWY_CAPPED(double, 4);
    const hn::Rebind<std::int32_t, A> whole;
    const A d;
    const auto i = hn::Set(d, voxel), row = hn::Set(d, j), slice = hn::Set(d, k);
    for (std::size_t a = 0; a < 4; a += hn::Lanes(d)) {
        const auto term = [&](const std::array<double, 4>& along, hn::Vec<A> n)
                              HWY_ATTR { return hn::Mul(hn::LoadU(d, along.data() + a), n); };
        const auto at = hn::Add(hn::Add(hn::LoadU(d, p.start.data() + a), term(p.alongI, i)),
                                hn::Add(term(p.alongJ, row), term(p.alongK, slice)));
        hn::StoreU(hn::DemoteTo(whole, hn::Round(at)), whole, place + a);
    }
}

HWY_INLINE void placeSpan(const VoxelSpan& span, const SamplePlaces& p, int j, int k,
                          const std::array<std::int32_t, 3>& most, const std::array<std::int32_t*, 3>& to) {
    constexpr std::int32_t kHalf = 4;
    const P d;
    const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
    for (std::int32_t i = span.first; i <= span.last; i += lanes) {
        // Whole steps from a voxel about the middle: they add up to an error of half a unit each.
        const std::int32_t middle = std::min(kHalf, span.last - i);
        std::int32_t place[4];
        placeOf(p, i + middle, j, k, place);
        for (std::size_t a = 0; a < 3; ++a) {
            const auto offset = hn::Sub(hn::Iota(d, 0), hn::Set(d, middle));
            const auto at = hn::Add(hn::Set(d, place[a]), hn::Mul(offset, hn::Set(d, p.step[a])));
            // What is stored beyond the span is overwritten by the next one, or counts as nothing.
            hn::StoreU(hn::Min(hn::Max(at, hn::Zero(d)), hn::Set(d, most[a])), d, to[a] + i);
        }
    }
}

void place(std::span<const VoxelSpan> spans, std::span<const SamplePlaces> list, int j, int k, const Index3& size,
           RowPlaces& places) {
    const double one = 1 << places.bits;
    // A place on the last sample counts to the cell before it: neighbours of weight 0 may not exist.
    std::array<std::int32_t, 3> most;
    for (std::size_t a = 0; a < 3; ++a) most[a] = static_cast<std::int32_t>((size[int(a)] - 1.0) * one - 1);
    const std::array<std::int32_t*, 3> to{places.at[0].data(), places.at[1].data(), places.at[2].data()};
    for (const VoxelSpan& span : spans) placeSpan(span, list[span.places], j, k, most, to);
    const auto state = places.state.begin();
    for (std::size_t n = 0; n < spans.size();) {
        const std::int32_t first = spans[n].first;
        std::int32_t end = first;
        for (; n < spans.size() && spans[n].first == end; ++n) end = spans[n].last + 1;
        std::fill(state + first, state + end, RowPlaces::Value);
    }
}

// ---- Values -------------------------------------------------------------------------------------------------------

HWY_INLINE Whole whole(std::int32_t n) {
    return hn::Set(I(), n);
}
HWY_INLINE Real lerp(Real a, Real b, Real t) {
    return hn::Add(a, hn::Mul(t, hn::Sub(b, a)));
}

/// Two neighbours along i.
struct Pair {
    Real first, second;
};

/// Four bytes from each index of a voxel on, and from `offsets` bytes further.
template <class T>
HWY_INLINE void read(const T* voxels, Whole index, const std::ptrdiff_t (&offsets)[4], Whole (&words)[4]) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(voxels);
#if HWY_TARGET == HWY_AVX2
    // Loads one by one: many processors take longer over their own gathers, and the indices serve four times.
    HWY_ALIGN std::int32_t at[8];
    hn::Store(index, I(), at);
    for (int n = 0; n < 4; ++n) {
        const auto load = [&](int lane) {
            std::int32_t word;
            std::memcpy(&word, bytes + std::ptrdiff_t(at[lane]) * std::ptrdiff_t(sizeof(T)) + offsets[n], sizeof word);
            return word;
        };
        words[n] = Whole{_mm256_setr_epi32(load(0), load(1), load(2), load(3), load(4), load(5), load(6), load(7))};
    }
#else
    const Whole at = sizeof(T) == 1 ? index : hn::ShiftLeft<1>(index);
    for (int n = 0; n < 4; ++n)
        words[n] = hn::GatherOffset(I(), reinterpret_cast<const std::int32_t*>(bytes + offsets[n]), at);
#endif
}

template <class T>
HWY_INLINE Pair pairOf(Whole word) {
    constexpr int kBits = 8 * sizeof(T);
    if constexpr (std::is_signed_v<T>) {
        return {hn::ConvertTo(F(), hn::ShiftRight<32 - kBits>(hn::ShiftLeft<32 - kBits>(word))),
                hn::ConvertTo(F(), hn::ShiftRight<32 - kBits>(hn::ShiftLeft<32 - 2 * kBits>(word)))};
    } else {
        const hn::RebindToUnsigned<I> u;
        const auto second = hn::BitCast(I(), hn::ShiftRight<kBits>(hn::BitCast(u, word)));
        const Whole mask = whole((1 << kBits) - 1);
        return {hn::ConvertTo(F(), hn::And(word, mask)), hn::ConvertTo(F(), hn::And(second, mask))};
    }
}

/// Places of some voxels: sample below, and what lies beyond it.
struct Cells {
    Whole index, fraction[3];
};

/// The length of a fixed-point unit.
HWY_INLINE float unitOf(int bits) {
    return 1.0F / static_cast<float>(1 << bits);
}

/// How far the float value may be off: a place is off along three axes, which a tenth is added to; and each of three
/// interpolations is rounded.
HWY_INLINE Real doubt(Real range, Real largest, float unit) {
    return hn::Add(hn::Mul(range, hn::Set(F(), 3.3F * kPlaceError * unit)), hn::Mul(largest, hn::Set(F(), 5e-7F)));
}

/// Values between eight neighbours, and the range of these.
struct Interpolated {
    Real value, low, high;
};

template <class T>
HWY_INLINE Interpolated interpolate(const T* voxels, const std::ptrdiff_t (&offsets)[4], const Cells& cells,
                                    float unit) {
    const auto realOf = [&](Whole fraction)
                            HWY_ATTR { return hn::Mul(hn::ConvertTo(F(), fraction), hn::Set(F(), unit)); };
    const Real u = realOf(cells.fraction[0]), v = realOf(cells.fraction[1]), w = realOf(cells.fraction[2]);
    Whole words[4];
    read(voxels, cells.index, offsets, words);
    const Pair p[4] = {pairOf<T>(words[0]), pairOf<T>(words[1]), pairOf<T>(words[2]), pairOf<T>(words[3])};
    const Real low = lerp(lerp(p[0].first, p[0].second, u), lerp(p[1].first, p[1].second, u), v);
    const Real high = lerp(lerp(p[2].first, p[2].second, u), lerp(p[3].first, p[3].second, u), v);
    Interpolated result{lerp(low, high, w), p[0].first, p[0].first};
    if constexpr (sizeof(T) > 1)
        for (const Pair& pair : p) {
            result.low = hn::Min(result.low, hn::Min(pair.first, pair.second));
            result.high = hn::Max(result.high, hn::Max(pair.first, pair.second));
        }
    return result;
}

/// Lanes whose places are so near a neighbouring cell that its values may count.
HWY_INLINE hn::Mask<F> nearOtherCells(const Cells& cells, int bits) {
    auto near = hn::FirstN(I(), 0);
    for (const Whole& fraction : cells.fraction) {
        const Whole shifted = hn::And(hn::Add(fraction, whole(5)), whole((1 << bits) - 1));
        near = hn::Or(near, hn::Lt(shifted, whole(10)));
    }
    return hn::RebindMask(F(), near);
}

/// Doubt about values of 16 bits, by the range of the neighbours: that of 8 bits is worked out once.
HWY_INLINE Real doubtOf(float range, const Cells& cells, const Interpolated& found, int bits, float unit) {
    const Real largest = hn::Max(hn::Abs(found.low), hn::Abs(found.high));
    return doubt(hn::IfThenElse(nearOtherCells(cells, bits), hn::Set(F(), range), hn::Sub(found.high, found.low)),
                 hn::Add(largest, hn::Set(F(), 1.0F)), unit);
}

template <class T>
class RowReader {
public:
    RowReader(const VoxelRows<T>& rows, RowPlaces& places, T nothing)
        : rows_(rows), nothing_(nothing), bits_(places.bits), state_(places.state.data()) {
        for (std::size_t a = 0; a < 3; ++a) at_[a] = places.at[a].data();
        unit_ = unitOf(bits_);
        range_ = static_cast<float>(rows.range);
        // The same sum as `doubt`, for the largest numbers of 8 bits.
        doubt_ = range_ * (3.3F * kPlaceError * unit_) + 256 * 5e-7F;
        const std::ptrdiff_t row = std::ptrdiff_t(sizeof(T)) * rows.size.x, above = row * rows.size.y;
        offsets_[0] = 0;
        offsets_[1] = row;
        offsets_[2] = above;
        offsets_[3] = above + row;
        const std::size_t slice = std::size_t(rows.size.x) * std::size_t(rows.size.y);
        // A pair is read as four bytes: of the last three voxels of all, these reach beyond the end.
        lastIndex_ = std::int32_t(slice * std::size_t(rows.size.z - 1) - std::size_t(rows.size.x) - 4 / sizeof(T));
    }

    /// Values of the lanes from `at` on; true where one is in doubt.
    HWY_INLINE bool read(std::size_t at, T* out) {
        std::uint8_t* state = state_ + at;
        const hn::Rebind<std::uint8_t, I> bytes;
        const auto states = hn::PromoteTo(I(), hn::LoadU(bytes, state));
        const auto wanted = hn::Eq(states, whole(RowPlaces::Value));
        Whole result = whole(nothing_);
        bool asks = false;
        if (!hn::AllFalse(I(), wanted)) {
            auto doubtful = hn::FirstN(I(), 0);
            result = hn::IfThenElse(wanted, values(at, doubtful), result);
            doubtful = hn::And(doubtful, wanted);
            asks = !hn::AllFalse(I(), doubtful);
            if (HWY_UNLIKELY(asks)) mark(doubtful, state);
        }
        hn::StoreU(hn::DemoteTo(hn::Rebind<T, I>(), result), hn::Rebind<T, I>(), out);
        return asks;
    }

private:
    HWY_INLINE Whole values(std::size_t at, hn::Mask<I>& doubtful) const {
        Cells cells;
        Whole below[3];
        for (std::size_t a = 0; a < 3; ++a) {
            const Whole place = hn::LoadU(I(), at_[a] + at);
            below[a] = hn::ShiftRightSame(place, bits_);
            cells.fraction[a] = hn::And(place, whole((1 << bits_) - 1));
        }
        const Whole row = hn::Add(below[1], hn::Mul(below[2], whole(rows_.size.y)));
        const Whole index = hn::Add(below[0], hn::Mul(row, whole(rows_.size.x)));
        cells.index = hn::Min(index, whole(lastIndex_));
        const Interpolated found = interpolate(rows_.voxels, offsets_, cells, unit_);
        // By the place of a float's last bit: values are far from where that would overflow.
        const Real shift = hn::Set(F(), 12582912.0F), shifted = hn::Add(found.value, shift);
        const Real rounded = hn::Sub(shifted, shift);
        const Real off = hn::Abs(hn::Sub(found.value, rounded));
        Real doubt = hn::Set(F(), doubt_);
        if constexpr (sizeof(T) > 1) doubt = doubtOf(range_, cells, found, bits_, unit_);
        const auto unsure = hn::Gt(hn::Add(off, doubt), hn::Set(F(), 0.5F));
        doubtful = hn::Or(hn::RebindMask(I(), unsure), hn::Ne(index, cells.index));
        return hn::Sub(hn::BitCast(I(), shifted), hn::BitCast(I(), shift));
    }

    void mark(hn::Mask<I> lanes, std::uint8_t* state) const {
        HWY_ALIGN std::int32_t set[16];
        hn::Store(hn::VecFromMask(I(), lanes), I(), set);
        for (std::size_t l = 0; l < hn::Lanes(I()); ++l)
            if (set[l] != 0) state[l] = RowPlaces::Ask;
    }

    VoxelRows<T> rows_;
    T nothing_;
    int bits_;
    float unit_, range_, doubt_;
    std::uint8_t* state_;
    const std::int32_t* at_[3];
    std::ptrdiff_t offsets_[4];  // of a cell's four pairs, bytes
    std::int32_t lastIndex_;
};

template <class T>
bool valuesAlong(const VoxelRows<T>& rows, RowPlaces& places, T nothing, std::span<T> out) {
    RowReader<T> reader(rows, places, nothing);
    const std::size_t lanes = hn::Lanes(I());
    bool asks = false;
    std::size_t at = 0;
    for (; at + lanes <= out.size(); at += lanes) asks |= reader.read(at, out.data() + at);
    if (at < out.size()) {
        T rest[16];
        asks |= reader.read(at, rest);
        std::copy_n(rest, out.size() - at, out.data() + at);
    }
    return asks;
}

#define VOLEDIT_VALUES(Name, T)                                                                   \
    bool values##Name(const VoxelRows<T>& rows, RowPlaces& places, T nothing, std::span<T> out) { \
        return valuesAlong(rows, places, nothing, out);                                           \
    }
VOLEDIT_VALUES(Int8, std::int8_t)
VOLEDIT_VALUES(UInt8, std::uint8_t)
VOLEDIT_VALUES(Int16, std::int16_t)
VOLEDIT_VALUES(UInt16, std::uint16_t)
#undef VOLEDIT_VALUES

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace voledit {

HWY_EXPORT(intervals);
HWY_EXPORT(place);

RowPlaces::RowPlaces(const Index3& size) {
    constexpr int kMostBits = 23;  // of a float's mantissa
    const int longest = std::max({size.x, size.y, size.z});
    for (bits = kMostBits; (std::int64_t(longest) << bits) > 0x7fffffff; --bits) {
    }
}

void RowPlaces::clear(std::size_t length) {
    constexpr std::size_t kBeyond = 16;  // a vector may reach so far
    for (auto& axis : at) axis.resize(length + kBeyond);
    state.assign(length + kBeyond, Nothing);
}

void intervalsOfRows(const HalfSpaces& piece, int j, int rows, int k, int length, std::span<RowIntervals> result) {
    HWY_DYNAMIC_DISPATCH(intervals)(piece, j, rows, k, length, result);
}

void placeSpans(std::span<const VoxelSpan> spans, std::span<const SamplePlaces> list, int j, int k, const Index3& size,
                RowPlaces& places) {
    HWY_DYNAMIC_DISPATCH(place)(spans, list, j, k, size, places);
}

#define VOLEDIT_VALUES(Name, T)                                                                  \
    HWY_EXPORT(values##Name);                                                                    \
    template <>                                                                                  \
    bool valuesOfRow(const VoxelRows<T>& rows, RowPlaces& places, T nothing, std::span<T> out) { \
        return HWY_DYNAMIC_DISPATCH(values##Name)(rows, places, nothing, out);                   \
    }
VOLEDIT_VALUES(Int8, std::int8_t)
VOLEDIT_VALUES(UInt8, std::uint8_t)
VOLEDIT_VALUES(Int16, std::int16_t)
VOLEDIT_VALUES(UInt16, std::uint16_t)
#undef VOLEDIT_VALUES

}  // namespace voledit

#endif
