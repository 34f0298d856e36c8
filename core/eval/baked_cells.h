#pragma once
// Mapped cells baked into a map (baked_map.h), tetrahedron by tetrahedron.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/eval/baked_map.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

/// Mapped cells as a baked map has them.
struct BakedCells {
    const MappedCells* cells;   // that do not overlap
    Mat4 worldFromDeformed{1};  // affine maps outside the cells
    Mat4 placeFromSource{1};    // and inside them
    /// Whether the tetrahedra whose places lie in a box are wanted; nodes in others stay unknown. Called from many
    /// threads.
    std::function<bool(const Box3&)> wanted;
};

/// The tetrahedra of cells that are wanted, set up for one grid. In parallel; the same for any number of threads.
class CellBaker {
public:
    CellBaker(const BakedCells& cells, const BakeGrid& grid);

    /// Exact at every node within a wanted tetrahedron.
    BakedMap bake() const;

    /// Centres of cells of the grid (every fourth layer of them) for which `seen` says 1: one flag for each, i fastest.
    std::vector<BakedMap::Known> centres(const std::vector<std::uint8_t>& seen) const;

private:
    /// The weights of a tetrahedron's four vertices as affine functions, and what each says along a row.
    struct Faces {
        std::array<double, 4> start, rateY, rateZ;
        std::array<double, 4> inverse;  // −1 / rateX; very large where the weight does not change along a row
        std::array<double, 4> from;     // ∞ where points of a row are within from its zero on, else −∞
        std::array<double, 4> to;       // −∞ where they are so up to there, else ∞
    };
    /// A tetrahedron in grid coordinates.
    struct Tetrahedron {
        Vec3 low, high;  // box
        Faces faces;
        Mat3 placeRate;  // columns: along the grid's axes
        Vec3 placeStart;

        /// False where it is flat.
        bool setUp(const std::array<Vec3, 4>& corner, const std::array<Vec3, 4>& place);
        /// Calls filled(i, place) for the points (i + offset, y, z) that lie in it, 0 ≤ i < count.
        template <class Filled>
        void fillRow(double offset, double y, double z, int count, const Filled& filled) const;
    };
    /// Neighbours in the cells' order.
    struct Part {
        std::vector<Tetrahedron> tetrahedra;
        std::vector<std::array<float, 2>> layers;  // where each of them begins and ends

        void add(const Tetrahedron& t);
    };
    /// Points of a grid whose first one is `offset` an axis: all rows of every `every`th layer.
    struct Points {
        Index3 count;
        double offset;
        int every;
    };
    /// Calls filled(index, place) for those that lie in a tetrahedron, layer by layer from many threads; for points in
    /// several tetrahedra in their order.
    template <class Filled>
    void fill(const Points& points, const Filled& filled) const;

    BakeGrid grid_;
    std::vector<Part> parts_;
};

}  // namespace voledit
