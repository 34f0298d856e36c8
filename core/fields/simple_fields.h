#pragma once
// Fields that need nothing but numbers, formulas and volumes.

#include "core/expression/formula.h"
#include "core/fields/scalar_field.h"
#include "core/fields/transfer_function.h"
#include "core/fields/volume.h"

namespace voledit {

/// One value everywhere.
class ConstantField final : public ScalarField {
public:
    explicit ConstantField(double value) : value_(value) {}
    double value() const { return value_; }

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    Interval range(const Box3& box) const override;
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    double value_;
};

/// A formula over x, y, z (world; variable slots 0, 1, 2), its parameters (as `t`, seconds) fixed.
class ExpressionField final : public ScalarField {
public:
    /// `formula` has one output, variables x, y, z; `parameters` fill its slots.
    ExpressionField(FormulaGraph formula, std::vector<double> parameters);
    /// Over x, y, z and t, which is fixed to `time`. Throws FormulaError.
    ExpressionField(const FormulaText& text, double time);

    const FormulaGraph& formula() const { return formula_; }
    /// The formula and d/dx, d/dy, d/dz: outputs 0 to 3.
    const FormulaGraph& withGradient() const { return withGradient_; }
    std::span<const double> parameters() const { return parameters_; }

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    Interval range(const Box3& box) const override;
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    FormulaGraph formula_, withGradient_;
    std::vector<double> parameters_;
};

/// The values of one channel of a volume where it stands; NaN outside.
class VolumeField final : public ScalarField {
public:
    VolumeField(std::shared_ptr<const Volume> volume, int channel, Interpolation interpolation = Interpolation::Linear);
    const std::shared_ptr<const Volume>& volume() const { return volume_; }
    int channel() const { return channel_; }
    Interpolation interpolation() const { return interpolation_; }

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    Interval range(const Box3& box) const override;
    Box3 domain() const override;
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    std::shared_ptr<const Volume> volume_;
    int channel_;
    Interpolation interpolation_;
};

/// Φ(F): a piecewise-linear table of another field.
class MapField final : public ScalarField {
public:
    MapField(PiecewiseLinear table, FieldPtr of) : table_(std::move(table)), of_(std::move(of)) {}
    const PiecewiseLinear& table() const { return table_; }
    const FieldPtr& of() const { return of_; }

    void sample(std::span<const Vec3> p, std::span<double> value) const override;
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const override;
    Interval range(const Box3& box) const override;
    Box3 domain() const override { return of_->domain(); }
    void accept(FieldVisitor& visitor) const override { visitor.visit(*this); }

private:
    PiecewiseLinear table_;
    FieldPtr of_;
};

}  // namespace voledit
