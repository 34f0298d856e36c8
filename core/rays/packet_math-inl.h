// Exponentials and logarithms on vectors, of multiplications and additions alone, so that every instruction set gives
// the same bits. Included once for each target, hence no plain include guard.

#if defined(VOLEDIT_RAYS_PACKET_MATH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLEDIT_RAYS_PACKET_MATH_INL
#undef VOLEDIT_RAYS_PACKET_MATH_INL
#else
#define VOLEDIT_RAYS_PACKET_MATH_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using F = HWY_CAPPED(float, 16);
using I = hn::RebindToSigned<F>;
using Real = hn::Vec<F>;
using Whole = hn::Vec<I>;
using Mask = hn::Mask<F>;

HWY_INLINE Real real(float x) {
    return hn::Set(F(), x);
}
HWY_INLINE Whole whole(std::int32_t n) {
    return hn::Set(I(), n);
}
HWY_INLINE Real lerp(Real a, Real b, Real t) {
    return hn::Add(a, hn::Mul(t, hn::Sub(b, a)));
}

/// The whole numbers in [0, 2²²] that `x` holds or, where it lies between two, the nearest (even) one. By the place of
/// the mantissa's last bit: conversions would look for overflow.
HWY_INLINE Whole wholeOf(Real x) {
    return hn::Sub(hn::BitCast(I(), hn::Add(x, real(8388608))), whole(0x4b000000));
}

/// 2^x for x in [−126, 126], to 2e-7 of it; smaller x count as −126.
HWY_INLINE Real exp2(Real x) {
    const Real clamped = hn::Min(hn::Max(x, real(-126)), real(126));
    const Real n = hn::Round(clamped), f = hn::Sub(clamped, n);
    Real p = real(1.5403530e-4F);
    for (const float c : {1.3333558e-3F, 9.6181291e-3F, 5.5504109e-2F, 2.4022651e-1F, 6.9314718e-1F, 1.0F})
        p = hn::Add(hn::Mul(p, f), real(c));
    const Whole power = hn::ShiftLeft<23>(wholeOf(hn::Add(n, real(127))));
    return hn::Mul(p, hn::BitCast(F(), power));
}

/// log₂ x for normal x > 0, to about 1e-7.
HWY_INLINE Real log2(Real x) {
    const Whole bits = hn::BitCast(I(), x);
    // The mantissa is taken in [√½, √2), where the series is shortest.
    const Whole shifted = hn::Sub(bits, whole(0x3f3504f3));
    const Whole exponent = hn::ShiftRight<23>(shifted);
    const Real m = hn::BitCast(F(), hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
    const Real z = hn::Div(hn::Sub(m, real(1)), hn::Add(m, real(1))), z2 = hn::Mul(z, z);
    Real p = real(0.3205989F);  // 2 / ln 2 · z (1 + z²/3 + z⁴/5 + z⁶/7 + …)
    for (const float c : {0.4121986F, 0.5770780F, 0.9617967F, 2.8853901F}) p = hn::Add(hn::Mul(p, z2), real(c));
    return hn::Add(hn::ConvertTo(F(), exponent), hn::Mul(p, z));
}

/// x^n for x in [0, 1]; 0 for x = 0 and n > 0, 1 for n = 0.
HWY_INLINE Real pow(Real x, float n) {
    const Real tiny = real(1e-30F);
    const Real result = exp2(hn::Mul(real(n), log2(hn::Max(x, tiny))));
    return n > 0 ? hn::IfThenElseZero(hn::Gt(x, tiny), result) : result;
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
