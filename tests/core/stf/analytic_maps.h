#pragma once
// Maps and fields written as C++ functions, to test what is made of others.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <utility>
#include <vector>

#include "core/fields/scalar_field.h"
#include "core/stf/affine.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// A map by a function; source boxes about the image of one point of the box (its centre, if the test names no other),
/// `slope` times the box's diagonal to each side.
class FunctionMap final : public SpatialTransferFunction {
public:
    using Function = std::function<Vec3(const Vec3&)>;
    FunctionMap(
        Function f, double slope, std::function<Box3(const Box3&)> image = {},
        std::function<Vec3(const Box3&)> anchor = [](const Box3& box) { return box.center(); })
        : f_(std::move(f)), slope_(slope), image_(std::move(image)), anchor_(std::move(anchor)) {}

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override {
        for (std::size_t i = 0; i < p.size(); ++i) q[i] = isDefined(p[i]) ? f_(p[i]) : kUndefined;
    }
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override {
        const double h = 1e-5;
        for (std::size_t i = 0; i < p.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                Vec3 step(0);
                step[c] = h;
                jacobian[i][c] = (f_(p[i] + step) - f_(p[i] - step)) / (2 * h);
            }
            if (!isDefined(f_(p[i]))) jacobian[i] = Mat3(1);
        }
    }
    Box3 imageOf(const Box3& rest) const override { return image_ ? image_(rest) : rest; }
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override {
        const Vec3 centre = f_(anchor_(box)), half = Vec3(slope_ * glm::length(box.size()));
        return isDefined(centre) && found({centre - half, centre + half});
    }
    void accept(TransferVisitor&) const override {}

private:
    Function f_;
    double slope_;
    std::function<Box3(const Box3&)> image_;
    std::function<Vec3(const Box3&)> anchor_;
};

/// A field by functions; its range is given, for every box.
class FunctionField final : public ScalarField {
public:
    FunctionField(std::function<double(const Vec3&)> f, std::function<Vec3(const Vec3&)> gradient, Interval range,
                  Box3 domain = {Vec3(-kInfinity), Vec3(kInfinity)})
        : f_(std::move(f)), gradient_(std::move(gradient)), range_(range), domain_(domain) {}

    void sample(std::span<const Vec3> p, std::span<double> value) const override {
        for (std::size_t i = 0; i < p.size(); ++i) value[i] = domain_.contains(p[i]) ? f_(p[i]) : kNaN;
    }
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override {
        for (std::size_t i = 0; i < p.size(); ++i) gradient[i] = domain_.contains(p[i]) ? gradient_(p[i]) : Vec3(0);
    }
    Interval range(const Box3&) const override { return range_; }
    Box3 domain() const override { return domain_; }
    void accept(FieldVisitor&) const override {}

private:
    std::function<double(const Vec3&)> f_;
    std::function<Vec3(const Vec3&)> gradient_;
    Interval range_;
    Box3 domain_;
};

inline TransferPtr translation(const Vec3& by) {
    return std::make_shared<AffineMap>(placementMatrix(by, Vec3(0), Vec3(1)));
}

/// A smooth warp: q = p + 0.1·(sin 3y, sin 3z, sin 3x).
inline TransferPtr wave() {
    return std::make_shared<FunctionMap>(
        [](const Vec3& p) { return p + 0.1 * Vec3(std::sin(3 * p.y), std::sin(3 * p.z), std::sin(3 * p.x)); }, 0.7,
        [](const Box3& rest) {
            return Box3{rest.min - 0.1, rest.max + 0.1};
        });
}

/// Undefined where x > 0, moved by `by` elsewhere.
inline TransferPtr halfSpace(const Vec3& by) {
    return std::make_shared<FunctionMap>([by](const Vec3& p) { return p.x > 0 ? kUndefined : p + by; }, 1,
                                         [by](const Box3& rest) {
                                             return Box3{rest.min - by, rest.max - by};
                                         },
                                         [](const Box3& box) { return box.min; });
}

inline FieldPtr xField(double offset = 0) {
    return std::make_shared<FunctionField>([=](const Vec3& p) { return p.x + offset; },
                                           [](const Vec3&) { return Vec3(1, 0, 0); },
                                           Interval{-1 + offset, 1 + offset});
}

/// `count` points in `box`, the same every time.
inline std::vector<Vec3> randomPoints(const Box3& box, std::size_t count, unsigned seed = 1) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Vec3> points(count);
    for (Vec3& p : points) p = box.min + Vec3(unit(random), unit(random), unit(random)) * (box.max - box.min);
    return points;
}

inline std::vector<Vec3> mappedBy(const SpatialTransferFunction& map, std::vector<Vec3> p) {
    map.map(p, p);
    return p;
}

/// Largest difference between `map`'s Jacobian and central differences of its points, entry by entry.
inline double jacobianError(const SpatialTransferFunction& map, const std::vector<Vec3>& points) {
    std::vector<Mat3> jacobian(points.size());
    map.jacobian(points, jacobian);
    const double h = 1e-5;
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            Vec3 step(0);
            step[c] = h;
            const auto ends = mappedBy(map, {points[i] - step, points[i] + step});
            const Vec3 difference = (ends[1] - ends[0]) / (2 * h) - jacobian[i][c];
            for (int r = 0; r < 3; ++r) worst = std::max(worst, std::abs(difference[r]));
        }
    return worst;
}

/// How many of `points` that `map` carries into `rest` lie outside of its imageOf(rest).
inline int strayImages(const SpatialTransferFunction& map, const Box3& rest, const std::vector<Vec3>& points) {
    const Box3 image = map.imageOf(rest);
    const auto q = mappedBy(map, points);
    int stray = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        stray += isDefined(q[i]) && rest.contains(q[i]) && !image.contains(points[i]);
    return stray;
}

/// How many points of `box` map outside of all boxes of anySourceBox(box).
inline int straySources(const SpatialTransferFunction& map, const Box3& box, unsigned seed = 1) {
    const auto q = mappedBy(map, randomPoints(box, 200, seed));
    int stray = 0;
    for (const Vec3& source : q)
        stray += isDefined(source) && !map.anySourceBox(box, [&](const Box3& b) {
            return Box3{b.min - 1e-12, b.max + 1e-12}.contains(source);
        });
    return stray;
}

}  // namespace voledit
