#include "core/rays/packet_caster.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/rays/packet_caster.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

#include "core/rays/packet_pieces-inl.h"
#include "core/rays/packet_shader-inl.h"
#include "core/rays/packet_voxels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

// Below this transmittance a ray ends: a tenth of what 8 bits show.
constexpr float kOpaque = 4e-4F;
// How far short of an empty region's end a stride stays, in steps: more than rounding makes of it.
constexpr float kShort = 2e-3F;

template <class Voxels>
class Caster {
public:
    Caster(const PacketVolume& volume, const VoxelAccess& access, RayPacket& packet)
        : volume_(volume),
          access_(access),
          table_(*volume.table),
          skip_(*volume.skip),
          packet_(packet),
          lanes_(volume, packet),
          side_(real(float(1 << skip_.shift))),
          perSide_(real(1.0F / float(1 << skip_.shift))),
          scale_(real(table_.scale)),
          offset_(real((table_.low + access.bias) * table_.scale)),
          shader_(volume, access, packet, lanes_) {}

    void run() {
        active_ = maskOf(lanes_.alive());
        u_ = lanes_.begin;
        visited_ = have_ = none();
        knowsColor_ = none();
        bin_ = hn::Zero(I());
        depth_ = hn::Zero(F());
        transmittance_ = real(1);
        for (Real& c : color_) c = hn::Zero(F());
        for (Real& c : atBin_) c = hn::Zero(F());
        findBrick(positionAt(lanes_, access_, u_));
        while (advance()) {
        }
        for (std::size_t c = 0; c < 3; ++c) hn::Store(color_[c], F(), packet_.color[c].data());
        hn::Store(transmittance_, F(), packet_.transmittance.data());
    }

private:
    HWY_INLINE void findBrick(const Real3& x) {
        brick_[0] = hn::Floor(hn::Mul(x.x, perSide_));
        brick_[1] = hn::Floor(hn::Mul(x.y, perSide_));
        brick_[2] = hn::Floor(hn::Mul(x.z, perSide_));
        // Fewer bricks than a float counts.
        const Real at = hn::Add(brick_[0], hn::Mul(real(float(skip_.count.x)),
                                                   hn::Add(brick_[1], hn::Mul(real(float(skip_.count.y)), brick_[2]))));
        distance_ = bytesAt(skip_.distance.data(), placesOf(wholeOf(at)));
    }

    /// Where the ray leaves the bricks that are known to be empty about its own; ≥ u.
    HWY_INLINE Real emptyUntil() const {
        const Real distance = hn::ConvertTo(F(), distance_), behind = hn::Sub(real(1), distance);
        Real until = real(1e30F);
        for (int a = 0; a < 3; ++a) {
            const Mask ahead = hn::Gt(lanes_.inverse[a], hn::Zero(F()));
            const Real face = hn::Mul(side_, hn::Add(brick_[a], hn::IfThenElse(ahead, distance, behind)));
            until = hn::Min(until, hn::Mul(hn::Sub(face, lanes_.start[a]), lanes_.inverse[a]));
        }
        return hn::Sub(until, real(kShort));
    }

    /// Takes a sample of each lane at its next place, or passes what is empty; false when all rays have ended. Samples
    /// keep their places: those that are left out would have had opacity 0.
    HWY_INLINE bool advance() {
        Real to = hn::IfThenElse(visited_, hn::Add(hn::Floor(u_), real(1)), u_);
        const Mask empty = hn::And(active_, hn::RebindMask(F(), hn::Gt(distance_, whole(0))));
        if (!hn::AllFalse(F(), empty)) {
            const Real until = emptyUntil(), target = hn::Floor(until);
            const Mask over = hn::And(empty, hn::Ge(until, lanes_.end));
            const Mask passed = hn::Or(over, hn::And(empty, hn::Gt(target, u_)));
            to = hn::IfThenElse(passed, target, to);
            visited_ = hn::AndNot(passed, visited_);
            have_ = hn::AndNot(passed, have_);
            if (!hn::AllFalse(F(), over)) {
                u_ = hn::IfThenElse(over, lanes_.end, u_);
                takeNext(over);
                if (hn::AllFalse(F(), active_)) return false;
                to = hn::IfThenElse(over, u_, to);
            }
            if (hn::AllFalse(F(), hn::AndNot(passed, active_))) {
                u_ = to;
                findBrick(positionAt(lanes_, access_, u_));
                return true;
            }
        }
        sample(to);
        return !hn::AllFalse(F(), active_);
    }

    /// Lanes go on to where their next piece begins, or end.
    HWY_NOINLINE void takeNext(Mask which) {
        std::uint32_t ended = 0;
        forLanes(bitsOf(which), [&](std::size_t l) HWY_ATTR {
            if (!lanes_.take(l)) ended |= 1U << l;
        });
        u_ = hn::IfThenElse(which, hn::Max(u_, lanes_.begin), u_);
        active_ = hn::AndNot(maskOf(ended), active_);
    }

    /// Moves lanes on to the pieces that they reach at `to`; gives that, or where their runs end before it.
    HWY_NOINLINE Real follow(Mask which, Real to) {
        alignas(64) std::array<float, RayPacket::kMost> u;
        hn::Store(to, F(), u.data());
        std::uint32_t before = 0;
        forLanes(bitsOf(which), [&](std::size_t l) HWY_ATTR {
            if (!lanes_.follow(l, u[l])) before |= 1U << l;
        });
        return before ? hn::IfThenElse(maskOf(before), lanes_.end, to) : to;
    }

    /// Where a sample lies in the table.
    struct Sample {
        Whole bin;
        Mask defined;  // voxels that are not numbers are empty
    };
    HWY_INLINE Sample sampleOf(Real value) const {
        const Real position = hn::Sub(hn::Mul(value, scale_), offset_);
        const Real inside = hn::Min(hn::Max(position, real(0)), real(float(table_.last)));
        return {wholeOf(inside), hn::Eq(value, value)};
    }

    /// What the table tells of a stretch between two samples.
    struct Stretch {
        Mask taken;     // lanes that take it …
        Mask known;     // … and those that have a sample at its beginning
        Mask same;      // of those with a beginning, the ones whose value does not change
        Whole from;     // its bins: where it begins …
        Places other;   // … and ends; a value that does not change is taken to change by one bin
        Real depth;     // the table at its end
        Real absorbed;  // what it absorbs
        Mask visible;   // whether that is anything
    };
    HWY_INLINE Stretch stretch(Mask taken, Mask known, Whole from, Real depthThere, const Sample& end) const {
        Stretch s;
        s.taken = taken;
        s.known = known;
        s.from = from;
        s.same = hn::And(known, hn::RebindMask(F(), hn::Eq(end.bin, from)));
        s.other = placesOf(hn::IfThenElse(hn::RebindMask(I(), s.same), hn::Add(end.bin, whole(1)), end.bin));
        const Real depth = realsAt(table_.depth.data(), s.other);
        s.absorbed = hn::Sub(depth, depthThere);
        s.depth = hn::IfThenElse(s.same, depthThere, depth);
        s.visible = hn::And(hn::And(hn::And(taken, known), end.defined), hn::Ne(s.absorbed, hn::Zero(F())));
        return s;
    }

    /// Takes two samples of each lane, at `to` and, where its piece goes so far, a step on, and adds the stretches that
    /// they end. Two, since one waits longer for its voxels and for the table than it keeps the processor busy.
    HWY_INLINE void sample(Real to) {
        const Mask past = hn::And(active_, hn::Gt(to, lanes_.end));
        if (!hn::AllFalse(F(), past)) to = follow(past, to);
        const Real next = hn::Add(hn::Floor(to), real(1));
        const Mask goesOn = hn::And(active_, hn::Le(next, lanes_.end));
        const Real3 x[2] = {positionAt(lanes_, access_, to), positionAt(lanes_, access_, next)};
        const Place places[2] = {placeOf(x[0]), placeOf(x[1])};
        Real values[2];
        valuesAt<Voxels>(access_, places, values);
        packet_.samples += hn::CountTrue(F(), active_) + hn::CountTrue(F(), goesOn);

        const Sample one = sampleOf(values[0]), two = sampleOf(values[1]);
        Stretch both[2];
        both[0] = stretch(active_, have_, bin_, depth_, one);
        both[1] = stretch(goesOn, one.defined, one.bin, both[0].depth, two);
        const Real ends[3] = {u_, to, next};
        composite(both, ends);
        const Stretch &first = both[0], &second = both[1];

        const Mask visible = hn::Or(hn::And(goesOn, second.visible), hn::AndNot(goesOn, first.visible));
        // What is seen is in no empty brick.
        if (hn::AllFalse(F(), hn::AndNot(visible, active_))) {
            distance_ = whole(0);
        } else {
            const auto last = [&](Real a, Real b) HWY_ATTR { return hn::IfThenElse(goesOn, b, a); };
            findBrick({last(x[0].x, x[1].x), last(x[0].y, x[1].y), last(x[0].z, x[1].z)});
        }
        depth_ = hn::IfThenElse(goesOn, second.depth, first.depth);
        bin_ = hn::IfThenElse(hn::RebindMask(I(), goesOn), two.bin, one.bin);
        have_ = hn::Or(hn::And(goesOn, two.defined), hn::AndNot(goesOn, one.defined));
        visited_ = all();
        u_ = hn::IfThenElse(goesOn, next, to);
        const Mask done = hn::And(active_, hn::Ge(u_, lanes_.end));
        if (!hn::AllFalse(F(), done)) finish(done);
        active_ = hn::And(active_, hn::Gt(transmittance_, real(kOpaque)));
    }

    /// Lanes at the end of a piece: those whose run ends there begin the next or are done.
    HWY_NOINLINE void finish(Mask which) {
        std::uint32_t ends = 0;
        forLanes(bitsOf(which), [&](std::size_t l) {
            if (!lanes_.touchesNext(l)) ends |= 1U << l;
        });
        if (!ends) return;
        const Mask over = maskOf(ends);
        visited_ = hn::AndNot(over, visited_);
        have_ = hn::AndNot(over, have_);
        takeNext(over);
        distance_ = hn::IfThenElseZero(hn::Not(hn::RebindMask(I(), over)), distance_);
    }

    /// Adds two stretches, which follow each other between `ends`.
    HWY_INLINE void composite(Stretch (&s)[2], const Real (&ends)[3]) {
        if (hn::AllFalse(F(), hn::Or(s[0].visible, s[1].visible))) {
            // Where nothing is absorbed the table of colours does not change.
            for (const Stretch& stretch : s)
                knowsColor_ = hn::AndNot(hn::AndNot(stretch.known, stretch.taken), knowsColor_);
            return;
        }
        const float* colors = table_.color.data();
        const Mask changes[2] = {hn::AndNot(s[0].same, s[0].taken), hn::AndNot(s[1].same, s[1].taken)};
        const Mask asks = hn::AndNot(knowsColor_, hn::Or(s[0].visible, hn::AndNot(changes[0], s[1].visible)));
        if (!hn::AllFalse(F(), asks)) {
            Real before[3];
            triplesAt(colors, placesOf(s[0].from), before);
            for (int c = 0; c < 3; ++c) atBin_[c] = hn::IfThenElse(knowsColor_, atBin_[c], before[c]);
            knowsColor_ = all();
        }
        knowsColor_ = hn::Or(knowsColor_, hn::Or(changes[0], changes[1]));
        const Real zero = hn::Zero(F()), one = real(1);
        Real middle[2], through[2], mean[2][3];
        for (int n = 0; n < 2; ++n) {
            const Real change = hn::ConvertTo(F(), hn::Sub(s[n].other.index, s[n].from));
            const Real inverse = hn::Div(one, hn::IfThenElse(s[n].visible, hn::Mul(change, s[n].absorbed), one));
            const Real length = hn::Sub(ends[n + 1], ends[n]);
            // depth = absorbed / change · length; mean colour = glow / absorbed.
            Real depth = hn::Mul(hn::Mul(hn::Mul(s[n].absorbed, s[n].absorbed), inverse), length);
            middle[n] = hn::Mul(real(0.5F), hn::Add(ends[n], ends[n + 1]));
            if (HWY_UNLIKELY(volume_.steepness != nullptr))
                depth = shader_.steepened(s[n].visible, middle[n], depth, length);
            through[n] = exp2(hn::Mul(depth, real(-1.44269504F)));
            const Real perDepth = hn::Mul(change, inverse);
            Real glow[3];
            triplesAt(colors, s[n].other, glow);
            for (int c = 0; c < 3; ++c) {
                mean[n][c] = hn::Min(hn::Max(hn::Mul(hn::Sub(glow[c], atBin_[c]), perDepth), zero), one);
                atBin_[c] = hn::IfThenElse(changes[n], glow[c], atBin_[c]);
            }
        }
        for (int n = 0; n < 2; ++n) {
            // A ray ends where it is opaque, whichever samples it takes together.
            const Mask visible = hn::And(s[n].visible, hn::Gt(transmittance_, real(kOpaque)));
            const Real weight = hn::IfThenElseZero(visible, hn::Mul(transmittance_, hn::Sub(one, through[n])));
            if (volume_.light.shading) shader_.shade(visible, middle[n], weight, mean[n]);
            for (int c = 0; c < 3; ++c) color_[c] = hn::Add(color_[c], hn::Mul(weight, mean[n][c]));
            transmittance_ = hn::IfThenElse(visible, hn::Mul(transmittance_, through[n]), transmittance_);
        }
    }

    const PacketVolume& volume_;
    const VoxelAccess& access_;
    const OpticalTable& table_;
    const SkipGrid& skip_;
    RayPacket& packet_;
    Lanes lanes_;
    Real side_, perSide_;  // of bricks, voxels
    Real scale_, offset_;
    Mask active_;      // lanes whose rays go on
    Mask visited_;     // of them, those that have a sample at u
    Mask have_;        // and those whose value there is known
    Mask knowsColor_;  // and those whose entry of the colour table there is
    Real u_;
    Whole bin_;
    Real depth_, atBin_[3];  // the tables at bin_
    Real color_[3], transmittance_;
    Real brick_[3];
    Whole distance_;
    PacketShader<Voxels> shader_;
};

void castPacketHere(const PacketVolume& volume, RayPacket& packet) {
    const VoxelAccess access = voxelAccess(*volume.volume);
    switch (access.kind) {
        case VoxelKind::Bits8:
            return Caster<Voxels8>(volume, access, packet).run();
        case VoxelKind::Bits16:
            return Caster<Voxels16>(volume, access, packet).run();
        case VoxelKind::Bits32:
            return Caster<Voxels32>(volume, access, packet).run();
        case VoxelKind::Float:
            return Caster<VoxelsFloat>(volume, access, packet).run();
    }
}

std::size_t lanesHere() {
    return hn::Lanes(F());
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voledit {

HWY_EXPORT(castPacketHere);
HWY_EXPORT(lanesHere);

Index2 packetShape() {
    const std::size_t lanes = HWY_DYNAMIC_DISPATCH(lanesHere)();
    Index2 shape(1, 1);
    while (std::size_t(shape.x * shape.y) < lanes) (shape.x <= shape.y ? shape.x : shape.y) *= 2;
    return shape;
}

void castPacket(const PacketVolume& volume, RayPacket& packet) {
    HWY_DYNAMIC_DISPATCH(castPacketHere)(volume, packet);
}

}  // namespace voledit
#endif
