// Values and differences of a volume at many places at once, by gathers that fetch neighbours along i together.
// Included once for each target, hence no plain include guard.

#if defined(VOLEDIT_RAYS_PACKET_VOXELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLEDIT_RAYS_PACKET_VOXELS_INL
#undef VOLEDIT_RAYS_PACKET_VOXELS_INL
#else
#define VOLEDIT_RAYS_PACKET_VOXELS_INL
#endif

#include <hwy/highway.h>

#include "core/rays/packet_gather-inl.h"
#include "core/rays/packet_scene.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

struct Real3 {
    Real x, y, z;
};

/// A place between samples: the sample below it on each axis, and how far beyond that it lies.
struct Place {
    Whole i, j, k;
    Real u, v, w;
};

/// The place of x, which lies in [0, size − 1).
HWY_INLINE void locate(Real x, Whole& below, Real& fraction) {
    const Real floor = hn::Floor(x);
    below = wholeOf(floor);
    fraction = hn::Sub(x, floor);
}
HWY_INLINE Place placeOf(const Real3& x) {
    Place p;
    locate(x.x, p.i, p.u);
    locate(x.y, p.j, p.v);
    locate(x.z, p.k, p.w);
    return p;
}
HWY_INLINE Whole indexOf(const VoxelAccess& s, const Place& p) {
    return hn::Add(p.i, hn::Add(hn::Mul(p.j, whole(s.row)), hn::Mul(p.k, whole(s.slice))));
}

/// Two neighbours along i, and four.
struct Pair {
    Real first, second;
};
struct Four {
    Real before, first, second, after;
};

// Each kind of voxel reads the pair at a value's index and offset, and the four about it. Whole numbers come without
// `bias`.

struct Voxels8 {
    /// Whether the pairs of the cells at `index` can be read without a look at the volume's end.
    static HWY_INLINE bool within(const VoxelAccess& s, Whole index) {
        const Whole last = whole(std::int32_t(s.bytes) - 4 - s.row - s.slice);
        return hn::AllFalse(I(), hn::Gt(index, last));
    }
    template <int n>
    static HWY_INLINE Real byte(Whole word) {
        return hn::ConvertTo(F(), hn::And(hn::ShiftRight<8 * n>(word), whole(0xff)));
    }
    /// `anywhere`: some of the four bytes that are read may lie beyond the volume's end.
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, const Places& at, std::ptrdiff_t offset) {
        Whole word = whole(0);
        if constexpr (anywhere) {
            // The last bytes of the volume are reached from a place before.
            const Whole index = hn::Add(at.index, whole(std::int32_t(offset)));
            const Whole before = hn::Min(index, whole(std::int32_t(s.bytes) - 4));
            word = hn::GatherOffset(I(), reinterpret_cast<const std::int32_t*>(s.voxels), before);
            word = hn::Shr(word, hn::ShiftLeft<3>(hn::Sub(index, before)));
        } else {
            word = wordsAt<1>(s.voxels, at, offset);
        }
        word = hn::Xor(word, whole(s.flip));
        return {byte<0>(word), byte<1>(word)};
    }
    static HWY_INLINE Four four(const VoxelAccess& s, const Places& at, std::ptrdiff_t offset) {
        const Whole word = hn::Xor(wordsAt<1>(s.voxels, at, offset - 1), whole(s.flip));
        return {byte<0>(word), byte<1>(word), byte<2>(word), byte<3>(word)};
    }
};

/// Kinds of which no read reaches beyond the volume's end.
template <class Kind>
struct WideVoxels {
    static HWY_INLINE bool within(const VoxelAccess&, Whole) { return true; }
    static HWY_INLINE Four four(const VoxelAccess& s, const Places& at, std::ptrdiff_t offset) {
        const Pair low = Kind::pair(s, at, offset - 1), high = Kind::pair(s, at, offset + 1);
        return {low.first, low.second, high.first, high.second};
    }
};

struct Voxels16 : WideVoxels<Voxels16> {
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, const Places& at, std::ptrdiff_t offset) {
        const Whole word = hn::Xor(wordsAt<2>(s.voxels, at, offset), whole(s.flip));
        const auto high = hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<I>(), word));
        return {hn::ConvertTo(F(), hn::And(word, whole(0xffff))), hn::ConvertTo(F(), hn::BitCast(I(), high))};
    }
};

struct VoxelsFloat : WideVoxels<VoxelsFloat> {
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, const Places& at, std::ptrdiff_t offset) {
        return {hn::BitCast(F(), wordsAt<4>(s.voxels, at, offset)),
                hn::BitCast(F(), wordsAt<4>(s.voxels, at, offset + 1))};
    }
};

struct Voxels32 : WideVoxels<Voxels32> {
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, const Places& at, std::ptrdiff_t offset) {
        return {hn::ConvertTo(F(), wordsAt<4>(s.voxels, at, offset)),
                hn::ConvertTo(F(), wordsAt<4>(s.voxels, at, offset + 1))};
    }
};

template <class Voxels, bool anywhere>
HWY_INLINE Real interpolated(const VoxelAccess& s, const Place& p, const Places& at) {
    const auto row = [&](std::ptrdiff_t offset) HWY_ATTR {
        const Pair pair = Voxels::template pair<anywhere>(s, at, offset);
        return lerp(pair.first, pair.second, p.u);
    };
    const Real low = lerp(row(0), row(s.row), p.v);
    const Real high = lerp(row(s.slice), row(s.slice + s.row), p.v);
    return lerp(low, high, p.w);
}

/// The trilinear values at two places of each lane, without `bias`. Together, since each waits for its voxels.
template <class Voxels>
HWY_INLINE void valuesAt(const VoxelAccess& s, const Place (&p)[2], Real (&values)[2]) {
    const Places at[2] = {placesOf(indexOf(s, p[0])), placesOf(indexOf(s, p[1]))};
    if (HWY_LIKELY(Voxels::within(s, hn::Max(at[0].index, at[1].index)))) {
        for (int n = 0; n < 2; ++n) values[n] = interpolated<Voxels, false>(s, p[n], at[n]);
    } else {
        for (int n = 0; n < 2; ++n) values[n] = interpolated<Voxels, true>(s, p[n], at[n]);
    }
}

/// Differences of one voxel along the index axes as volume.h defines them, of places at least one sample away from
/// every face (1 ≤ below ≤ size − 3); others get anything.
template <class Voxels>
HWY_INLINE Real3 innerDifferences(const VoxelAccess& s, const Place& p) {
    Place inner = p;
    inner.i = hn::Min(hn::Max(p.i, whole(1)), whole(s.size[0] - 3));
    inner.j = hn::Min(hn::Max(p.j, whole(1)), whole(s.size[1] - 3));
    inner.k = hn::Min(hn::Max(p.k, whole(1)), whole(s.size[2] - 3));
    const Places at = placesOf(indexOf(s, inner));
    const std::ptrdiff_t row = s.row, slice = s.slice;
    Real slope[2][2], value[2][2];
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j) {
            const Four v = Voxels::four(s, at, j * row + k * slice);
            slope[k][j] = hn::Sub(lerp(v.second, v.after, p.u), lerp(v.before, v.first, p.u));
            value[k][j] = lerp(v.first, v.second, p.u);
        }
    const auto outer = [&](std::ptrdiff_t offset) HWY_ATTR {
        const Pair pair = Voxels::pair(s, at, offset);
        return lerp(pair.first, pair.second, p.u);
    };
    // Along j: rows −1 and 2 of both slices; along k: both rows of slices −1 and 2.
    Real alongJ[2], alongK[2];
    for (int k = 0; k < 2; ++k) {
        const Real before = outer(k * slice - row), after = outer(k * slice + 2 * row);
        alongJ[k] = hn::Sub(lerp(value[k][1], after, p.v), lerp(before, value[k][0], p.v));
    }
    for (int j = 0; j < 2; ++j) {
        const Real before = outer(j * row - slice), after = outer(j * row + 2 * slice);
        alongK[j] = hn::Sub(lerp(value[1][j], after, p.w), lerp(before, value[0][j], p.w));
    }
    const Real half = real(0.5F);
    const Real x = lerp(lerp(slope[0][0], slope[0][1], p.v), lerp(slope[1][0], slope[1][1], p.v), p.w);
    return {hn::Mul(half, x), hn::Mul(half, lerp(alongJ[0], alongJ[1], p.w)),
            hn::Mul(half, lerp(alongK[0], alongK[1], p.v))};
}

/// Lanes of which innerDifferences tells nothing.
HWY_INLINE Mask atFaces(const VoxelAccess& s, const Place& p) {
    const auto near = [](Whole n, int size)
                          HWY_ATTR { return hn::Or(hn::Lt(n, whole(1)), hn::Gt(n, whole(size - 3))); };
    return hn::RebindMask(F(), hn::Or(near(p.i, s.size[0]), hn::Or(near(p.j, s.size[1]), near(p.k, s.size[2]))));
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
