#pragma once
// Forward maps below the one whose cells are cut: what a fragment needs to find its points in them.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/stf/mapped_cells.h"
#include "render/slice_plan.h"
#include "render/visibility.h"

namespace voledit {

/// All located maps of a plan as arrays in single precision, laid out as shaders/common/located.glsl reads them. Each
/// map has a uniform grid over its deformed positions, and points come in units of its cells ("grid coordinates"); what
/// it gives are the next map's grid coordinates, or the volume's indices after the last.
struct LocatedMaps {
    struct Map {
        Mat4f nextFromThis{1};                // what `outside: keep` does
        std::array<std::int32_t, 4> grid{};   // cells along each axis; where its starts begin in `cells`
        std::array<std::int32_t, 4> keeps{};  // [0] is 1 for `outside: keep`
    };
    /// Vertex 0, and rows that take p − vertex 0 to the weights of vertices 1, 2, 3. The fourth numbers are how far
    /// below 0 the weights of vertices 0, 1, 2, 3 may lie.
    struct Tetrahedron {
        Vec4f origin{0};
        std::array<Vec4f, 3> weight{};
    };
    struct Vertex {
        Vec3f next{0};
        Mat3f jacobian{1};  // d next / d grid coordinates
    };

    std::vector<Map> maps;
    /// Starts of each grid cell's list, one more at the map's end; the lists: tetrahedra that may meet it, ascending.
    std::vector<std::uint32_t> cells;
    std::vector<Tetrahedron> tetrahedra;
    std::vector<std::array<std::uint32_t, 4>> corners;  // vertices of each
    std::vector<Vertex> vertices;
    /// From the source space of the forward map above all of them to the first one's grid coordinates.
    Mat4 entryFromSource{1};
};

/// Needs at least one located map. Throws Error where the cells are too many for 32 bits.
LocatedMaps makeLocatedMaps(const SlicePlan& plan);

/// For each hexahedron of the outermost forward map 1 unless nothing can be seen in it.
/// @param slab  extent of a slab along a ray at most, world units; what is seen there counts too
std::vector<char> hexahedraSeen(const SlicePlan& plan, const Visibility& visibility, double slab);

}  // namespace voledit
