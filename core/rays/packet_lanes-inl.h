// Masks as bits, and lanes one by one. Included once for each target, hence no plain include guard.

#if defined(VOLEDIT_RAYS_PACKET_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLEDIT_RAYS_PACKET_LANES_INL
#undef VOLEDIT_RAYS_PACKET_LANES_INL
#else
#define VOLEDIT_RAYS_PACKET_LANES_INL
#endif

#include <hwy/highway.h>
#include <array>
#include <cstring>

#include "core/base/quad.h"
#include "core/rays/packet_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

/// Four numbers of one lane. Not of Highway, which has no such vectors on every target.
HWY_INLINE Quad quad(const std::array<float, 4>& values) {
    Quad result;
    std::memcpy(&result, values.data(), sizeof result);
    return result;
}

HWY_INLINE Real load(const float* values) {
    return hn::Load(F(), values);
}
HWY_INLINE Mask none() {
    return hn::Lt(hn::Zero(F()), hn::Zero(F()));
}
HWY_INLINE Mask all() {
    return hn::Eq(hn::Zero(F()), hn::Zero(F()));
}
HWY_INLINE std::uint32_t bitsOf(Mask mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(F(), mask, bits);
    return std::uint32_t(bits[0]) | std::uint32_t(bits[1]) << 8;
}
HWY_INLINE Mask maskOf(std::uint32_t bits) {
    const std::uint8_t bytes[8] = {std::uint8_t(bits), std::uint8_t(bits >> 8)};
    return hn::LoadMaskBits(F(), bytes);
}
template <class Body>
HWY_INLINE void forLanes(std::uint32_t bits, const Body& body) {
    for (; bits; bits &= bits - 1) body(std::size_t(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)));
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
