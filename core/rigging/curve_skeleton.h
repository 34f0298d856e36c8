#pragma once
// The volume's own curve skeleton by distance-field thinning [Gagvani, Silver 1999: Parameter-controlled volume
// thinning], and the tree of its branches.

#include <vector>

#include "core/rigging/opaque_voxels.h"

namespace voledit {

/// Distance of each opaque cell's centre to the nearest cell that is not opaque (outside the grid counts), world units,
/// exact Euclidean [Felzenszwalb, Huttenlocher 2012]; 0 elsewhere. size.x·y·z values.
std::vector<float> distanceField(const OpaqueVoxels& voxels);

/// Cells that survive thinning: opaque ones whose distance exceeds the mean of their 26 neighbours' by more than
/// `thinness` (in cells; larger keeps fewer).
std::vector<Index3> thinned(const OpaqueVoxels& voxels, const std::vector<float>& distance, double thinness);

/// A connected tree of points through the object's middle: the thinned cells joined by a minimum spanning tree that
/// prefers large distances, its short side branches cut.
struct CurveSkeleton {
    struct Node {
        Vec3 at{0};
        double radius = 0;  // distance to the surface, world units
        std::vector<int> neighbours;
    };
    std::vector<Node> nodes;
};
CurveSkeleton curveSkeleton(const OpaqueVoxels& voxels, const std::vector<float>& distance, double thinness);

/// The point of the medial axis (local maximum of the distance field, by steepest ascent of at most `reach` world
/// units) near p; p itself where it is not inside.
Vec3 snappedToMedialAxis(const OpaqueVoxels& voxels, const std::vector<float>& distance, const Vec3& p, double reach);

}  // namespace voledit
