#pragma once
// The inside of a limb's region: where its vertices lie between its two faces. Of use to limb_regions.cpp only.

#include <span>
#include <vector>

#include "core/skeleton/limb_joints.h"

namespace voledit {

/// A region by its faces, at rest or posed.
struct LimbShape {
    Quad start{}, end{};
    Vec3 boneStart{0}, boneEnd{0};  // where the bone meets them
    Vec3 bone(double w) const { return (1 - w) * boneStart + w * boneEnd; }
};

/// The same at rest and posed.
struct LimbMotion {
    LimbShape rest, posed;
    double bone[2] = {0, 0};  // (u, v) of the bone in the faces
};

/// What smoothing adds near one end: `at[i + (nx + 1) j]`·h(x), with x the distance from the end as a part of the limb
/// and h(x) = x (1 − x/zone)² up to the zone's end (h(0) = 0, h'(0) = 1; 0 with its derivative at the zone's end).
struct EndCorrection {
    std::vector<Vec3> at;  // empty: nothing
    Vec3 atBone{0};        // the same at the bone
    double zone = 0.5;     // part of the limb, at most half

    double weight(double x) const;
    double slope(double x) const;
};

/// Vertices of a region's layers across the bone.
struct LimbGrid {
    Index3 cells{1};
    std::size_t layerSize() const { return std::size_t(cells.x + 1) * std::size_t(cells.y + 1); }
    std::size_t size() const { return layerSize() * std::size_t(cells.z + 1); }
};

/// What must be added to the first limb's end and the second's start so that the map's derivative across their face is
/// the mean of both. With a the part of the rest limb's derivative along the face's normal n and D the image of n under
/// each limb's own map (D = (g − F t)/a, of the posed derivative g, of which F t is what runs along the face), that is
/// a·(mean − D). Computed from displacements: 0 to the bit where rest and pose are equal. Past the miter limit the
/// second limb is turned back by the wedge to be compared.
struct JointCorrections {
    EndCorrection end, start;
};
JointCorrections jointCorrections(const LimbMotion& first, const LimbMotion& second, const JointFaces& rest,
                                  const JointFaces& posed, const LimbGrid& grid);

/// Trilinear positions between the faces, x fastest.
void fillTrilinear(const LimbShape& shape, const LimbGrid& grid, std::span<Vec3> positions);

/// Adds a correction near the start (or the end) of a limb, damped as far as it takes for no cell to lose more than
/// nine tenths of its volume by it.
void addCorrection(const LimbGrid& grid, EndCorrection& correction, bool atEnd, std::span<Vec3> positions);

/// By which each layer must be scaled about the bone so that it keeps its volume: its area times the bone's derivative
/// across it is as at rest; between 1/4 and 4. `start`, `end`: the corrections added.
std::vector<double> layerScales(const LimbMotion& limb, const LimbGrid& grid, const EndCorrection& start,
                                const EndCorrection& end, std::span<const Vec3> rest, std::span<const Vec3> posed);

/// Scales each layer about the bone; unchanged to the bit where the scale is 1.
void scaleLayers(const LimbMotion& limb, const LimbGrid& grid, const EndCorrection& start, const EndCorrection& end,
                 std::span<const double> scales, std::span<Vec3> posed);

}  // namespace voledit
