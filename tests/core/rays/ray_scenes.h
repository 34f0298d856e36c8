#pragma once
// Volumes, looks and scenes of the ray-caster's tests.

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/parallel.h"
#include "core/eval/ray_caster.h"
#include "core/rays/ray_renderer.h"
#include "tests/support/scenes.h"

namespace voledit::test {

inline const Camera kFront{Vec3(0, -6, 0), Vec3(0), Vec3(0, 0, 1), 30};
inline const Camera kOblique{Vec3(3, -5, 2.5), Vec3(0.1, 0, -0.1), Vec3(0.1, 0, 1), 32};
inline constexpr Index2 kSize{53, 41};

inline Picture drawn(const CompiledScene& scene, Index2 size = kSize, double budgetMs = 0) {
    RayRenderer renderer;
    renderer.begin(scene, size);
    while (!renderer.advance(budgetMs)) {
    }
    return renderer.picture();
}

/// Expects the same picture, to the bit, of every number of threads and in however many portions it is drawn.
inline void expectSameForThreads(const CompiledScene& scene) {
    const Index2 size(133, 97);
    setThreadCount(1);
    const Picture one = drawn(scene, size);
    for (const int threads : {2, 3, 0}) {
        setThreadCount(threads);
        EXPECT_EQ(drawn(scene, size).pixels, one.pixels) << threads << " threads";
    }
    EXPECT_EQ(drawn(scene, size, 1e-6).pixels, one.pixels) << "in portions";
}

/// What the reference draws with steps of 1/16.
inline Picture reference(CompiledScene scene, Index2 size = kSize) {
    scene.render.step /= 16;
    return castRays(scene, size);
}

/// Waves from 0 to 200.
inline double waves(const Vec3& p) {
    return 100 + 60 * std::sin(3 * p.x + p.y) * std::cos(2.5 * p.z) + 40 * std::sin(4 * p.y - p.x);
}

inline TransferFunction bands() {
    TransferFunction look;
    look.opacity.points = {{40, 0}, {60, 0.5}, {80, 0.1}, {100, 0}, {150, 0}, {180, 0.9}};
    look.color.points = {{0, Vec3(1, 0.2, 0.1)}, {100, Vec3(0.2, 0.9, 0.3)}, {200, Vec3(0.3, 0.4, 1)}};
    return look;
}

template <class T>
std::shared_ptr<const Volume> typed(Index3 size, const Mat4& worldFromIndex, double scale = 1, double offset = 0) {
    VolumeGrid grid{size, 1, worldFromIndex};
    std::vector<T> values;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                values.push_back(static_cast<T>(offset + scale * waves(transformPoint(worldFromIndex, {i, j, k}))));
    return Volume::fromValues(grid, std::move(values));
}

inline Mat4 unitGrid(int n) {
    return placementMatrix(Vec3(-1), Vec3(0), Vec3(2.0 / (n - 1)));
}

inline CompiledScene lit(CompiledScene scene) {
    scene.render.shading = true;
    return scene;
}

inline TransferFunction moved(TransferFunction look, double scale, double offset) {
    for (Vec2& point : look.opacity.points) point.x = offset + scale * point.x;
    for (ColorTable::Point& point : look.color.points) point.value = offset + scale * point.value;
    return look;
}

}  // namespace voledit::test
