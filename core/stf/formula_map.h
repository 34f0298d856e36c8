#pragma once
// STFs written as formulas: the library, users' files, and `expression` (definitions.md §3.2).

#include "core/expression/formula.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// Ψ as a graph over one point. Outputs 0, 1, 2 are q; output 3, where there is one, is not 0 where Ψ is undefined (NaN
/// anywhere is undefined too).
class FormulaMap final : public SpatialTransferFunction {
public:
    struct Parts {
        FormulaGraph formula;            // variable slots: the point's three coordinates
        std::vector<double> parameters;  // fill the graph's slots
        /// Affine maps between the world and the coordinates that the formula sees: its point is
        /// formulaFromWorld · p, and q = worldFromFormula · (what it gives).
        Mat4 formulaFromWorld{1};
        Mat4 worldFromFormula{1};
        Outside outside = Outside::Hide;  // Keep: the identity where the formula says undefined
        /// The image of a box, world units; empty function: the box itself.
        std::function<Box3(const Box3& rest)> image;
        /// formula.withDerivatives of slots 0, 1, 2, where it is known already.
        std::optional<FormulaGraph> withDerivatives = std::nullopt;
    };
    explicit FormulaMap(Parts parts);

    const FormulaGraph& formula() const { return parts_.formula; }
    /// The formula's outputs followed by the derivatives by its three variables (FormulaGraph::withDerivatives).
    const FormulaGraph& withDerivatives() const { return withDerivatives_; }
    std::span<const double> parameters() const { return parts_.parameters; }
    const Mat4& formulaFromWorld() const { return parts_.formulaFromWorld; }
    const Mat4& worldFromFormula() const { return parts_.worldFromFormula; }
    bool hasCondition() const { return parts_.formula.outputCount() > 3; }

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    /// By interval arithmetic, the box split where that is loose, into at most 8.
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    Outside outside() const override { return parts_.outside; }
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

private:
    Parts parts_;
    FormulaGraph withDerivatives_;
    bool aroundIdentity_;  // both matrices are the identity: coordinates go through untouched, to the bit
};

}  // namespace voledit
