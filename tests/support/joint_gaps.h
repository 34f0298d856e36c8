#pragma once
// Rays across the faces where limbs meet: what they meet that no region covers.

#include <glm/geometric.hpp>
#include <vector>

#include "core/skeleton/limb_regions.h"

namespace voledit {

/// How many joints were looked at, how many points of rays, and those that nothing covered.
struct JointGaps {
    std::size_t joints = 0, points = 0;
    std::vector<Vec3> uncovered;
};

/// Sends rays from the cells on each side of a face where limbs meet into what lies beyond, through points all over it:
/// out of a limb's end into the next limb (or the bevel), out of the next limb's start back, and through both faces of
/// the bevel's cells. What a cell's own face hides from it must be covered by others, without a gap.
class JointRays {
public:
    JointRays(const LimbRegions& regions, const RegionOptions& options)
        : regions_(regions),
          cells_(regions.cells),
          layer_(std::size_t(options.cells.x) * std::size_t(options.cells.y)),
          below_(layer_ * std::size_t(options.cells.z - 1)) {}

    JointGaps across(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                     const std::vector<bool>& disjoint) {
        for (std::size_t l = 0; l < limbs.size(); ++l) {
            const int next = continuationOf(limbs, rest, int(l), disjoint);
            if (next < 0) continue;
            ++gaps_.joints;
            const std::size_t last = regions_.firstCell[l] + below_, first = regions_.firstCell[std::size_t(next)];
            for (std::size_t c = 0; c < layer_; ++c) {
                const auto from = facePoints(last + c, 4), to = facePoints(first + c, 0);
                for (std::size_t n = 0; n < from.size(); ++n) {
                    const Vec3 behind = centreOf(last + c);
                    // Past the miter limit the limbs overlap on the inside of the bend, each with sides of its own.
                    if (from[n] != to[n] && !(glm::dot(to[n] - from[n], alongOf(last + c)) > 0)) continue;
                    follow(behind, from[n]);
                    follow(centreOf(first + c), to[n]);
                }
            }
            for (std::size_t c = last + layer_; c < regions_.firstCell[l + 1]; ++c)
                if (opensEverywhere(c))
                    for (const std::size_t face : {std::size_t(0), std::size_t(4)})
                        for (const Vec3& point : facePoints(c, face)) follow(centreOf(c), point);
        }
        return gaps_;
    }

private:
    Vec3 centreOf(std::size_t cell) const {
        Vec3 sum(0);
        for (const std::uint32_t v : regions_.cells.hexahedra[cell]) sum += regions_.cells.deformed[v];
        return sum / 8.0;
    }

    Vec3 vertex(std::size_t cell, std::size_t corner) const {
        return regions_.cells.deformed[regions_.cells.hexahedra[cell][corner]];
    }

    /// Points of a cell's face (0: where the bone begins, 4: where it ends), on its two triangles, off the edges.
    std::vector<Vec3> facePoints(std::size_t cell, std::size_t face) const {
        std::vector<Vec3> points;
        for (const std::size_t third : {std::size_t(1), std::size_t(2)})
            for (const Vec3& w : {Vec3(0.34, 0.33, 0.33), Vec3(0.98, 0.01, 0.01), Vec3(0.01, 0.98, 0.01),
                                  Vec3(0.01, 0.01, 0.98), Vec3(0.495, 0.495, 0.01)})
                points.push_back(w.x * vertex(cell, face) + w.y * vertex(cell, face + 3) +
                                 w.z * vertex(cell, face + third));
        return points;
    }

    /// Along the bone in a cell.
    Vec3 alongOf(std::size_t cell) const {
        Vec3 sum(0);
        for (std::size_t corner = 0; corner < 4; ++corner) sum += vertex(cell, corner + 4) - vertex(cell, corner);
        return sum;
    }

    /// Whether a bevel's cell lies all on the outside of the bend; one across the axis is a bow tie about it.
    bool opensEverywhere(std::size_t cell) const {
        const auto& h = regions_.cells.hexahedra[cell];
        const auto at = [&](int corner) { return regions_.cells.deformed[h[std::size_t(corner)]]; };
        for (const auto& t : kHexahedronTetrahedra) {
            const Vec3 a = at(t[1]) - at(t[0]), b = at(t[2]) - at(t[0]), c = at(t[3]) - at(t[0]);
            if (glm::dot(a, glm::cross(b, c)) < 0) return false;
        }
        return true;
    }

    void follow(const Vec3& from, const Vec3& through) {
        CellLocation at{};
        for (const double beyond : {-0.5, -1e-9, 0.0, 1e-9, 1e-6, 1e-4, 1e-3}) {
            const Vec3 p = through + beyond * (through - from);
            ++gaps_.points;
            if (!cells_.locate(p, at)) gaps_.uncovered.push_back(p);
        }
    }

    const LimbRegions& regions_;
    const MappedCells cells_;
    const std::size_t layer_, below_;
    JointGaps gaps_;
};

inline JointGaps gapsAtJoints(const LimbRegions& regions, const std::vector<Limb>& limbs,
                              const std::vector<PosedJoint>& rest, const RegionOptions& options) {
    return JointRays(regions, options).across(limbs, rest, options.disjoint);
}

}  // namespace voledit
