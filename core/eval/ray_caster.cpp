#include "core/eval/ray_caster.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/base/parallel.h"
#include "core/eval/cut_faces.h"
#include "core/eval/surroundings.h"
#include "core/fields/extinction.h"
#include "core/objects/empty_space.h"

namespace voledit {

namespace {

constexpr double kOpaque = 1e-5;       // transmittance below which the rest of a ray cannot be seen
constexpr double kUnseen = 1e-5;       // share of a pixel for which no cut is looked for
constexpr double kSlight = 1 / 512.0;  // share of a pixel for which light is not followed anew
constexpr std::size_t kFirstBlock = 16, kLargestBlock = 256;  // samples of a ray evaluated together

struct Ray {
    Vec3 origin, direction;    // unit
    double near = 0, far = 0;  // within the bounds; near ≥ 0
};

/// The part of the ray within `box`, before the eye left out; nullopt where it misses.
std::optional<Ray> clipped(const Vec3& origin, const Vec3& direction, const Box3& box) {
    if (box.empty()) return std::nullopt;
    Ray ray{origin, direction, 0, kInfinity};
    for (int a = 0; a < 3; ++a) {
        if (direction[a] == 0) {
            if (origin[a] < box.min[a] || origin[a] > box.max[a]) return std::nullopt;
            continue;
        }
        const double first = (box.min[a] - origin[a]) / direction[a], second = (box.max[a] - origin[a]) / direction[a];
        ray.near = std::max(ray.near, std::min(first, second));
        ray.far = std::min(ray.far, std::max(first, second));
    }
    if (!(ray.near < ray.far)) return std::nullopt;
    return ray;
}

class RayCaster {
public:
    RayCaster(const CompiledScene& scene, Index2 size)
        : scene_(scene),
          space_(emptySpaceOf(*scene.root)),
          lights_(lightsOf(scene.render, scene.camera)),
          surroundings_(scene),
          cuts_(scene),
          size_(size),
          step_(scene.stepLength()) {
        assert(step_ > 0 && scene.opacityDistance > 0);
    }

    Vec4f pixel(int x, int y) {
        const Vec3 direction = rayThrough(scene_.camera, size_, x, y);
        color_ = Vec3(0);
        transmittance_ = 1;
        if (const auto ray = clipped(scene_.camera.eye, direction, scene_.root->bounds)) march(*ray);
        return Vec4f(color_ + transmittance_ * scene_.render.background, 1 - transmittance_);
    }

    std::uint64_t samples() const { return samples_; }

private:
    void march(const Ray& ray) {
        toEye_ = -ray.direction;
        ray_ = ray;
        share_.reset();
        cut_.reset();
        entered_.reset();
        seenAt_ = -kInfinity;
        const double length = ray.far - ray.near;
        const auto steps = std::size_t(std::ceil(length / step_));
        std::size_t block = kFirstBlock;  // small at first: many rays end soon after they meet a surface
        points_.clear();
        depths_.clear();
        lengths_.clear();
        for (std::size_t n = 0; n < steps && transmittance_ >= kOpaque;) {
            // The last step is what is left of the ray, sampled in its own middle.
            const double from = double(n) * step_, to = std::min(from + step_, length);
            const double depth = ray.near + 0.5 * (from + to);
            const Vec3 p = ray.origin + depth * ray.direction;
            if (const double empty = space_.emptyAhead(p, ray.direction); empty > 0) {
                // Samples keep their places: what is left out would have had opacity 0.
                n += std::max<std::size_t>(1, std::size_t(std::ceil(std::min(empty / step_, double(steps)))));
                continue;
            }
            points_.push_back(p);
            depths_.push_back(depth);
            lengths_.push_back(to - from);
            ++n;
            if (points_.size() < block) continue;
            composite();
            block = std::min(2 * block, kLargestBlock);
        }
        composite();
    }

    void composite() {
        values_.resize(points_.size());
        sample(*scene_.root, points_, values_, scene_.render.shading, "");  // no attribute
        samples_ += points_.size();
        for (std::size_t n = 0; n < points_.size() && transmittance_ >= kOpaque; ++n) {
            const ObjectSample& s = values_[n];
            if (!(s.opacity > 0)) continue;
            const double through =
                std::pow(1 - std::min(s.opacity, kLargestOpacity), lengths_[n] / scene_.opacityDistance);
            const double weight = transmittance_ * (1 - through);
            if (scene_.render.shading) findCut(depths_[n], weight);
            color_ += weight * lit(n, weight);
            transmittance_ *= through;
        }
        points_.clear();
        depths_.clear();
        lengths_.clear();
    }

    /// The colour of sample n, which has a share of `weight` in the pixel.
    Vec3 lit(std::size_t n, double weight) {
        const ObjectSample& s = values_[n];
        const Vec3 gradient = cut_ ? cuts_.blended(*cut_, points_[n], depths_[n], s.normalGradient) : s.normalGradient;
        if (!surroundings_.none() && gradient != Vec3(0) && (!share_ || weight > kSlight))
            share_ = surroundings_.at(points_[n], toEye_);
        return litColor(scene_.render, lights_, s.color, gradient, toEye_, share_.value_or(LightShare()));
    }

    /// Notes where something begins to be seen, and looks whether that is at a cut as soon as it matters.
    void findCut(double depth, double weight) {
        if (!cuts_.mayCut()) return;
        const bool begins = depth - seenAt_ > 1.5 * step_;
        seenAt_ = depth;
        if (begins) {
            entered_ = depth;
            cut_.reset();
        }
        if (!entered_ || !(weight > kUnseen)) return;
        const double begun = *entered_;
        entered_.reset();
        if (depth - begun > 2 * cuts_.thickness()) return;
        cut_ = cuts_.before(ray_.origin, ray_.direction, begun);
    }

    const CompiledScene& scene_;
    const EmptySpace& space_;
    Lights lights_;
    Surroundings surroundings_;
    CutFinder cuts_;
    Index2 size_;
    double step_;
    Vec3 toEye_{0};
    std::optional<LightShare> share_;  // of the ray's last sample
    std::optional<CutFace> cut_;       // that the ray passed last, if what is seen began there
    std::optional<double> entered_;    // where what is seen began, until it was looked for a cut there
    double seenAt_ = 0;                // the last sample in which something was seen
    Ray ray_;
    Vec3 color_{0};
    double transmittance_ = 1;
    std::uint64_t samples_ = 0;
    std::vector<Vec3> points_;
    std::vector<double> depths_, lengths_;
    std::vector<ObjectSample> values_;
};

}  // namespace

void castPixels(const CompiledScene& scene, Picture& picture, Index2 first, Index2 end, RayStatistics* statistics) {
    assert(first.x >= 0 && first.y >= 0 && end.x <= picture.size.x && end.y <= picture.size.y);
    RayCaster caster(scene, picture.size);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) picture.at(x, y) = caster.pixel(x, y);
    if (statistics) statistics->samples += caster.samples();
}

Picture castRays(const CompiledScene& scene, Index2 size, RayStatistics* statistics, Progress* progress) {
    Picture picture(size);
    const Surroundings prepared(scene);  // kept with the term; rows find it there
    std::atomic<std::uint64_t> samples{0};
    std::atomic<int> done{0};
    parallelFor(std::size_t(size.y), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            report(progress, double(done++) / size.y);
            RayStatistics ofRow;
            castPixels(scene, picture, {0, int(row)}, {size.x, int(row) + 1}, &ofRow);
            samples += ofRow.samples;
        }
    });
    if (statistics) statistics->samples += samples;
    report(progress, 1);
    return picture;
}

}  // namespace voledit
