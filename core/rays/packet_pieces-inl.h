// The pieces of a packet's rays, one after the other. Included once for each target, hence no plain include guard.

#if defined(VOLEDIT_RAYS_PACKET_PIECES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef VOLEDIT_RAYS_PACKET_PIECES_INL
#undef VOLEDIT_RAYS_PACKET_PIECES_INL
#else
#define VOLEDIT_RAYS_PACKET_PIECES_INL
#endif

#include <hwy/highway.h>

#include "core/rays/packet_caster.h"
#include "core/rays/packet_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

// Pieces that lie no further apart, in steps, touch.
constexpr float kTouching = 1e-2F;

/// The pieces that the lanes are on: there the place in index space is start + u · step.
class Lanes {
public:
    Lanes(const PacketVolume& volume, const RayPacket& packet) : cells_(volume.cells), packet_(packet) {
        begin = end = run = hn::Zero(F());
        for (std::size_t a = 0; a < 3; ++a) {
            start[a] = load(packet.base[a].data());
            step[a] = load(packet.along[a].data());
            const Mask moves = hn::Ne(step[a], hn::Zero(F()));
            inverse[a] = hn::IfThenElse(moves, hn::Div(real(1), hn::IfThenElse(moves, step[a], real(1))), real(1e30F));
        }
        for (std::size_t l = 0; l < hn::Lanes(F()); ++l)
            if (take(l)) alive_ |= 1U << l;
    }

    Real start[3], step[3], begin, end, run;  // `run` is where the pieces that touch began
    Real inverse[3];                          // of step

    std::uint32_t alive() const { return alive_; }
    /// True where lane l has begun another run since it was asked last.
    bool newRun(std::size_t l) {
        const bool is = runs_ >> l & 1;
        runs_ &= ~(1U << l);
        return is;
    }
    /// Lanes whose runs may begin where a map's cells end.
    std::uint32_t atEnd() const { return atEnd_; }
    /// The piece's own map and turn; null where its cell has them.
    const OwnPiece* own(std::size_t l) const {
        return cell_[l] & kOwnPiece ? &packet_.own[cell_[l] - kOwnPiece] : nullptr;
    }
    const PacketCell& cell(std::size_t l) const { return cells_->cells[cell_[l]]; }
    const std::array<std::uint32_t, 4>& corners(std::size_t l) const { return cells_->corners[cell_[l]]; }

    /// Moves lane l on to its next piece; false where there is none.
    bool take(std::size_t l) {
        if (next_[l] == packet_.hits[l].size()) return false;
        const CellHit& hit = packet_.hits[l][next_[l]++];
        const Mask lane = hn::RebindMask(F(), hn::Eq(hn::Iota(I(), 0), whole(std::int32_t(l))));
        if (next_[l] == 1 || hit.begin > end_[l] + kTouching) {
            set(run, lane, hit.begin);
            runs_ |= 1U << l;
            const bool atEnd = cells_ && cells_->mayBeginAtEnd(hit.cell);
            atEnd_ = atEnd ? atEnd_ | 1U << l : atEnd_ & ~(1U << l);
        }
        end_[l] = hit.end;
        cell_[l] = hit.cell;
        set(begin, lane, hit.begin);
        set(end, lane, hit.end);
        if (cells_) enter(l, lane);
        return true;
    }
    /// Moves lane l on to the piece that u lies on, as far as pieces touch; false where the run ends before it.
    bool follow(std::size_t l, float u) {
        while (u > end_[l]) {
            if (!touchesNext(l)) return false;
            take(l);
        }
        return true;
    }
    bool touchesNext(std::size_t l) const {
        const auto& hits = packet_.hits[l];
        return next_[l] < hits.size() && hits[next_[l]].begin <= end_[l] + kTouching;
    }

private:
    /// Takes lane l's ray through the map of its cell.
    HWY_INLINE void enter(std::size_t l, Mask lane) {
        Quad from, along;
        if (const OwnPiece* piece = own(l); HWY_UNLIKELY(piece != nullptr)) {
            from = quad(piece->start);
            along = quad(piece->step);
        } else {
            const auto& map = cell(l).index;
            const auto& b = packet_.base;
            const auto& a = packet_.along;
            const Quad x = quad(map[0]), y = quad(map[1]), z = quad(map[2]);
            from = x * b[0][l] + y * b[1][l] + z * b[2][l] + quad(map[3]);
            along = x * a[0][l] + y * a[1][l] + z * a[2][l];
        }
        const Quad perStep = along != 0 ? 1 / along : Quad{1e30F, 1e30F, 1e30F, 1e30F};
        for (std::size_t a = 0; a < 3; ++a) {
            set(start[a], lane, from[a]);
            set(step[a], lane, along[a]);
            set(inverse[a], lane, perStep[a]);
        }
    }
    /// By blending: a vector that is stored number by number cannot be loaded at once.
    static HWY_INLINE void set(Real& vector, Mask lane, float value) {
        vector = hn::IfThenElse(lane, real(value), vector);
    }

    const PacketCells* cells_;
    const RayPacket& packet_;
    std::array<std::size_t, RayPacket::kMost> next_{};
    std::array<std::uint32_t, RayPacket::kMost> cell_{};
    std::array<float, RayPacket::kMost> end_{};
    std::uint32_t alive_ = 0, runs_ = 0, atEnd_ = 0;
};

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
