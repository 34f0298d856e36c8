// Terms that hold no others: volumes, meshes, solids, fields.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/objects/cvg.h"
#include "core/objects/evaluation.h"
#include "core/stf/mesh_field.h"

namespace voledit {

namespace {

/// Points of a block and what is found there; on the stack, as a leaf holds no other term.
struct Chosen {
    std::array<std::uint32_t, kBlock> index;
    std::array<Vec3, kBlock> at, gradient;
    std::size_t count = 0;

    void add(std::size_t i, const Vec3& p) {
        index[count] = std::uint32_t(i);
        at[count++] = p;
    }
    std::span<const Vec3> points() const { return std::span(at).first(count); }
    std::span<Vec3> gradients() { return std::span(gradient).first(count); }
};

/// Values seen through a transfer function; gradientsAt(points, gradients) gives ∇ of the values.
template <class GradientsAt>
void classify(const TransferFunction& look, std::span<const double> value, std::span<const Vec3> p,
              std::span<ObjectSample> sample, const Asked& asked, const GradientsAt& gradientsAt) {
    Chosen visible;
    for (std::size_t i = 0; i < p.size(); ++i) {
        ObjectSample& s = sample[i];
        s = ObjectSample{.value = value[i]};
        if (s.value != s.value) continue;
        s.opacity = clampedOpacity(look.opacity(s.value));
        if (s.opacity > 0) visible.add(i, p[i]);
        if (s.opacity > 0 || asked.colorEverywhere) s.color = look.color(s.value);
    }
    const bool steepnessCounts = !look.gradientOpacity.points.empty();
    if (visible.count > 0 && (asked.gradient || steepnessCounts)) {
        gradientsAt(visible.points(), visible.gradients());
        for (std::size_t n = 0; n < visible.count; ++n) {
            ObjectSample& s = sample[visible.index[n]];
            const Vec3& gradient = visible.gradient[n];
            if (asked.gradient) s.normalGradient = gradient;
            if (steepnessCounts) s.opacity = clampedOpacity(s.opacity * look.gradientOpacity(glm::length(gradient)));
        }
    }
    if (asked.attribute && !asked.scalar())
        for (ObjectSample& s : sample) s.value = kNaN;
}

/// Distance from `box`, 0 within it.
double distanceOutside(const Box3& box, const Vec3& p) {
    return glm::length(glm::max(glm::max(box.min - p, p - box.max), Vec3(0)));
}

/// Values of a solid's opacity formula at points of distances d, clamped.
std::vector<double> opacityOf(const SolidTerm& node, std::span<const Vec3> p, std::span<const double> d) {
    std::array<std::vector<double>, 4> slots;
    std::array<const double*, 5> variables;
    const bool constant = node.opacity.isConstant(0);
    const std::size_t count = constant ? 1 : p.size();
    for (std::size_t s = 0; s < 4; ++s) {
        slots[s].resize(count);
        for (std::size_t i = 0; i < count && !constant; ++i)
            slots[s][i] = s < 3 ? p[i][int(s)] : glm::distance(p[i], node.center);
        variables[s] = slots[s].data();
    }
    variables[4] = d.data();
    std::vector<double> opacity(count);
    double* const output = opacity.data();
    node.opacity.evaluate(variables, node.parameters, std::span(&output, 1), count);
    for (double& o : opacity) o = clampedOpacity(o);
    if (constant) opacity.assign(p.size(), opacity.front());
    return opacity;
}

/// The points of `which` at which a field has `color`; a colour that is undefined or infinite empties the sample.
void colorAt(const FieldsTerm& node, std::span<const Vec3> at, std::span<const std::uint32_t> which,
             std::span<ObjectSample> sample) {
    std::vector<double> channel(at.size());
    for (int c = 0; c < 3; ++c) {
        node.color[std::size_t(c)]->sample(at, channel);
        for (std::size_t n = 0; n < which.size(); ++n) sample[which[n]].color[c] = channel[n];
    }
    for (const std::uint32_t i : which) {
        ObjectSample& s = sample[i];
        if (!std::isfinite(s.color.x + s.color.y + s.color.z)) s = {.value = s.value};
        s.color = glm::clamp(s.color, 0.0, 1.0);
    }
}

}  // namespace

std::vector<Vec3> gathered(std::span<const Vec3> p, std::span<const std::uint32_t> which) {
    std::vector<Vec3> at;
    at.reserve(which.size());
    for (const std::uint32_t i : which) at.push_back(p[i]);
    return at;
}

void evaluateVolume(const VolumeTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                    const Asked& asked) {
    std::array<double, kBlock> values;
    const std::span<double> value = std::span(values).first(p.size());
    node.volume->sample(p, value, node.channel, node.interpolation);
    classify(node.appearance, value, p, sample, asked, [&](std::span<const Vec3> at, std::span<Vec3> gradient) {
        node.volume->gradient(at, gradient, node.channel, node.interpolation);
    });
}

void evaluateMesh(const MeshTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked) {
    std::array<double, kBlock> values;
    const std::span<double> value = std::span(values).first(p.size());
    node.field->sample(p, value);
    classify(node.appearance, value, p, sample, asked,
             [&](std::span<const Vec3> at, std::span<Vec3> gradient) { node.field->gradient(at, gradient); });
}

void evaluateSolid(const SolidTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked) {
    std::array<double, kBlock> distance;
    node.distance->sample(p, std::span(distance).first(p.size()));
    std::vector<std::uint32_t> near;
    std::vector<double> d;
    for (std::size_t i = 0; i < p.size(); ++i) {
        sample[i] = {};
        if (!std::isfinite(distance[i])) continue;
        if (asked.colorEverywhere) sample[i].color = glm::clamp(node.color, 0.0, 1.0);
        // What a formula says beyond its bounds is not part of the shape.
        const double outside = distanceOutside(node.shape, p[i]);
        const double x = outside > 0 ? std::max(distance[i], outside) : distance[i];
        if (asked.depth) sample[i].depth = -x;
        if (x <= 0 || x < node.falloff || asked.depth) {
            near.push_back(std::uint32_t(i));
            d.push_back(x);
        }
    }
    if (near.empty()) return;
    const std::vector<Vec3> at = gathered(p, near);
    const std::vector<double> opacity = opacityOf(node, at, d);
    std::vector<Vec3> gradient(at.size());
    if (asked.gradient) node.distance->gradient(at, gradient);
    for (std::size_t n = 0; n < near.size(); ++n) {
        ObjectSample& s = sample[near[n]];
        if (asked.depth) s.normalGradient = -gradient[n];
        const double fade = d[n] <= 0 ? 1 : d[n] < node.falloff ? 1 - d[n] / node.falloff : 0;
        if (!(opacity[n] * fade > 0)) continue;
        s = {opacity[n] * fade, glm::clamp(node.color, 0.0, 1.0), kNaN, -gradient[n], s.depth};
    }
}

void evaluateFields(const FieldsTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                    const Asked& asked) {
    std::vector<std::uint32_t> inside, visible;
    for (std::size_t i = 0; i < p.size(); ++i) {
        sample[i] = {};
        if (node.box.contains(p[i])) inside.push_back(std::uint32_t(i));
    }
    if (inside.empty()) return;
    const std::vector<Vec3> within = gathered(p, inside);
    std::vector<double> value(within.size());
    node.opacity->sample(within, value);
    for (std::size_t n = 0; n < inside.size(); ++n) {
        sample[inside[n]].opacity = clampedOpacity(value[n]);
        if (sample[inside[n]].opacity > 0) visible.push_back(inside[n]);
    }
    const auto named = asked.attribute ? node.attributes.find(*asked.attribute) : node.attributes.end();
    if (named != node.attributes.end()) {
        named->second->sample(within, value);
        for (std::size_t n = 0; n < inside.size(); ++n) sample[inside[n]].value = value[n];
    }
    const std::vector<Vec3> seen = gathered(p, visible);
    if (asked.colorEverywhere)
        colorAt(node, within, inside, sample);
    else
        colorAt(node, seen, visible, sample);
    if (!asked.gradient) return;
    std::vector<Vec3> gradient(seen.size());
    node.opacity->gradient(seen, gradient);
    for (std::size_t n = 0; n < visible.size(); ++n)
        if (sample[visible[n]].opacity > 0) sample[visible[n]].normalGradient = gradient[n];
}

}  // namespace voledit
