#pragma once
// Rays across the faces where limbs meet: what they meet that no region covers.

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/skeleton/limb_regions.h"

namespace voledit {

/// How many joints were looked at, how many points of rays, those that nothing covered, and how many cells at joints
/// are folded: those have no other side to look into, and none is looked out of.
struct JointGaps {
    std::size_t joints = 0, points = 0, folded = 0;
    std::vector<Vec3> uncovered;
};

/// Sends rays from the cells on each side of a face where limbs meet into what lies beyond, through points all over it:
/// out of a limb's end into the next limb (or the bevel), out of the next limb's start back, and through both faces of
/// the bevel's cells. What a cell's own face hides from it must be covered by others, without a gap.
class JointRays {
public:
    /// @param cells  what covers: the regions' own cells, or what is drawn of them
    JointRays(const LimbRegions& regions, const RegionOptions& options, MappedCells::Data cells)
        : regions_(regions),
          cells_(std::move(cells)),
          layer_(std::size_t(options.cells.x) * std::size_t(options.cells.y)),
          below_(layer_ * std::size_t(options.cells.z - 1)) {}

    JointGaps across(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                     const std::vector<bool>& disjoint) {
        for (std::size_t l = 0; l < limbs.size(); ++l) {
            const int next = continuationOf(limbs, rest, int(l), disjoint);
            if (next < 0) continue;
            ++gaps_.joints;
            const std::size_t last = regions_.firstCell[l] + below_, first = regions_.firstCell[std::size_t(next)];
            const std::size_t foldedBefore = gaps_.folded;
            for (std::size_t c = 0; c < layer_; ++c) {
                if (folded(last + c) || folded(first + c)) {
                    ++gaps_.folded;
                    continue;
                }
                const auto from = facePoints(last + c, 4), to = facePoints(first + c, 0);
                for (std::size_t n = 0; n < from.size(); ++n) {
                    // Past the miter limit the limbs overlap on the inside of the bend, each with sides of its own.
                    if (from[n] != to[n] && !(glm::dot(to[n] - from[n], alongOf(last + c)) > 0)) continue;
                    follow(last + c, from[n], 4);
                    follow(first + c, to[n], 0);
                }
            }
            // One of the bevel's cells across the axis is a bow tie about it.
            if (gaps_.folded > foldedBefore) continue;
            for (std::size_t c = last + layer_; c < regions_.firstCell[l + 1]; ++c)
                if (!folded(c))
                    for (const std::size_t face : {std::size_t(0), std::size_t(4)})
                        for (const Vec3& point : facePoints(c, face)) follow(c, point, face);
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

    bool folded(std::size_t cell) const {
        for (const auto& t : kHexahedronTetrahedra) {
            const Vec3 origin = vertex(cell, std::size_t(t[0]));
            const auto edge = [&](std::size_t n) { return vertex(cell, std::size_t(t[n])) - origin; };
            if (glm::dot(edge(1), glm::cross(edge(2), edge(3))) < 0) return true;
        }
        return false;
    }

    /// Looks through a point of a face of the cell, from its middle, as near as the face is wide.
    void follow(std::size_t cell, const Vec3& through, std::size_t face) {
        const Vec3 ray = through - centreOf(cell);
        double width = glm::length(ray);
        for (const auto& [a, b] : {std::pair(0, 1), {0, 2}, {1, 3}, {2, 3}, {0, 3}, {1, 2}})
            width =
                std::min(width, glm::length(vertex(cell, face + std::size_t(a)) - vertex(cell, face + std::size_t(b))));
        CellLocation at{};
        for (const double beyond : {-1e-3, -1e-9, 0.0, 1e-9, 1e-6, 1e-4, 1e-3}) {
            const Vec3 p = through + beyond * width * glm::normalize(ray);
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
    return JointRays(regions, options, regions.cells).across(limbs, rest, options.disjoint);
}

}  // namespace voledit
