#pragma once
// An attribute of an object as a scalar field of others.

#include "core/fields/scalar_field.h"
#include "core/objects/term.h"

namespace voledit {

/// Attribute `name` of an object: `opacity`, `r`, `g`, `b`, `scalar`, or one that a `fields` object names; NaN where
/// the object has none there. The gradient is by central differences of step().
class AttributeField final : public ScalarField {
public:
    AttributeField(std::string name, TermPtr of) : name_(std::move(name)), of_(std::move(of)) {}
    const std::string& name() const { return name_; }
    const TermPtr& of() const { return of_; }
    /// World length of half a difference: 1/512 of the longest side of the object's bounds.
    double step() const;

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    Interval range(const Box3& box) const override;
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    std::string name_;
    TermPtr of_;
};

}  // namespace voledit
