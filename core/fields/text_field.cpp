#include "core/fields/text_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/fields/outline_distance.h"
#include "core/fields/value_bricks.h"

namespace voledit {

namespace {

constexpr double kSamplesPerHeight = 128;
constexpr double kLongestTable = 2048;  // samples along x: what any graphics driver takes as a texture
constexpr double kMargin = 0.25;        // about the letters, capital heights

/// Samples of the table that points of the x–z plane fall to, and how far beyond it they are.
struct TablePlace {
    Vec3 inside;  // y = 0
    Vec3 beyond;
};
TablePlace placeOf(const Box3& table, const Vec3& p) {
    const Vec3 inside = glm::clamp(Vec3(p.x, 0, p.z), table.min, table.max);
    return {inside, Vec3(p.x, 0, p.z) - inside};
}

double extruded(double plane, double cap) {
    return std::min(std::max(plane, cap), 0.0) + std::hypot(std::max(plane, 0.0), std::max(cap, 0.0));
}

Box3 tableBox(const Volume& outline) {
    const Box3 box = boundsOf(outline.grid().worldFrame());
    return {{box.min.x, 0, box.min.z}, {box.max.x, 0, box.max.z}};
}

}  // namespace

TextField::TextField(const std::string& text, double height, double depth) : depth_(depth) {
    if (!(height > 0) || !std::isfinite(height) || !(depth > 0) || !std::isfinite(depth))
        throw Error("text solid", "its height or depth is not above 0", "give lengths");
    const std::vector<GlyphOutline> letters = outlinesOf(text, height);
    for (const GlyphOutline& letter : letters) {
        bounds_ = join(bounds_, Vec3(letter.min.x, -0.5 * depth, letter.min.y));
        bounds_ = join(bounds_, Vec3(letter.max.x, 0.5 * depth, letter.max.y));
    }
    const double width = bounds_.max.x - bounds_.min.x + 2 * kMargin * height;
    outline_ =
        tabulatedDistance(letters, std::max(height / kSamplesPerHeight, width / (kLongestTable - 2)), kMargin * height);
}

void TextField::sample(std::span<const Vec3> p, std::span<double> value) const {
    assert(p.size() == value.size());
    const Box3 table = tableBox(*outline_);
    std::vector<Vec3> inside(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) inside[i] = isDefined(p[i]) ? placeOf(table, p[i]).inside : kUndefined;
    outline_->sample(inside, value);
    for (std::size_t i = 0; i < p.size(); ++i)
        value[i] = extruded(value[i] + glm::length(placeOf(table, p[i]).beyond), std::abs(p[i].y) - 0.5 * depth_);
}

void TextField::gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const {
    assert(p.size() == gradient.size());
    const Box3 table = tableBox(*outline_);
    std::vector<Vec3> inside(p.size());
    std::vector<double> value(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) inside[i] = isDefined(p[i]) ? placeOf(table, p[i]).inside : kUndefined;
    outline_->sample(inside, value);
    outline_->gradient(inside, gradient);
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!isDefined(p[i])) {
            gradient[i] = Vec3(0);
            continue;
        }
        const Vec3 beyond = placeOf(table, p[i]).beyond;
        const double distance = glm::length(beyond);
        for (int a = 0; a < 3 && distance > 0; ++a)
            if (beyond[a] != 0) gradient[i][a] = 0;
        if (distance > 0) gradient[i] += beyond / distance;
        const double plane = value[i] + distance, cap = std::abs(p[i].y) - 0.5 * depth_;
        const Vec3 ofCap(0, p[i].y < 0 ? -1 : 1, 0);
        if (plane > 0 && cap > 0)
            gradient[i] = (plane * gradient[i] + cap * ofCap) / std::hypot(plane, cap);
        else if (cap > plane)
            gradient[i] = ofCap;
    }
}

Interval TextField::range(const Box3& box) const {
    const Box3 table = tableBox(*outline_);
    const Box3 inside{placeOf(table, box.min).inside, placeOf(table, box.max).inside};
    const Interval tabulated =
        rangeWithin(*outline_, 0, Interpolation::Linear, movedBox(inside, outline_->indexFromWorld()));
    const auto inPlane = [](const Vec3& v) { return glm::length(glm::max(Vec3(v.x, 0, v.z), Vec3(0))); };
    const Interval beyond{inPlane(glm::max(table.min - box.max, box.min - table.max)),
                          inPlane(glm::max(table.min - box.min, box.max - table.max))};
    const double half = 0.5 * depth_;
    const Interval cap{std::max(std::max(box.min.y, -box.max.y), 0.0) - half,
                       std::max(std::abs(box.min.y), std::abs(box.max.y)) - half};
    return {extruded(tabulated.low + beyond.low, cap.low), extruded(tabulated.high + beyond.high, cap.high)};
}

}  // namespace voledit
