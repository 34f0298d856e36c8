#pragma once
// A backward map tabulated at the nodes of a regular grid over deformed space, for renderers that look it up by linear
// interpolation.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/box3.h"

namespace voledit {

/// A grid of nodes in the world, cubic cells between them.
struct BakeGrid {
    Index3 nodes{2};
    Vec3 origin{0};   // world position of node (0, 0, 0)
    double cell = 1;  // world units between nodes

    std::size_t indexOf(Index3 n) const {
        return std::size_t(n.x) + std::size_t(nodes.x) * (std::size_t(n.y) + std::size_t(nodes.y) * std::size_t(n.z));
    }
    std::size_t nodeCount() const { return indexOf({0, 0, nodes.z}); }
    Mat4 gridFromWorld() const;
};

/// Nodes over `bounds` and kBakeBorder cells around it, `most` along the longest axis.
constexpr int kBakeBorder = 2;
BakeGrid bakeGrid(const Box3& bounds, int most);

/// At each node the place in the map's result (index coordinates of a volume, say), and 1 where it is known, else 0.
/// Nodes up to kBakeBorder cells beyond where the map is defined hold its linear continuation, so that cells at its
/// faces can be interpolated. Of cells that counts as known, and what lies beyond is for the user to cut off; of other
/// maps it has kContinued: half-way between that and 1 lies about the face.
struct BakedMap {
    static constexpr float kContinued = 0.25F;
    BakeGrid grid;
    std::vector<Vec4f> node;  // i fastest

    /// d place / d world about a node, by differences to its neighbours that are known; 0 along axes without any.
    Mat3 jacobianAt(Index3 n) const;
    /// Linear between the nodes, at world point p; false where one of the eight is not known.
    bool at(const Vec3& p, Vec3& place) const { return atGrid((p - grid.origin) / grid.cell, place); }
    /// Whether all eight nodes about p are known, not continued.
    bool surelyKnownAt(const Vec3& p) const;

    /// What a map is known to give: the place at grid coordinates `at`, kUndefined where it is known not to do.
    struct Known {
        Vec3 at, place;
    };
    /// The largest distance, in places, of what linear interpolation between the nodes gives from what is known;
    /// infinite where there is no place. In parallel.
    /// @param straight  cells: the map is interpolated between places so far apart, half of it to either side, along
    /// each axis; 0: at the point itself
    double error(std::span<const Known> known, double straight = 0) const;

    /// Continues known nodes linearly by kBakeBorder cells along each axis, which get `mark`. In parallel.
    void continueOutwards(float mark);

private:
    bool atGrid(const Vec3& x, Vec3& place) const;
    double errorAt(const Known& known, double straight) const;
};

/// Any map: place[n] of world point p[n], kUndefined where there is none. Called from many threads.
using PlaceMap = std::function<void(std::span<const Vec3> p, std::span<Vec3> place)>;
BakedMap bake(const PlaceMap& exact, const BakeGrid& grid);
/// Centres of the map's cells for which `seen` says 1: one flag for each cell of the grid, i fastest. Undefined, too,
/// where a corner of the cell is not surely known.
std::vector<BakedMap::Known> bakedCentres(const BakedMap& map, const PlaceMap& exact,
                                          const std::vector<std::uint8_t>& seen);

}  // namespace voledit
