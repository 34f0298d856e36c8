// The light of what a packet's rays see: gradients, cuts, lamps and surroundings. Included once for each target, hence
// no plain include guard.

#if defined(VOLEDIT_RAYS_PACKET_SHADER_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLEDIT_RAYS_PACKET_SHADER_INL
#undef VOLEDIT_RAYS_PACKET_SHADER_INL
#else
#define VOLEDIT_RAYS_PACKET_SHADER_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <optional>

#include "core/eval/surroundings.h"
#include "core/rays/packet_caster.h"
#include "core/rays/packet_pieces-inl.h"
#include "core/rays/packet_voxels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

// Light is not followed anew for what contributes less; as the reference has it.
constexpr float kSlight = 1 / 512.0F;
// What contributes less is left unlit.
constexpr float kFaint = 5e-5F;

/// The position of lanes at u, between samples of the volume.
HWY_INLINE Real3 positionAt(const Lanes& lanes, const VoxelAccess& access, Real u) {
    const auto along = [&](std::size_t a) HWY_ATTR {
        const Real x = hn::Add(lanes.start[a], hn::Mul(u, lanes.step[a]));
        return hn::Min(hn::Max(x, hn::Zero(F())), real(access.beforeLast[a]));
    };
    return {along(0), along(1), along(2)};
}

/// Lights what the rays of one packet see, each lane at its own depth u on its present piece.
template <class Voxels>
class PacketShader {
public:
    PacketShader(const PacketVolume& volume, const VoxelAccess& access, const RayPacket& packet, Lanes& lanes)
        : volume_(volume),
          access_(access),
          packet_(packet),
          lanes_(lanes),
          cutReach_(volume.cuts.finder ? static_cast<float>(2 * volume.cuts.finder->thickness() / volume.cuts.step)
                                       : 0) {}

    /// Lights the `color` of visible lanes that contribute `weight`, where the gradient at u has a direction
    /// (core/scene/lighting.h).
    HWY_INLINE void shade(Mask visible, Real u, Real weight, Real* color) {
        Mask lit = hn::And(visible, hn::Gt(weight, real(kFaint)));
        if (hn::AllFalse(F(), lit)) return;
        const PacketLight& light = volume_.light;
        Real3 g = gradient(lit, u);
        if (volume_.cuts.finder) {
            const Mask near = hn::And(lit, hn::Lt(hn::Sub(u, lanes_.run), real(cutReach_)));
            if (HWY_UNLIKELY(!hn::AllFalse(F(), near))) g = atCuts(near, u, g);
        }
        const Real largest = hn::Max(hn::Max(hn::Abs(g.x), hn::Abs(g.y)), hn::Abs(g.z));
        lit = hn::And(lit, hn::And(hn::Gt(largest, hn::Zero(F())), hn::Lt(largest, real(3e38F))));
        // By the largest component first: squares of steep gradients overflow.
        const Real inverse = hn::Div(real(1), hn::IfThenElse(lit, largest, real(1)));
        g = {hn::Mul(g.x, inverse), hn::Mul(g.y, inverse), hn::Mul(g.z, inverse)};
        const Real3 toEye{load(packet_.toEye[0].data()), load(packet_.toEye[1].data()), load(packet_.toEye[2].data())};
        const Real steepness = hn::Sqrt(hn::IfThenElse(lit, dot(g, g), real(1)));
        if (HWY_UNLIKELY(light.surroundings != nullptr)) followLight(lit, u, weight);
        Real spread, shine;
        if (light.kind == Lights::Kind::Head) {
            spread = hn::Div(hn::Abs(dot(g, toEye)), steepness);
            shine = pow(hn::Min(spread, real(1)), light.shininess);
        } else {
            const Real inverseSteepness = hn::Div(real(1), steepness);
            g = {hn::Mul(g.x, inverseSteepness), hn::Mul(g.y, inverseSteepness), hn::Mul(g.z, inverseSteepness)};
            lightFromAfar(g, toEye, spread, shine);
        }
        Real all = real(light.ambient);
        if (HWY_UNLIKELY(light.surroundings != nullptr)) {
            all = hn::Mul(all, load(share_[1].data()));
            if (light.kind == Lights::Kind::Head) {
                spread = hn::Mul(spread, load(share_[0].data()));
                shine = hn::Mul(shine, load(share_[0].data()));
            }
        }
        all = hn::Add(all, hn::Mul(real(light.diffuse), spread));
        shine = hn::Mul(real(light.specular), shine);
        for (int c = 0; c < 3; ++c) color[c] = hn::IfThenElse(lit, hn::Add(hn::Mul(color[c], all), shine), color[c]);
    }

    /// The optical depth of stretches at whose middles, u, opacity also depends on the gradient.
    HWY_NOINLINE Real steepened(Mask visible, Real u, Real depth, Real length) const {
        const SteepnessTable& table = *volume_.steepness;
        const Real3 g = turnedBy(volume_.ownTurn, differences(visible, u));
        const Real magnitude = hn::Sqrt(dot(g, g));
        const Real inside = hn::Min(hn::Mul(magnitude, real(table.scale)), real(float(table.last)));
        // Of voxels that are not numbers there is none.
        const Real below = hn::Floor(hn::IfThenElseZero(hn::And(visible, hn::Eq(inside, inside)), inside));
        const Places at = placesOf(wholeOf(below)), next = placesOf(hn::Add(at.index, whole(1)));
        const Real factor =
            lerp(realsAt(table.factor.data(), at), realsAt(table.factor.data(), next), hn::Sub(inside, below));
        // Of an opacity distance, in which opacity is meant.
        const Real distances = hn::Max(hn::Mul(length, real(volume_.unit)), real(1e-20F));
        const Real through = exp2(hn::Mul(hn::Div(depth, distances), real(-1.44269504F)));
        const Real opacity = hn::Min(hn::Mul(hn::Sub(real(1), through), factor), real(0.9999F));
        const Real extinction = hn::Mul(log2(hn::Sub(real(1), opacity)), real(-0.69314718F));
        return hn::Mul(hn::Max(extinction, hn::Zero(F())), distances);
    }

private:
    /// The gradient at u turned to world space, of any length.
    HWY_INLINE Real3 gradient(Mask lit, Real u) const {
        const Real3 g = differences(lit, u);
        return volume_.cells ? turnedByCells(lit, u, g) : turnedBy(volume_.turn, g);
    }

    static HWY_INLINE Real3 turnedBy(const GradientTurn& turn, const Real3& g) {
        const auto row = [&](std::size_t r) HWY_ATTR {
            return hn::Add(hn::Add(hn::Mul(real(turn[0][r]), g.x), hn::Mul(real(turn[1][r]), g.y)),
                           hn::Mul(real(turn[2][r]), g.z));
        };
        return {row(0), row(1), row(2)};
    }

    /// Differences of one voxel at u.
    HWY_INLINE Real3 differences(Mask lit, Real u) const {
        const Place place = placeOf(positionAt(lanes_, access_, u));
        const bool thin = access_.size[0] < 4 || access_.size[1] < 4 || access_.size[2] < 4;
        Real3 g{hn::Zero(F()), hn::Zero(F()), hn::Zero(F())};
        Mask faces = lit;
        if (!thin) {
            g = innerDifferences<Voxels>(access_, place);
            faces = hn::And(lit, atFaces(access_, place));
        }
        if (HWY_UNLIKELY(!hn::AllFalse(F(), faces))) g = differencesAtFaces(faces, place, g);
        return g;
    }

    /// Gradients turned by what the corners of each lane's cell say, interpolated at u.
    HWY_NOINLINE Real3 turnedByCells(Mask lit, Real u, const Real3& differences) const {
        alignas(64) RayPacket::Lanes at[3], g[3];
        const Real components[3] = {differences.x, differences.y, differences.z};
        for (std::size_t a = 0; a < 3; ++a) {
            hn::Store(hn::Add(load(packet_.base[a].data()), hn::Mul(u, load(packet_.along[a].data()))), F(),
                      at[a].data());
            hn::Store(components[a], F(), g[a].data());
        }
        forLanes(bitsOf(lit), [&](std::size_t l) HWY_ATTR {
            const auto turnedBy = [&](const GradientTurn& turn) HWY_ATTR {
                return quad(turn[0]) * g[0][l] + quad(turn[1]) * g[1][l] + quad(turn[2]) * g[2][l];
            };
            Quad turned{};
            if (const OwnPiece* piece = lanes_.own(l); HWY_UNLIKELY(piece != nullptr)) {
                turned = turnedBy(piece->turn);
            } else {
                const auto& plane = lanes_.cell(l).plane;
                const auto& corners = lanes_.corners(l);
                Quad weight =
                    quad(plane[0]) * at[0][l] + quad(plane[1]) * at[1][l] + quad(plane[2]) * at[2][l] + quad(plane[3]);
                weight = weight > 0 ? weight : Quad{};  // rounding may take the point out of its cell
                for (std::size_t v = 0; v < 4; ++v) turned += weight[v] * turnedBy(volume_.cells->turn[corners[v]]);
            }
            for (std::size_t a = 0; a < 3; ++a) g[a][l] = turned[a];
        });
        return {load(g[0].data()), load(g[1].data()), load(g[2].data())};
    }

    HWY_NOINLINE Real3 differencesAtFaces(Mask faces, const Place& place, const Real3& inner) const {
        alignas(64) std::array<std::array<float, RayPacket::kMost>, 3> x, g;
        const Whole below[3] = {place.i, place.j, place.k};
        const Real fraction[3] = {place.u, place.v, place.w}, differences[3] = {inner.x, inner.y, inner.z};
        for (std::size_t a = 0; a < 3; ++a) {
            hn::Store(hn::Add(hn::ConvertTo(F(), below[a]), fraction[a]), F(), x[a].data());
            hn::Store(differences[a], F(), g[a].data());
        }
        forLanes(bitsOf(faces), [&](std::size_t l) {
            const auto exact = differencesAt(*volume_.volume, {x[0][l], x[1][l], x[2][l]});
            for (std::size_t a = 0; a < 3; ++a) g[a][l] = exact[a];
        });
        return {load(g[0].data()), load(g[1].data()), load(g[2].data())};
    }

    /// Lanes at u that may have passed a cut less than cutReach_ before: all where maps have gaps, else those whose
    /// runs begin where a map's cells end, and those so near a face of the volume.
    HWY_INLINE Mask mayBeCut(Mask near, Real u) const {
        if (volume_.cuts.gaps) return near;
        Mask outside = maskOf(lanes_.atEnd());
        for (std::size_t a = 0; a < 3; ++a) {
            const Real x = hn::Add(lanes_.start[a], hn::Mul(u, lanes_.step[a]));
            // Maps bend: twice as far.
            const Real reach = hn::Mul(hn::Abs(lanes_.step[a]), real(2 * cutReach_));
            outside = hn::Or(outside, hn::Lt(x, reach));
            outside = hn::Or(outside, hn::Gt(hn::Add(x, reach), real(access_.beforeLast[a])));
        }
        return hn::And(near, outside);
    }

    /// Gradients with the normals of cuts in them (core/eval/cut_faces), of lanes shortly behind the beginning of a
    /// run.
    HWY_NOINLINE Real3 atCuts(Mask near, Real u, const Real3& gradient) {
        const PacketCuts& cuts = volume_.cuts;
        alignas(64) RayPacket::Lanes at, g[3];
        hn::Store(u, F(), at.data());
        const Real components[3] = {gradient.x, gradient.y, gradient.z};
        for (std::size_t a = 0; a < 3; ++a) hn::Store(components[a], F(), g[a].data());
        const std::uint32_t possible = bitsOf(mayBeCut(near, u));
        forLanes(bitsOf(near), [&](std::size_t l) {
            const double depth = double(packet_.distance[l]) + double(at[l]) * cuts.step;
            const Vec3 direction(-packet_.toEye[0][l], -packet_.toEye[1][l], -packet_.toEye[2][l]);
            if (lanes_.newRun(l)) {
                cut_[l].reset();
                if (possible >> l & 1) cut_[l] = cuts.finder->before(cuts.eye, direction, depth);
                if (possible >> l & 1 && !cut_[l] && cuts.ahead > 0)
                    cut_[l] = cuts.finder->before(cuts.eye, direction, depth + cuts.ahead);
            }
            if (!cut_[l]) return;
            const Vec3 blended =
                cuts.finder->blended(*cut_[l], cuts.eye + depth * direction, depth, Vec3(g[0][l], g[1][l], g[2][l]));
            for (std::size_t a = 0; a < 3; ++a) g[a][l] = static_cast<float>(blended[int(a)]);
        });
        return {load(g[0].data()), load(g[1].data()), load(g[2].data())};
    }

    static HWY_INLINE Real dot(const Real3& a, const Real3& b) {
        return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
    }

    /// Sums of diffuse light and of highlights on a surface with unit normal n.
    HWY_NOINLINE void lightFromAfar(Real3 n, const Real3& toEye, Real& spread, Real& shine) const {
        const PacketLight& light = volume_.light;
        const bool twoSided = light.kind == Lights::Kind::Fixed;
        if (!twoSided) {
            const Mask away = hn::Lt(dot(n, toEye), hn::Zero(F()));
            const auto turned = [&](Real x) HWY_ATTR { return hn::IfThenElse(away, hn::Neg(x), x); };
            n = {turned(n.x), turned(n.y), turned(n.z)};
        }
        const auto facing = [&](Real cosine) HWY_ATTR {
            return hn::Min(twoSided ? hn::Abs(cosine) : hn::Max(cosine, hn::Zero(F())), real(1));
        };
        spread = shine = hn::Zero(F());
        for (std::size_t l = 0; l < light.count; ++l) {
            const PacketLight::Far& far = light.lights[l];
            const Real3 toward{real(far.toward[0]), real(far.toward[1]), real(far.toward[2])};
            const Real3 between{hn::Add(toward.x, toEye.x), hn::Add(toward.y, toEye.y), hn::Add(toward.z, toEye.z)};
            const Real width = dot(between, between), lit = facing(dot(n, toward));
            Mask high = hn::Gt(width, real(1e-12F));
            if (!twoSided) high = hn::And(high, hn::Gt(lit, hn::Zero(F())));
            const Real cosine = hn::Div(dot(n, between), hn::Sqrt(hn::IfThenElse(high, width, real(1))));
            Real intensity = real(far.intensity);
            if (l == 0 && light.surroundings) intensity = hn::Mul(intensity, load(share_[0].data()));
            spread = hn::Add(spread, hn::Mul(intensity, lit));
            shine = hn::Add(shine, hn::IfThenElseZero(high, hn::Mul(intensity, pow(facing(cosine), light.shininess))));
        }
    }

    /// Finds anew what surroundings leave of the light at u, where that counts.
    HWY_NOINLINE void followLight(Mask lit, Real u, Real weight) {
        const PacketLight& light = volume_.light;
        alignas(64) RayPacket::Lanes at, counts;
        hn::Store(u, F(), at.data());
        hn::Store(weight, F(), counts.data());
        forLanes(bitsOf(lit), [&](std::size_t l) {
            if ((shared_ >> l & 1U) && counts[l] <= kSlight) return;
            shared_ |= 1U << l;
            const Vec3 toEye(packet_.toEye[0][l], packet_.toEye[1][l], packet_.toEye[2][l]);
            const Vec3 p = light.eye - (double(packet_.distance[l]) + double(at[l]) * light.step) * toEye;
            const LightShare share = light.surroundings->at(p, toEye);
            share_[0][l] = static_cast<float>(share.first);
            share_[1][l] = static_cast<float>(share.ambient);
        });
    }

    const PacketVolume& volume_;
    const VoxelAccess& access_;
    const RayPacket& packet_;
    Lanes& lanes_;
    float cutReach_;                                            // steps
    std::array<std::optional<CutFace>, RayPacket::kMost> cut_;  // of each lane's run
    std::uint32_t shared_ = 0;                                  // lanes that know …
    alignas(64) RayPacket::Lanes share_[2] = {};  // … what is left of the first light and of the ambient one
};

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
