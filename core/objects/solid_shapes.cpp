#include "core/objects/solid_shapes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/fields/simple_fields.h"
#include "core/fields/text_field.h"

namespace voledit {

namespace {

// Distances are written so that their derivatives are those of the branch taken: no root of 0 where a surface is near.
constexpr const char* kSphere = "sqrt((x - cx)^2 + (y - cy)^2 + (z - cz)^2) - radius";

constexpr const char* kBoxDistance = "select(deepest > 0, sqrt(max(dx, 0)^2 + max(dy, 0)^2 + max(dz, 0)^2), deepest)";

// In a frame of the shape: s along its axis, across the distance from it.
constexpr const char* kCapsule = "sqrt(u^2 + v^2 + max(abs(s) - half, 0)^2) - radius";

constexpr const char* kCylinder = "select(deepest > 0, sqrt(max(side, 0)^2 + max(cap, 0)^2), deepest)";

// A torus whose tube is wider than its ring overlaps itself: what lies nearest to its inner, hidden part is nearest to
// a tip, where the visible part ends.
constexpr const char* kTorus =
    "select((major - across) * minor > major * tube, -sqrt(across^2 + (abs(s) - tip)^2), tube - minor)";

FormulaLet let(const char* name, const char* formula) {
    return {name, {formula, "", 1, 1}};
}

/// A formula over x, y, z whose parameters are one number each.
struct ParametricFormula {
    std::vector<FormulaLet> lets;
    const char* distance;
    std::vector<std::pair<const char*, double>> parameters;
};

FieldPtr fieldOf(const ParametricFormula& shape) {
    FormulaSymbols symbols;
    symbols.variables = {{"x"}, {"y"}, {"z"}};
    std::vector<double> values;
    for (const auto& [name, value] : shape.parameters) {
        symbols.parameters.push_back({name});
        values.push_back(value);
    }
    FormulaGraph graph(shape.lets, {{{shape.distance, "", 1, 1}, FormulaType::Number}}, symbols);
    return std::make_shared<ExpressionField>(std::move(graph), std::move(values));
}

/// A shape of revolution: lets u, v across and s along its axis, from its centre.
ParametricFormula revolved(const Vec3& center, const Vec3& axis) {
    const Vec3 helper = std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 u = glm::normalize(helper - glm::dot(helper, axis) * axis), v = glm::cross(axis, u);
    return {{let("u", "(x - cx) * ux + (y - cy) * uy + (z - cz) * uz"),
             let("v", "(x - cx) * vx + (y - cy) * vy + (z - cz) * vz"),
             let("s", "(x - cx) * ax + (y - cy) * ay + (z - cz) * az")},
            "",
            {{"cx", center.x},
             {"cy", center.y},
             {"cz", center.z},
             {"ux", u.x},
             {"uy", u.y},
             {"uz", u.z},
             {"vx", v.x},
             {"vy", v.y},
             {"vz", v.z},
             {"ax", axis.x},
             {"ay", axis.y},
             {"az", axis.z}}};
}

[[noreturn]] void refuse(const std::string& shape, const std::string& what, const std::string& remedy) {
    throw Error("solid of shape " + shape, what, remedy);
}

void requirePositive(const std::string& shape, const char* name, double value) {
    if (!(value > 0) || !std::isfinite(value)) refuse(shape, std::string(name) + " is not above 0", "give a length");
}

void requireFinite(const std::string& shape, const Vec3& v) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
        refuse(shape, "a number is not finite", "give finite numbers");
}

void requireBox(const std::string& shape, const Box3& box) {
    requireFinite(shape, box.min);
    requireFinite(shape, box.max);
    if (!(box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z))
        refuse(shape, "min is not below max on every axis", "give a box with an inside");
}

/// The segment between two ends: centre, unit axis, half its length.
struct Segment {
    Vec3 center, axis;
    double half;
};

Segment segmentOf(const std::string& shape, const Vec3& from, const Vec3& to) {
    requireFinite(shape, from);
    requireFinite(shape, to);
    const double length = glm::distance(from, to);
    if (!(length > 0) || !std::isfinite(length)) refuse(shape, "from and to are one point", "give two points");
    return {0.5 * (from + to), (to - from) / length, 0.5 * length};
}

/// Half sides of the box of a disc of radius 1 across a unit axis.
Vec3 discReach(const Vec3& axis) {
    return glm::sqrt(glm::max(Vec3(1) - axis * axis, Vec3(0)));
}

struct MakeDistance {
    double time;

    SolidDistance operator()(const SphereShape& s) const {
        requireFinite("sphere", s.center);
        requirePositive("sphere", "radius", s.radius);
        return {
            fieldOf({{}, kSphere, {{"cx", s.center.x}, {"cy", s.center.y}, {"cz", s.center.z}, {"radius", s.radius}}}),
            {s.center - s.radius, s.center + s.radius},
            s.center};
    }

    SolidDistance operator()(const BoxShape& s) const {
        const Box3 box{s.min, s.max};
        requireBox("box", box);
        const Vec3 c = box.center(), h = 0.5 * box.size();
        return {fieldOf({{let("dx", "abs(x - cx) - hx"), let("dy", "abs(y - cy) - hy"), let("dz", "abs(z - cz) - hz"),
                          let("deepest", "max(max(dx, dy), dz)")},
                         kBoxDistance,
                         {{"cx", c.x}, {"cy", c.y}, {"cz", c.z}, {"hx", h.x}, {"hy", h.y}, {"hz", h.z}}}),
                box, c};
    }

    SolidDistance operator()(const CylinderShape& s) const {
        const Segment along = segmentOf("cylinder", s.from, s.to);
        requirePositive("cylinder", "radius", s.radius);
        ParametricFormula formula = revolved(along.center, along.axis);
        formula.lets.push_back(let("side", "sqrt(u^2 + v^2) - radius"));
        formula.lets.push_back(let("cap", "abs(s) - half"));
        formula.lets.push_back(let("deepest", "max(side, cap)"));
        formula.distance = kCylinder;
        formula.parameters.insert(formula.parameters.end(), {{"radius", s.radius}, {"half", along.half}});
        const Vec3 reach = along.half * glm::abs(along.axis) + s.radius * discReach(along.axis);
        return {fieldOf(formula), {along.center - reach, along.center + reach}, along.center};
    }

    SolidDistance operator()(const CapsuleShape& s) const {
        const Segment along = segmentOf("capsule", s.from, s.to);
        requirePositive("capsule", "radius", s.radius);
        ParametricFormula formula = revolved(along.center, along.axis);
        formula.distance = kCapsule;
        formula.parameters.insert(formula.parameters.end(), {{"radius", s.radius}, {"half", along.half}});
        const Box3 ends = join(Box3{s.from, s.from}, s.to);
        return {fieldOf(formula), {ends.min - s.radius, ends.max + s.radius}, along.center};
    }

    SolidDistance operator()(const TorusShape& s) const {
        requireFinite("torus", s.center);
        requireFinite("torus", s.axis);
        requirePositive("torus", "major", s.major);
        requirePositive("torus", "minor", s.minor);
        const double length = glm::length(s.axis);
        if (!(length > 0)) refuse("torus", "its axis is 0", "give a direction");
        const Vec3 axis = s.axis / length;
        ParametricFormula formula = revolved(s.center, axis);
        formula.lets.push_back(let("across", "sqrt(u^2 + v^2)"));
        formula.lets.push_back(let("tube", "sqrt((across - major)^2 + s^2)"));
        formula.distance = kTorus;
        const double tip = std::sqrt(std::max(s.minor * s.minor - s.major * s.major, 0.0));
        formula.parameters.insert(formula.parameters.end(), {{"major", s.major}, {"minor", s.minor}, {"tip", tip}});
        const Vec3 reach = s.major * discReach(axis) + s.minor;
        return {fieldOf(formula), {s.center - reach, s.center + reach}, s.center};
    }

    SolidDistance operator()(const TextShape& s) const {
        auto text = std::make_shared<TextField>(s.string, s.height, s.depth);
        const Box3 box = text->bounds();
        return {std::move(text), box, box.center()};
    }

    SolidDistance operator()(const DistanceShape& s) const {
        requireBox("expression", s.bounds);
        return {std::make_shared<ExpressionField>(s.d, time), s.bounds, s.bounds.center()};
    }
};

}  // namespace

SolidDistance distanceOf(const SolidShape& shape, double time) {
    return std::visit(MakeDistance{time}, shape);
}

}  // namespace voledit
