// Numbers from many places of a table at once. Included once for each target, hence no plain include guard.

#if defined(VOLEDIT_RAYS_PACKET_GATHER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLEDIT_RAYS_PACKET_GATHER_INL
#undef VOLEDIT_RAYS_PACKET_GATHER_INL
#else
#define VOLEDIT_RAYS_PACKET_GATHER_INL
#endif

#include <hwy/highway.h>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "core/rays/packet_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

/// Places in a table, one for each lane, ready for several reads about them.
struct Places {
    Whole index;
#if HWY_TARGET == HWY_AVX2
    alignas(32) std::int32_t lane[8];
#endif
};

HWY_INLINE Places placesOf(Whole index) {
    Places at;
    at.index = index;
#if HWY_TARGET == HWY_AVX2
    hn::Store(index, I(), at.lane);
#endif
    return at;
}

#if HWY_TARGET == HWY_AVX2
// Where gather instructions are made of microcode, single loads are over twice as fast.
template <class Read>
HWY_INLINE Whole eachLane(const Read& read) {
    return Whole{_mm256_setr_epi32(read(0), read(1), read(2), read(3), read(4), read(5), read(6), read(7))};
}
#endif

/// Four bytes from element index + offset on, elements being `bytes` long.
template <int bytes>
HWY_INLINE Whole wordsAt(const std::byte* table, const Places& at, std::ptrdiff_t offset) {
    const std::byte* from = table + bytes * offset;
#if HWY_TARGET == HWY_AVX2
    return eachLane([&](int l) HWY_ATTR {
        std::int32_t word;
        std::memcpy(&word, from + bytes * std::ptrdiff_t(at.lane[l]), sizeof word);
        return word;
    });
#else
    constexpr int shift = bytes == 1 ? 0 : bytes == 2 ? 1 : 2;
    return hn::GatherOffset(I(), reinterpret_cast<const std::int32_t*>(from), hn::ShiftLeft<shift>(at.index));
#endif
}

/// Bytes as whole numbers; three more than the last may be read.
HWY_INLINE Whole bytesAt(const std::uint8_t* table, const Places& at) {
#if HWY_TARGET == HWY_AVX2
    return eachLane([&](int l) HWY_ATTR { return std::int32_t(table[at.lane[l]]); });
#else
    return hn::And(hn::GatherOffset(I(), reinterpret_cast<const std::int32_t*>(table), at.index), whole(0xff));
#endif
}

HWY_INLINE Real realsAt(const float* table, const Places& at) {
    return hn::BitCast(F(), wordsAt<4>(reinterpret_cast<const std::byte*>(table), at, 0));
}

/// The first three numbers of entries that are four long.
HWY_INLINE void triplesAt(const float* table, const Places& at, Real* triple) {
#if HWY_TARGET == HWY_AVX2
    const auto entries = [&](int low) HWY_ATTR {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(table + 4 * std::ptrdiff_t(at.lane[low]))),
                                    _mm_loadu_ps(table + 4 * std::ptrdiff_t(at.lane[low + 4])), 1);
    };
    const __m256 a = entries(0), b = entries(1), c = entries(2), d = entries(3);
    const __m256 ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d);
    triple[0] = Real{_mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(1, 0, 1, 0))};
    triple[1] = Real{_mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(3, 2, 3, 2))};
    triple[2] = Real{_mm256_shuffle_ps(_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d), _MM_SHUFFLE(1, 0, 1, 0))};
#else
    const Whole first = hn::ShiftLeft<2>(at.index);
    for (int c = 0; c < 3; ++c) triple[c] = hn::GatherIndex(F(), table + c, first);
#endif
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
