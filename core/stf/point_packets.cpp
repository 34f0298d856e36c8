#include "core/stf/point_packets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/stf/point_packets.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = HWY_CAPPED(double, 8);
using Real = hn::Vec<D>;
using Mask = hn::Mask<D>;

HWY_INLINE Real real(double x) {
    return hn::Set(D(), x);
}

/// Up to a vector of points, and what was found for them.
class Packet {
public:
    HWY_INLINE explicit Packet(std::span<const Vec3> p) : open_(hn::FirstN(D(), p.size())) {
        HWY_ALIGN double at[3][8];
        for (std::size_t l = 0; l < hn::Lanes(D()); ++l) {
            const Vec3& point = p[l < p.size() ? l : 0];
            for (int a = 0; a < 3; ++a) at[a][l] = point[a];
        }
        x_ = hn::Load(D(), at[0]);
        y_ = hn::Load(D(), at[1]);
        z_ = hn::Load(D(), at[2]);
        tetrahedron_ = real(PacketFound::kNowhere);
        w1_ = w2_ = w3_ = hn::Zero(D());
    }

    HWY_INLINE bool done() const { return hn::AllFalse(D(), open_); }

    HWY_INLINE void tryCell(const PacketCells& cells, std::uint32_t cell) {
        Mask within = hn::And(open_, inside(cells.boxes[cell]));
        const std::uint32_t end = cells.perCell * (cell + 1);
        for (std::uint32_t t = cells.perCell * cell; t < end && !hn::AllFalse(D(), within); ++t)
            tryTetrahedron(cells.tetrahedra[t], t, within);
    }

    HWY_INLINE void store(std::span<PacketFound> found) const {
        HWY_ALIGN double t[8], w[3][8];
        hn::Store(tetrahedron_, D(), t);
        hn::Store(w1_, D(), w[0]);
        hn::Store(w2_, D(), w[1]);
        hn::Store(w3_, D(), w[2]);
        for (std::size_t l = 0; l < found.size(); ++l)
            found[l] = {static_cast<std::uint32_t>(t[l]), {w[0][l], w[1][l], w[2][l]}};
    }

private:
    HWY_INLINE Mask inside(const Box3& box) const {
        const auto between = [](Real v, double low, double high)
                                 HWY_ATTR { return hn::And(hn::Ge(v, real(low)), hn::Le(v, real(high))); };
        return hn::And(between(x_, box.min.x, box.max.x),
                       hn::And(between(y_, box.min.y, box.max.y), between(z_, box.min.z, box.max.z)));
    }

    // Operation by operation as CellLocator::weights, without fused ones, so that both accept the same points.
    HWY_INLINE void tryTetrahedron(const CellLocator::Inverse& m, std::uint32_t t, Mask& within) {
        const Real dx = hn::Sub(x_, real(m.origin.x)), dy = hn::Sub(y_, real(m.origin.y)),
                   dz = hn::Sub(z_, real(m.origin.z));
        const auto row = [&](int r) HWY_ATTR {
            const Real first =
                hn::Add(hn::Mul(real(m.weightsFromEdge[0][r]), dx), hn::Mul(real(m.weightsFromEdge[1][r]), dy));
            return hn::Add(first, hn::Mul(real(m.weightsFromEdge[2][r]), dz));
        };
        const Real w1 = row(0), w2 = row(1), w3 = row(2);
        const Real w0 = hn::Sub(hn::Sub(hn::Sub(real(1), w1), w2), w3);
        const auto accepted = [&](Real w, std::size_t i) HWY_ATTR { return hn::Ge(w, real(-m.tolerance[i])); };
        const Mask all = hn::And(hn::And(accepted(w0, 0), accepted(w1, 1)), hn::And(accepted(w2, 2), accepted(w3, 3)));
        const Mask now = hn::And(all, within);
        if (HWY_LIKELY(hn::AllFalse(D(), now))) return;
        tetrahedron_ = hn::IfThenElse(now, real(t), tetrahedron_);
        w1_ = hn::IfThenElse(now, w1, w1_);
        w2_ = hn::IfThenElse(now, w2, w2_);
        w3_ = hn::IfThenElse(now, w3, w3_);
        within = hn::AndNot(now, within);
        open_ = hn::AndNot(now, open_);
    }

    Real x_, y_, z_;
    Mask open_;  // not found yet
    Real tetrahedron_, w1_, w2_, w3_;
};

void locateAll(const PacketCells& cells, std::span<const std::uint32_t> candidates, std::span<const Vec3> p,
               std::span<PacketFound> found) {
    const std::size_t lanes = hn::Lanes(D());
    for (std::size_t at = 0; at < p.size(); at += lanes) {
        const std::size_t count = p.size() - at < lanes ? p.size() - at : lanes;
        Packet packet(p.subspan(at, count));
        for (const std::uint32_t cell : candidates) {
            packet.tryCell(cells, cell);
            if (packet.done()) break;
        }
        packet.store(found.subspan(at, count));
    }
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace voledit {

HWY_EXPORT(locateAll);

void locatePackets(const PacketCells& cells, std::span<const std::uint32_t> candidates, std::span<const Vec3> p,
                   std::span<PacketFound> found) {
    HWY_DYNAMIC_DISPATCH(locateAll)(cells, candidates, p, found);
}

}  // namespace voledit

#endif
