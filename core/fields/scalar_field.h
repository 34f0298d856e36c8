#pragma once
// Scalar fields F : E³ → R, however they are given (definitions.md §2).

#include <memory>
#include <span>

#include "core/base/box3.h"
#include "core/base/interval.h"
#include "core/base/types.h"

namespace voledit {

class FieldVisitor;

/// A scalar field over world space. Immutable, hence safe to use from many threads.
class ScalarField {
public:
    virtual ~ScalarField() = default;

    /// value[i] = F(p[i]); NaN where it is undefined (outside a volume's domain, p undefined, 0/0). Sizes are equal.
    virtual void sample(std::span<const Vec3> p, std::span<double> value) const = 0;

    /// gradient[i] = ∇F(p[i]), world units⁻¹; 0 where undefined. Formulas differentiate exactly, volumes and meshes
    /// as their classes say. Sizes are equal.
    virtual void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const = 0;

    /// Bounds of the values that are defined in `box`; low > high where certainly none is.
    virtual Interval range(const Box3& box) const = 0;

    /// Box outside of which F is undefined; infinite for most.
    virtual Box3 domain() const { return {Vec3(-kInfinity), Vec3(kInfinity)}; }

    virtual void accept(FieldVisitor& visitor) const = 0;
};

using FieldPtr = std::shared_ptr<const ScalarField>;

class ConstantField;    // fields/simple_fields.h
class ExpressionField;  // fields/simple_fields.h
class VolumeField;      // fields/simple_fields.h
class MapField;         // fields/simple_fields.h
class TextField;        // fields/text_field.h: signed distance of letters
class MeshField;        // stf/mesh_field.h: values at the vertices of mapped cells
class ComponentField;   // stf/component_field.h: a component of an ST or SD object
class AttributeField;   // objects/attribute_field.h: an attribute of an object

/// What tells kinds of fields apart, for those that translate terms (the GLSL composer).
class FieldVisitor {
public:
    virtual ~FieldVisitor() = default;
    virtual void visit(const ConstantField& field) = 0;
    virtual void visit(const ExpressionField& field) = 0;
    virtual void visit(const VolumeField& field) = 0;
    virtual void visit(const MapField& field) = 0;
    virtual void visit(const TextField& field) = 0;
    virtual void visit(const MeshField& field) = 0;
    virtual void visit(const ComponentField& field) = 0;
    virtual void visit(const AttributeField& field) = 0;
};

}  // namespace voledit
