#pragma once
// Rays through one linear volume, cast in packets of as many rays as the processor's vectors have lanes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/fields/volume.h"
#include "core/rays/optical_table.h"
#include "core/rays/skip_grid.h"

namespace voledit {

/// A piece of a ray on which the map to the volume's index space is affine: x(u) = start + u · step, u counted in steps
/// along the whole ray. Samples lie at whole u, and where a run of pieces that touch begins and ends.
struct RayPiece {
    float begin, end;            // u
    std::array<float, 3> start;  // x at u = 0
    std::array<float, 3> step;
    std::uint32_t cell;  // whose Jacobians turn gradients; unused where one matrix does
};

/// How samples are lit; as RenderSettings, and world directions.
struct PacketLight {
    bool shading = false;
    float ambient = 0, diffuse = 0, specular = 0, shininess = 1;
    bool head = true;                // the light stands at the eye
    std::array<float, 3> toLight{};  // unit; of another light
};

/// What rays meet. Refers to what must outlive it.
struct PacketVolume {
    const Volume* volume = nullptr;
    const OpticalTable* table = nullptr;
    const SkipGrid* skip = nullptr;
    std::array<float, 9> worldFromGradient{};  // row by row: differences of one voxel to world space
    PacketLight light;
};

/// Whether rays through `volume` can be cast in packets: channel 0 of one, at least two samples an axis, within what
/// 32-bit offsets reach, in a type that single precision holds well.
bool packable(const Volume& volume);

/// Rays that go on together: `count` lanes at most packetShape()'s x · y.
struct RayPacket {
    static constexpr std::size_t kMost = 16;
    std::array<std::span<const RayPiece>, kMost> pieces;          // of each lane, front to back; empty: nothing is met
    alignas(64) std::array<std::array<float, kMost>, 3> toEye{};  // unit, world space
    alignas(64) std::array<std::array<float, kMost>, 3> color{};  // result: composited, without background
    alignas(64) std::array<float, kMost> transmittance{};         // result
    std::uint64_t samples = 0;                                    // grows by those taken
};

/// Pixels across and down that one packet covers on this machine; their product is at most RayPacket::kMost. The
/// picture does not depend on it.
Index2 packetShape();

/// Integrates the rays of `packet`.
void castPacket(const PacketVolume& volume, RayPacket& packet);

}  // namespace voledit
