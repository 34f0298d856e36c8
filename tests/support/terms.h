#pragma once
// Volumes, looks and lattices made by hand, for the evaluators' tests.

#include "core/objects/term.h"
#include "core/stf/affine.h"
#include "core/stf/lattice.h"

namespace voledit::test {

/// A volume of `value(p)` on n samples an axis over [−1, 1]³.
template <class Function>
std::shared_ptr<const Volume> sampledVolume(int n, const Function& value) {
    VolumeGrid grid{Index3(n), 1, placementMatrix(Vec3(-1), Vec3(0), Vec3(2.0 / (n - 1)))};
    std::vector<double> values;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) values.push_back(value(transformPoint(grid.worldFromIndex, {i, j, k})));
    return Volume::fromValues(grid, std::move(values));
}

/// One opacity and colour whatever the value.
inline TransferFunction constantLook(double opacity, const Vec3& color) {
    TransferFunction f;
    f.opacity.points = {{0, opacity}};
    f.color.points = {{0, color}};
    return f;
}

/// A Bézier lattice of 4³ points over [−1, 1]³, some of them moved by up to `amount` of the box.
inline std::shared_ptr<const LatticeMap> bentLattice(double amount, int cells, Outside outside = Outside::Hide) {
    const Frame frame = frameOf({Vec3(-1), Vec3(1)});
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, restControlPoints(LatticeBasis::Bezier, Index3(4), frame)};
    lattice.control[lattice.indexOf({3, 3, 3})] += amount * Vec3(2, 0.5, 1);
    lattice.control[lattice.indexOf({0, 2, 1})] += amount * Vec3(-1, 1, 0.5);
    lattice.control[lattice.indexOf({2, 0, 3})] += amount * Vec3(0.5, -2, -1);
    lattice.control[lattice.indexOf({1, 2, 2})] += amount * Vec3(1, 1, 1);
    return std::make_shared<LatticeMap>(lattice, Index3(cells), outside);
}

}  // namespace voledit::test
