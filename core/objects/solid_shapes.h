#pragma once
// The shapes of `solid` objects, as signed distances (scene-format.md §1, Objects).

#include <string>
#include <variant>

#include "core/expression/formula.h"
#include "core/fields/scalar_field.h"

namespace voledit {

struct SphereShape {
    Vec3 center{0};
    double radius = 1;
};
struct BoxShape {
    Vec3 min{-1}, max{1};
};
struct CylinderShape {
    Vec3 from{0, 0, -1}, to{0, 0, 1};
    double radius = 1;
};
struct CapsuleShape {
    Vec3 from{0, 0, -1}, to{0, 0, 1};
    double radius = 1;
};
struct TorusShape {
    Vec3 center{0}, axis{0, 0, 1};
    double major = 1, minor = 0.25;
};
struct TextShape {
    std::string string;
    double height = 1, depth = 0.25;
};
/// d as a formula over x, y, z, t (world).
struct DistanceShape {
    FormulaText d;
    Box3 bounds{Vec3(-1), Vec3(1)};
};
using SolidShape =
    std::variant<SphereShape, BoxShape, CylinderShape, CapsuleShape, TorusShape, TextShape, DistanceShape>;

/// A shape as a field of exact signed distances (formulas over their numbers as parameters, so that GLSL does not
/// change with them), the box that holds it, and its centre: that of the sphere or torus, else of the box.
struct SolidDistance {
    FieldPtr distance;
    Box3 box;
    Vec3 center{0};
};
/// Throws Error for sizes that are not positive, an empty box, ends that coincide, a bad formula or text.
SolidDistance distanceOf(const SolidShape& shape, double time);

}  // namespace voledit
