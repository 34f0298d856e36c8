#pragma once
// Rays through one linear volume, cast in packets of as many rays as the processor's vectors have lanes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/eval/cut_faces.h"
#include "core/fields/volume.h"
#include "core/rays/optical_table.h"
#include "core/rays/packet_cells.h"
#include "core/rays/skip_grid.h"
#include "core/scene/lighting.h"

namespace voledit {

class Surroundings;

/// How samples are lit (core/scene/lighting.h), in world space.
struct PacketLight {
    struct Far {
        std::array<float, 3> toward{};  // unit
        float intensity = 1;
    };
    bool shading = false;
    float ambient = 0, diffuse = 0, specular = 0, shininess = 1;
    Lights::Kind kind = Lights::Kind::Head;
    std::size_t count = 1;
    std::array<Far, Lights::kMost> lights{};
    /// Where set, what stands around a point takes of its light; for that, eye and step tell where samples lie.
    const Surroundings* surroundings = nullptr;
    Vec3 eye{0};
    double step = 1;
};

/// Voxels from a volume's faces beyond which no cut by them is looked for: twice what bent maps make of its thickness.
constexpr double kCutReach = 8;

/// How cut faces are found (core/eval/cut_faces). Refers to what must outlive it.
struct PacketCuts {
    const CutFinder* finder = nullptr;  // null: none are looked for
    Vec3 eye{0};
    double step = 1;    // world length of a step
    double ahead = 0;   // how much deeper than where it shows the beginning of a run may lie, world units
    bool gaps = false;  // maps may be undefined anywhere; else only the ends of cells and the volume's faces are cuts
};

/// What rays meet. Refers to what must outlive it.
struct PacketVolume {
    const Volume* volume = nullptr;
    const OpticalTable* table = nullptr;
    const SkipGrid* skip = nullptr;
    /// Where set, rays are straight in cell space, and the cells lead to the volume's index space and turn gradients;
    /// else they are straight in index space, and `turn` does.
    const PacketCells* cells = nullptr;
    GradientTurn turn{};
    /// Where set, opacity also depends on the gradient in the volume's own space, which `ownTurn` leads to; `unit` is
    /// the step in opacity distances.
    const SteepnessTable* steepness = nullptr;
    GradientTurn ownTurn{};
    float unit = 1;
    PacketLight light;
    PacketCuts cuts;
};

struct VolumeLook;
/// The volume of `look`, but for cells, turn and light.
PacketVolume packetVolume(const VolumeLook& look);

/// Whether rays through `volume` can be cast in packets: channel 0 of one, at least two samples an axis, within what
/// 32-bit offsets reach, in a type that single precision holds well.
bool packable(const Volume& volume);

/// Rays that go on together: `count` lanes at most packetShape()'s x · y. The lane's place after u steps is
/// base + u · along; samples lie at whole u, and where a run of hits that touch begins and ends.
struct RayPacket {
    static constexpr std::size_t kMost = 16;
    using Lanes = std::array<float, kMost>;
    std::array<std::span<const CellHit>, kMost> hits;  // of each lane, front to back, apart; empty: nothing is met
    std::span<const OwnPiece> own;                     // what hits that are no cells' refer to
    alignas(64) std::array<Lanes, 3> base{}, along{};
    alignas(64) std::array<Lanes, 3> toEye{};  // unit, world space
    alignas(64) Lanes distance{};              // from the eye at u = 0, world units
    alignas(64) std::array<Lanes, 3> color{};  // result: composited, without background
    alignas(64) Lanes transmittance{};         // result
    std::uint64_t samples = 0;                 // grows by those taken
};

/// Pixels across and down that one packet covers on this machine; their product is at most RayPacket::kMost. The
/// picture does not depend on it.
Index2 packetShape();

/// Integrates the rays of `packet`.
void castPacket(const PacketVolume& volume, RayPacket& packet);

}  // namespace voledit
