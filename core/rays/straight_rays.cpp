#include "core/rays/straight_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/rays/straight_rays.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

#include "core/rays/packet_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

HWY_INLINE Real along(const std::array<StraightRays::Numbers, 3>& direction, std::size_t a, Real x, Real y) {
    return hn::Add(hn::Add(real(direction[0][a]), hn::Mul(x, real(direction[1][a]))),
                   hn::Mul(y, real(direction[2][a])));
}

bool setUpStraightHere(const StraightRays& rays, Index2 at, RayPacket& packet,
                       std::span<CellHit, RayPacket::kMost> hits) {
    const Index2 shape = packetShape();
    alignas(64) RayPacket::Lanes offsetX, offsetY, begin, end;
    const auto lanes = std::size_t(shape.x * shape.y);
    for (std::size_t l = 0; l < lanes; ++l) {
        offsetX[l] = float(at.x + int(l) % shape.x);
        offsetY[l] = float(at.y + int(l) / shape.x);
    }
    const Real x = load(offsetX.data()), y = load(offsetY.data());
    Real near = hn::Zero(F()), far = real(1e30F), nearVisible = near, farVisible = far;
    Real direction[3];
    for (std::size_t a = 0; a < 3; ++a) {
        const Real d = direction[a] = along(rays.index, a, x, y);
        const Real inverse = hn::Div(real(1), hn::IfThenElse(hn::Eq(d, hn::Zero(F())), real(1e-30F), d));
        const auto cut = [&](float low, float high, Real& from, Real& to) HWY_ATTR {
            const Real one = hn::Mul(real(low - rays.eye[a]), inverse),
                       other = hn::Mul(real(high - rays.eye[a]), inverse);
            from = hn::Max(from, hn::Min(one, other));
            to = hn::Min(to, hn::Max(one, other));
        };
        cut(rays.domainMin[a], rays.domainMax[a], near, far);
        cut(rays.visibleMin[a], rays.visibleMax[a], nearVisible, farVisible);
    }
    const Mask met = hn::And(hn::Lt(near, far), hn::Le(nearVisible, farVisible));
    const std::uint32_t bits = bitsOf(met);
    Real world[3], square = hn::Zero(F());
    for (std::size_t a = 0; a < 3; ++a) {
        world[a] = along(rays.world, a, x, y);
        square = hn::Add(square, hn::Mul(world[a], world[a]));
    }
    const Real length = hn::Sqrt(square), perStep = hn::Div(length, real(rays.step)), step = hn::Div(real(1), perStep);
    const Real toEye = hn::Div(real(-1), length);
    for (std::size_t a = 0; a < 3; ++a) {
        hn::Store(hn::Add(real(rays.eye[a]), hn::Mul(near, direction[a])), F(), packet.base[a].data());
        hn::Store(hn::Mul(step, direction[a]), F(), packet.along[a].data());
        hn::Store(hn::Mul(world[a], toEye), F(), packet.toEye[a].data());
    }
    hn::Store(hn::Mul(near, length), F(), packet.distance.data());
    const Real until = hn::Max(hn::Mul(hn::Sub(nearVisible, near), perStep), hn::Zero(F()));
    hn::Store(hn::Floor(until), F(), begin.data());
    hn::Store(hn::Mul(hn::Sub(far, near), perStep), F(), end.data());
    for (std::size_t l = 0; l < lanes; ++l) packet.hits[l] = {};
    forLanes(bits, [&](std::size_t l) {
        hits[l] = {begin[l], end[l], 0};
        packet.hits[l] = std::span(&hits[l], 1);
    });
    return bits != 0;
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voledit {

HWY_EXPORT(setUpStraightHere);

bool setUpStraight(const StraightRays& rays, Index2 at, RayPacket& packet, std::span<CellHit, RayPacket::kMost> hits) {
    return HWY_DYNAMIC_DISPATCH(setUpStraightHere)(rays, at, packet, hits);
}

}  // namespace voledit
#endif
