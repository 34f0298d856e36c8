#include "core/eval/surroundings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/objects/term_cache.h"

namespace voledit {

using namespace light_march;

namespace {
constexpr double kFewestCells = 32;  // along the longest side
}

double surroundingsSpacing(const CompiledScene& scene) {
    const Vec3 size = scene.root->bounds.size();
    // A scaled volume's own spacing says nothing of the world's.
    const double longest = std::max({size.x, size.y, size.z});
    return std::min(std::max(scene.unitStep, scene.stepLength()), longest / kFewestCells);
}

Surroundings::Surroundings(const CompiledScene& scene) {
    const RenderSettings& settings = scene.render;
    if (!settings.shading || !(settings.shadows > 0 || settings.occlusion > 0) || scene.root->bounds.empty()) return;
    shadows_ = float(settings.shadows);
    occlusion_ = float(settings.occlusion);
    grid_ = opacityGridOf(*scene.root, surroundingsSpacing(scene), scene.opacityDistance);
    const TermCache& cache = *scene.root->cache;
    if (occlusion_ > 0) {
        const double reach = settings.occlusionRadius * glm::length(scene.root->bounds.size());
        openness_ = cache.openness(grid_, float(reach / grid_->spacing()));
    }
    const Lights lights = lightsOf(settings, scene.camera);
    if (shadows_ > 0 && lights.kind != Lights::Kind::Head) {
        towardFirst_ = Vec3f(lights.light[0].toward);
        shadowVolume_ = cache.shadows(grid_, towardFirst_);
    }
}

float Surroundings::through(const OpacityGrid& grid, const Vec3f& at, const Vec3f& toward) {
    const Vec3f size(grid.size());
    float left = 1;
    for (float s = kStart + 0.5F; left > kDark;) {
        const Vec3f x = at + s * toward;
        if (!(x.x > 0 && x.y > 0 && x.z > 0 && x.x < size.x && x.y < size.y && x.z < size.z)) break;
        const Index3 brick = Index3(x) / OpacityGrid::kBrick;
        if (const int clear = grid.clearanceOf(brick); clear > 0) {
            float exit = 1e30F;
            for (int a = 0; a < 3; ++a) {
                if (toward[a] == 0) continue;
                const int face = toward[a] > 0 ? brick[a] + clear : brick[a] - clear + 1;
                exit = std::min(exit, (float(face * OpacityGrid::kBrick) - x[a]) / toward[a]);
            }
            s += std::max(std::ceil(exit), 1.0F);  // samples keep their places
            continue;
        }
        left *= 1 - grid.alpha(x);
        s += 1;
    }
    return left > kDark ? left : 0;
}

LightShare Surroundings::at(const Vec3& p, const Vec3& toEye) const {
    LightShare share;
    if (!grid_) return share;
    const Vec3f here = grid_->gridFromWorld(p), lifted = here + kLift * outwardOf(*grid_, here);
    if (shadows_ > 0) {
        const float left =
            shadowVolume_ ? shadowVolume_->at(lifted + kStart * towardFirst_) : through(*grid_, lifted, Vec3f(toEye));
        share.first = 1 - shadows_ * (1 - left);
    }
    if (openness_) share.ambient = 1 - occlusion_ * (1 - openness_->at(lifted));
    return share;
}

}  // namespace voledit
