#pragma once
// Cells cut into parts within which a chain of maps is affine, or nearly.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/rays/cell_look.h"

namespace voledit {

constexpr int kHalvings = 2;            // how often cells may be halved
constexpr int kUnits = 2 << kHalvings;  // places in a cell are counted in half sides of the smallest parts

/// Hexahedra to begin with: at each vertex its place p, and the place q where the maps go on from there.
struct Base {
    std::span<const Vec3> p, q;
    std::span<const Mat3> jacobian;  // dq/dp; empty where q = p
    std::span<const std::array<std::uint32_t, 8>> cells;
};

/// A value within a hexahedron that is affine in each of its six tetrahedra, at `units`, from those at its corners.
/// Halves of such hexahedra are such hexahedra again: their tetrahedra lie within those of the whole.
template <class T>
T within(std::span<const T> values, const std::array<std::uint32_t, 8>& cell, Index3 units) {
    std::array<int, 3> axes{0, 1, 2};
    const auto order = [&](std::size_t a, std::size_t b) {
        if (units[axes[b]] > units[axes[a]]) std::swap(axes[a], axes[b]);
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    T result = values[cell[0]];
    std::size_t corner = 0;
    for (const int axis : axes) {
        if (units[axis] == 0) break;
        const std::size_t next = corner + (std::size_t(1) << axis);
        result += double(units[axis]) / kUnits * (values[cell[next]] - values[cell[corner]]);
        corner = next;
    }
    return result;
}

/// Where the maps lead from the 3³ places of a part: its corners, and the middles of its edges, faces and itself.
using Nodes = std::array<Vec3, 27>;

constexpr std::size_t nodeAt(int i, int j, int k) {
    return std::size_t(i + 3 * (j + 3 * k));
}
inline Index3 cornerOf(int c) {
    return {c & 1, c >> 1 & 1, c >> 2};
}
/// A cell or a part of one.
struct Part {
    std::uint32_t cell = 0;
    Index3 first{0};  // corner, units
    int size = kUnits;
    std::array<Vec3, 8> x{};  // index space, at the corners
    double error = 0;         // voxels
};

/// Parts found by one portion of the work.
struct Found {
    std::vector<Part> affine, ragged;
    std::vector<Nodes> nodes;  // of the ragged ones

    void append(const Found& other) {
        affine.insert(affine.end(), other.affine.begin(), other.affine.end());
        ragged.insert(ragged.end(), other.ragged.begin(), other.ragged.end());
        nodes.insert(nodes.end(), other.nodes.begin(), other.nodes.end());
    }
};

/// Calls body(begin, end, result) for portions of [0, count), `grain` long, in parallel; gives the results in order.
template <class Result, class Body>
std::vector<Result> inPortions(std::size_t count, std::size_t grain, const Body& body) {
    std::vector<Result> portions((count + grain - 1) / grain);
    parallelFor(portions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) body(n * grain, std::min((n + 1) * grain, count), portions[n]);
    });
    return portions;
}

bool finite(const Vec3& v);
/// The largest component's size; NaN where one is.
double largestOf(const Vec3& v);

/// Finds the parts of all cells: as large as lets the maps be affine, where there is something to see.
class ChainParts {
public:
    /// All must outlive it.
    ChainParts(const CellWay& way, const VolumeLook& look, const Base& base, bool rough);

    /// Sorts all cells into affine and ragged parts; in parallel.
    Found find() const;

    /// Whether something within `margin` voxels of `box`, index space, may be seen.
    bool visible(const Box3& box, double margin) const {
        return skip_.mayBeVisible(intersect({box.min - margin, box.max + margin}, domain_));
    }
    const Box3& domain() const { return domain_; }
    /// How far maps may be from what their interpolation says, voxels.
    double tolerance() const { return tolerance_; }

private:
    /// Parts whose corners are known; the places at their middles stand in `places`, part after part.
    struct Asked {
        std::vector<Part> parts;
        std::vector<Nodes> nodes;
        std::vector<Vec3> places;
    };
    enum class Kind : std::uint8_t { Empty, Affine, Ragged };

    void ask(const Part& part, const Nodes& corners, Asked& asked) const;
    void askHalves(const Part& part, const Nodes& x, Asked& asked) const;
    void decide(Asked& asked, Found& to) const;
    Kind kindOf(const Nodes& x, Part& part) const;
    bool mayHide(const Part& part) const;

    const CellWay& way_;
    const Base& base_;
    double tolerance_;
    int smallest_;  // size of parts
    const SkipGrid& skip_;
    Box3 domain_;
};

}  // namespace voledit
