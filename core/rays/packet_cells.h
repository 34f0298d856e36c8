#pragma once
// Deformed tetrahedra as packets of rays take them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box3.h"
#include "core/base/types.h"

namespace voledit {

/// A tetrahedron in cell space: where the cells are deformed, counted from PacketCells::origin. Padded for vectors.
struct alignas(64) PacketCell {
    /// Of the face opposite each vertex v: plane[0…2][v] · p + plane[3][v], positive within; all four scaled alike, so
    /// that the values at a point within are its barycentric weights times their sum. Of a face between two cells the
    /// one's are the other's, negated to the bit.
    std::array<std::array<float, 4>, 4> plane;
    /// The affine map to the volume's index space: index[0…2][a] · p + index[3][a].
    std::array<std::array<float, 4>, 4> index;
};

/// Numbers of pieces from here on are not of cells (OwnPiece).
constexpr std::uint32_t kOwnPiece = 1U << 31;

/// Turns differences of one voxel into a gradient in world space, but for its length: columns, padded.
using GradientTurn = std::array<std::array<float, 4>, 3>;

/// The cells of a deformed volume that can be seen.
struct PacketCells {
    Vec3 origin{0};
    std::vector<PacketCell> cells;
    std::vector<std::array<std::uint32_t, 4>> corners;  // of each cell, into …
    std::vector<Vec3> position;                         // … the vertices' places, in the space of the deformed cells
    std::vector<GradientTurn> turn;                     // … and what turns gradients there
    /// Sides of the volume's domain that a cell reaches beyond: bit 2a the low one of axis a, bit 2a + 1 the high one.
    std::vector<std::uint8_t> beyond;
    /// 1 where a ray may come into a cell from where a map's cells end; empty where it may nowhere.
    std::vector<std::uint8_t> atEnd;
    std::array<float, 3> last{};  // the index of the domain's high sides
    Box3 bounds;                  // of the cells, in their space
    /// From this one on, cells are ragged: there is no affine map through them to index space, and the pieces of rays
    /// must be found one by one. `index` leads to where CellWay's inner maps go on.
    std::uint32_t firstRagged = ~0U;
    std::vector<std::uint32_t> raggedGroup;  // of each of these: `index` of all in a group is the same map
    /// The Jacobian of that way at each vertex; empty where it is the identity.
    std::vector<Mat3> outer;

    /// `bounds`, when all cells are there.
    void findBounds();
    /// Whether a run of pieces that begins in `cell` may begin where a map's cells end; false for pieces of their own.
    bool mayBeginAtEnd(std::uint32_t cell) const { return cell < atEnd.size() && atEnd[cell]; }
    /// False only if none does.
    bool hasEnds() const;
};

/// A piece of a ray within a cell; in steps along the ray.
struct CellHit {
    float begin, end;
    std::uint32_t cell;  // or kOwnPiece + the number of an OwnPiece
};

/// A piece with a map of its own: index space is start + u · step.
struct OwnPiece {
    alignas(16) std::array<float, 4> start, step;
    GradientTurn turn;
};

/// The cell between vertices at `p`, counted from the origin, that lie at `x` in index space.
PacketCell packetCell(const std::array<Vec3, 4>& p, const std::array<Vec3, 4>& x);
/// `turn`, padded and in single precision.
GradientTurn gradientTurn(const Mat3& turn);
/// Whether one of `places` lies on one of `faces` (planes with unit normals) but for `slack`.
bool touchesAny(std::span<const Vec4> faces, const std::array<Vec3, 4>& places, double slack);
/// The bits of PacketCells::beyond for a cell whose source fills `box`, of a volume whose domain is `domain`.
std::uint8_t sidesBeyond(const Box3& box, const Box3& domain);

}  // namespace voledit
