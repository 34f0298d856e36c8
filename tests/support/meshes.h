#pragma once
// Meshes made by hand, in the middle of space: their values are 0 until a test gives some.

#include <algorithm>
#include <cmath>
#include <random>

#include "core/fields/mesh_data.h"
#include "core/stf/mapped_cells.h"

namespace voledit::test {

/// A curvilinear grid of `count` cells over a bent [−0.9, 0.9]³ (it holds [−0.5, 0.5]³), vertices i fastest.
inline MeshData warpedGrid(const Index3& count) {
    auto grid = gridCells(frameOf({Vec3(-0.9), Vec3(0.9)}), count);
    MeshData mesh;
    for (const Vec3& p : grid.deformed)
        mesh.points.push_back(p + 0.12 * Vec3(std::sin(2 * p.y + p.z), std::sin(2 * p.z - p.x), std::cos(2 * p.x)));
    mesh.hexahedra = std::move(grid.hexahedra);
    mesh.values.assign(mesh.points.size(), 0);
    return mesh;
}

/// A lump of tetrahedra, n of them across, that holds [−0.45, 0.45]³: irregular, in no order, oriented either way.
inline MeshData tetrahedralBall(int n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> jitter(-0.15, 0.15);
    const MappedCells grid(gridCells(frameOf({Vec3(-0.9), Vec3(0.9)}), Index3(n)));
    MeshData mesh;
    for (const Vec3& p : grid.deformed()) {
        const double cube = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), 1e-12});
        const double ball = std::max(std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z), 1e-12);
        const double cell = 1.8 / n * (cube < 0.89 ? 1 : 0);  // the surface stays as it is
        mesh.points.push_back(p * (0.4 + 0.6 * cube / ball) +
                              cell * Vec3(jitter(random), jitter(random), jitter(random)));
    }
    mesh.tetrahedra.assign(grid.tetrahedra().begin(), grid.tetrahedra().end());
    std::shuffle(mesh.tetrahedra.begin(), mesh.tetrahedra.end(), random);
    mesh.values.assign(mesh.points.size(), 0);
    return mesh;
}

}  // namespace voledit::test
