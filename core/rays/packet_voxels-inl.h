// Values and differences of a volume at many places at once, by gathers that fetch neighbours along i together.
// Included once for each target, hence no plain include guard.

#if defined(VOLEDIT_RAYS_PACKET_VOXELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLEDIT_RAYS_PACKET_VOXELS_INL
#undef VOLEDIT_RAYS_PACKET_VOXELS_INL
#else
#define VOLEDIT_RAYS_PACKET_VOXELS_INL
#endif

#include <hwy/highway.h>

#include "core/rays/packet_math-inl.h"
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

// Each kind of voxel reads the pair at a value's index, and the four about it. Whole numbers come without `bias`.

struct Voxels8 {
    /// Four bytes from each index on; `anywhere`: some may lie beyond the volume's end.
    template <bool anywhere>
    static HWY_INLINE Whole read(const VoxelAccess& s, Whole index) {
        const auto* bytes = reinterpret_cast<const std::int32_t*>(s.voxels);
        if constexpr (!anywhere) return hn::Xor(hn::GatherOffset(I(), bytes, index), whole(s.flip));
        // The last bytes of the volume are reached from a place before.
        const Whole at = hn::Min(index, whole(std::int32_t(s.bytes) - 4));
        const Whole word = hn::GatherOffset(I(), bytes, at);
        return hn::Xor(hn::Shr(word, hn::ShiftLeft<3>(hn::Sub(index, at))), whole(s.flip));
    }
    /// Whether the pairs of the cells at `index` can be read without a look at the volume's end.
    static HWY_INLINE bool within(const VoxelAccess& s, Whole index) {
        const Whole last = whole(std::int32_t(s.bytes) - 4 - s.row - s.slice);
        return hn::AllFalse(I(), hn::Gt(index, last));
    }
    template <int n>
    static HWY_INLINE Real byte(Whole word) {
        return hn::ConvertTo(F(), hn::And(hn::ShiftRight<8 * n>(word), whole(0xff)));
    }
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, Whole index) {
        const Whole word = read<anywhere>(s, index);
        return {byte<0>(word), byte<1>(word)};
    }
    static HWY_INLINE Four four(const VoxelAccess& s, Whole index) {
        const Whole word = read<false>(s, hn::Sub(index, whole(1)));
        return {byte<0>(word), byte<1>(word), byte<2>(word), byte<3>(word)};
    }
};

struct Voxels16 {
    static HWY_INLINE bool within(const VoxelAccess&, Whole) { return true; }
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, Whole index) {
        const auto* bytes = reinterpret_cast<const std::int32_t*>(s.voxels);
        const Whole word = hn::Xor(hn::GatherOffset(I(), bytes, hn::ShiftLeft<1>(index)), whole(s.flip));
        const auto high = hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<I>(), word));
        return {hn::ConvertTo(F(), hn::And(word, whole(0xffff))), hn::ConvertTo(F(), hn::BitCast(I(), high))};
    }
    static HWY_INLINE Four four(const VoxelAccess& s, Whole index) {
        const Pair low = pair(s, hn::Sub(index, whole(1))), high = pair(s, hn::Add(index, whole(1)));
        return {low.first, low.second, high.first, high.second};
    }
};

struct VoxelsFloat {
    static HWY_INLINE Real at(const VoxelAccess& s, Whole index) {
        return hn::GatherIndex(F(), reinterpret_cast<const float*>(s.voxels), index);
    }
    static HWY_INLINE bool within(const VoxelAccess&, Whole) { return true; }
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, Whole index) {
        return {at(s, index), at(s, hn::Add(index, whole(1)))};
    }
    static HWY_INLINE Four four(const VoxelAccess& s, Whole index) {
        const Pair low = pair(s, hn::Sub(index, whole(1))), high = pair(s, hn::Add(index, whole(1)));
        return {low.first, low.second, high.first, high.second};
    }
};

struct Voxels32 {
    static HWY_INLINE Real at(const VoxelAccess& s, Whole index) {
        return hn::ConvertTo(F(), hn::GatherIndex(I(), reinterpret_cast<const std::int32_t*>(s.voxels), index));
    }
    static HWY_INLINE bool within(const VoxelAccess&, Whole) { return true; }
    template <bool anywhere = false>
    static HWY_INLINE Pair pair(const VoxelAccess& s, Whole index) {
        return {at(s, index), at(s, hn::Add(index, whole(1)))};
    }
    static HWY_INLINE Four four(const VoxelAccess& s, Whole index) {
        const Pair low = pair(s, hn::Sub(index, whole(1))), high = pair(s, hn::Add(index, whole(1)));
        return {low.first, low.second, high.first, high.second};
    }
};

template <class Voxels, bool anywhere>
HWY_INLINE Real interpolated(const VoxelAccess& s, const Place& p, Whole at) {
    const auto row = [&](Whole index) HWY_ATTR {
        const Pair pair = Voxels::template pair<anywhere>(s, index);
        return lerp(pair.first, pair.second, p.u);
    };
    const Whole next = whole(s.row), above = hn::Add(at, whole(s.slice));
    const Real low = lerp(row(at), row(hn::Add(at, next)), p.v);
    const Real high = lerp(row(above), row(hn::Add(above, next)), p.v);
    return lerp(low, high, p.w);
}

/// The trilinear value, without `bias`.
template <class Voxels>
HWY_INLINE Real valueAt(const VoxelAccess& s, const Place& p) {
    const Whole at = indexOf(s, p);
    if (HWY_LIKELY(Voxels::within(s, at))) return interpolated<Voxels, false>(s, p, at);
    return interpolated<Voxels, true>(s, p, at);
}

/// Differences of one voxel along the index axes as volume.h defines them, of places at least one sample away from
/// every face (1 ≤ below ≤ size − 3); others get anything.
template <class Voxels>
HWY_INLINE Real3 innerDifferences(const VoxelAccess& s, const Place& p) {
    Place inner = p;
    inner.i = hn::Min(hn::Max(p.i, whole(1)), whole(s.size[0] - 3));
    inner.j = hn::Min(hn::Max(p.j, whole(1)), whole(s.size[1] - 3));
    inner.k = hn::Min(hn::Max(p.k, whole(1)), whole(s.size[2] - 3));
    const Whole at = indexOf(s, inner), row = whole(s.row), slice = whole(s.slice);
    Real slope[2][2], value[2][2];
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j) {
            const Whole index = hn::Add(at, whole(j * s.row + k * s.slice));
            const Four v = Voxels::four(s, index);
            slope[k][j] = hn::Sub(lerp(v.second, v.after, p.u), lerp(v.before, v.first, p.u));
            value[k][j] = lerp(v.first, v.second, p.u);
        }
    const auto outer = [&](Whole index) HWY_ATTR {
        const Pair pair = Voxels::pair(s, index);
        return lerp(pair.first, pair.second, p.u);
    };
    // Along j: rows −1 and 2 of both slices; along k: both rows of slices −1 and 2.
    Real alongJ[2], alongK[2];
    for (int k = 0; k < 2; ++k) {
        const Whole base = hn::Add(at, whole(k * s.slice));
        const Real before = outer(hn::Sub(base, row)), after = outer(hn::Add(base, whole(2 * s.row)));
        alongJ[k] = hn::Sub(lerp(value[k][1], after, p.v), lerp(before, value[k][0], p.v));
    }
    for (int j = 0; j < 2; ++j) {
        const Whole base = hn::Add(at, whole(j * s.row));
        const Real before = outer(hn::Sub(base, slice)), after = outer(hn::Add(base, whole(2 * s.slice)));
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
