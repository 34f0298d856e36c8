#pragma once
// Limbs and their regions: boxes about bones at rest, mapped hexahedra when posed (definitions.md §6.3).

#include <cstdint>
#include <string>
#include <vector>

#include "core/skeleton/skeleton.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

/// A bone from joint to joint with a box region about it, in the space of the object (after the skeleton's fit).
struct Limb {
    std::string name;
    int from = 0, to = 0;  // joints of the skeleton; `to` below `from`. The limb turns with `from`.
    Vec2 size{1};          // of the cross-section along the bone frame's x and y, world units, > 0
    Vec2 offset{0};        // of the section's middle from the bone, along the same
    double roll = 0;       // radians, turns the bone frame about the bone, from x towards y
    Vec2 pad{0};           // how far the box reaches beyond the joints at start and end, where it is not connected
    bool operator==(const Limb&) const = default;
};

/// The bone frame for direction d (unit): columns x, y, d; x is the projection of world x (of y where the bone is
/// parallel to x), turned by `roll` about d; y = d × x.
Mat3 boneFrame(const Vec3& direction, double roll);

struct RegionOptions {
    Index3 cells{6, 6, 8};        // subdivision of each limb: across x, across y, along the bone; ≥ 1 each
    double miterLimit = 2;        // ≥ 1: mitred corners reach at most so many times as far as straight ones
    bool smooth = true;           // bends are C¹ across joints, hubs blend; else each region is the bare hexahedron
    bool preserveVolume = false;  // sections are scaled so that they keep their volume where limbs twist or stretch
    std::vector<bool> disjoint;   // of each joint; empty: all connected
};

/// All regions of a skeleton, as mapped cells: deformed p of the pose, source q at rest.
struct LimbRegions {
    MappedCells::Data cells;
    /// Hexahedra firstCell[l] … firstCell[l+1]−1 are of limb l (with the bevel at its end); limbs + 1 entries.
    std::vector<std::size_t> firstCell;
    /// One for each hexahedron: 1 where another limb's region holds all of it at rest and moves as one with it.
    std::vector<char> repeated;
};

/// Regions of `limbs` between rest joints `rest` and posed joints `posed` (as many; in the space of the object).
///
/// *Connected* (mid-plane geometry): where a limb ends at the joint where another begins — among several, the one that
/// continues it most straightly at rest — both boxes end in one shared quadrilateral in the plane through the joint
/// with normal d₁ + d₂ (unit, parent to child), whose corners are the means of the points in which the boxes' edge
/// lines meet the plane, in the rest pose as in any other. Past the miter limit, and for d₁ = −d₂, each box ends in a
/// plane of its own, turned no further than the limit allows, and extra cells (the bevel) fill the wedge between. The
/// other limbs that begin there begin in a plane across their bone, `pad` before the joint: boxes overlap about the
/// hub, and union joins them; with `smooth` they move as one where they overlap at rest (limb_hubs.h). *Disjoint*
/// joints leave each limb its box: rigid, with its pads.
///
/// Inside, a region is the trilinear map between its corners, in `cells` parts; with `smooth` a term is added near
/// connected joints that vanishes on all shared faces and makes the derivative across them continuous (zero where rest
/// and pose agree: the rest pose is the identity to the bit). Shared faces share their vertices. Jacobians at vertices
/// are given, one for both sides of a shared face.
///
/// Throws Error, naming the limb, for limbs of no length at rest or posed, joints out of range, sizes not positive or
/// not finite, and more cells than a scene may have (limit in the error).
LimbRegions limbRegions(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                        const std::vector<PosedJoint>& posed, const RegionOptions& options);

/// The regions of some limbs alone (indices ascending): cells of their own, with the same vertices and Jacobians.
MappedCells::Data cellsOf(const LimbRegions& regions, const std::vector<int>& limbs);

/// The regions of all limbs together, without the cells that are repeated: fewer lie over each other.
MappedCells::Data joinedCells(const LimbRegions& regions);

/// Which limb continues `limb` at its end (the connection described above); -1 where none does.
int continuationOf(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, int limb,
                   const std::vector<bool>& disjoint);

/// A limb's part in a hub, where limbs branch and overlap.
enum class HubRole : std::uint8_t {
    None,
    Next,    // continues one that is rooted
    Beside,  // stands before or behind one that holds another, in its chain
    Holds,   // another limb is rooted in it
    Rooted   // continues none, and begins in the midst of others
};
/// Of each limb. `disjoint` as in RegionOptions.
std::vector<HubRole> hubRoles(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                              const std::vector<bool>& disjoint);

/// The twelve edges of each limb's posed box as polylines along the subdivided cells, for showing it.
std::vector<std::vector<Vec3>> outlineOf(const LimbRegions& regions, int limb, const RegionOptions& options);

}  // namespace voledit
