#include "core/eval/surroundings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace voledit {

namespace light_march {

namespace {
std::array<Vec3f, kDirections> madeDirections() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    std::array<Vec3f, kDirections> found{};
    std::size_t n = 0;
    const auto add = [&](const Vec3& v) { found[n++] = Vec3f(glm::normalize(v)); };
    for (int axis = 0; axis < 3; ++axis)
        for (int signs = 0; signs < 4; ++signs) {
            const auto turned = [&](double a, double b) {
                Vec3 v(0);
                v[(axis + 1) % 3] = signs & 1 ? -a : a;
                v[(axis + 2) % 3] = signs & 2 ? -b : b;
                return v;
            };
            add(turned(1, golden));           // an icosahedron's corner
            add(turned(golden, 1 / golden));  // a dodecahedron's, whose other eight are a cube's
        }
    for (int corner = 0; corner < 8; ++corner) add({corner & 1 ? -1 : 1, corner & 2 ? -1 : 1, corner & 4 ? -1 : 1});
    return found;
}
}  // namespace

const std::array<Vec3f, kDirections>& directions() {
    static const std::array<Vec3f, kDirections> found = madeDirections();
    return found;
}

// Longer the farther they are, and over means so wide that nothing between two samples is missed.
std::array<Stretch, kStretches> stretchesTo(float radius) {
    std::array<Stretch, kStretches> found{};
    for (int n = 0; n < kStretches; ++n) {
        const float from = float(n) / kStretches, to = float(n + 1) / kStretches;
        const float begin = radius * from * from, end = radius * to * to, middle = (begin + end) / 2;
        const int level = int(std::floor(std::log2(std::max((end - begin) / 2, 1.0F))));
        found[std::size_t(n)] = {middle, end - begin, std::min(level, OpacityGrid::kLevels - 1),
                                 1 - (middle / radius) * (middle / radius)};
    }
    return found;
}

}  // namespace light_march

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
    radius_ = float(settings.occlusionRadius * glm::length(scene.root->bounds.size()) / grid_->spacing());
}

Vec3f Surroundings::outward(const OpacityGrid& grid, const Vec3f& at) {
    constexpr float kReach = 1.5F;
    Vec3f difference(0);
    float sum = 0;
    for (int a = 0; a < 3; ++a) {
        Vec3f offset(0);
        offset[a] = kReach;
        const float ahead = grid.alpha(at + offset, 1), behind = grid.alpha(at - offset, 1);
        difference[a] = behind - ahead;
        sum += ahead + behind;
    }
    const float length = glm::length(difference);
    if (!(length > 0)) return Vec3f(0);
    // A side is clear where the difference is a good part of the mean.
    const float clear = std::min(length / (0.4F * sum / 6), 1.0F);
    return difference * (clear / length);
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

float Surroundings::openness(const OpacityGrid& grid, const Vec3f& at, const Vec3f& outward, float radius) {
    const auto stretches = stretchesTo(radius);
    const float clear = std::sqrt(glm::dot(outward, outward));
    float open = 0, weights = 0;
    for (const Vec3f& direction : directions()) {
        // Without a side all directions count alike.
        const float weight = glm::dot(direction, outward) - kFlattest * clear + (1 - clear);
        if (!(weight > 0)) continue;
        float left = 1, taken = 0;
        for (const Stretch& stretch : stretches) {
            const float alpha = grid.alpha(at + stretch.middle * direction, stretch.level);
            const float next = left * std::pow(1 - alpha, stretch.length);
            taken += (left - next) * stretch.counts;
            left = next;
        }
        open += weight * (1 - taken);
        weights += weight;
    }
    return weights > 0 ? open / weights : 1;
}

LightShare Surroundings::at(const Vec3& p, const Vec3& towardFirst) const {
    LightShare share;
    if (!grid_) return share;
    const Vec3f here = grid_->gridFromWorld(p), side = outward(*grid_, here), lifted = here + kLift * side;
    if (shadows_ > 0) share.first = 1 - shadows_ * (1 - through(*grid_, lifted, Vec3f(towardFirst)));
    if (occlusion_ > 0) share.ambient = 1 - occlusion_ * (1 - openness(*grid_, lifted, side, radius_));
    return share;
}

}  // namespace voledit
