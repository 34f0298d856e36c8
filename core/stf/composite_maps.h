#pragma once
// STFs made of others: sequences, and the displacement (SD) algebra (definitions.md §§3, 3.1). An SD object Δ is kept
// as the STF p + Δ(p): `displace` is a transfer by it.
// Jacobians follow by the chain and product rules; where all operands are affine and weights constant, so is the map.
// Where an operand with cells has several pre-images, its first one counts. All need at least one operand, none of them
// null.

#include <vector>

#include "core/fields/scalar_field.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// Ψ(p) = Ψ₁(Ψ₂(…Ψₙ(p))): transfers by the first, then by the second, and so on. Also `transferred`: an ST object
/// `of` moved by `by` is the sequence [of, by].
class SequenceMap final : public SpatialTransferFunction {
public:
    explicit SequenceMap(std::vector<TransferPtr> of);
    const std::vector<TransferPtr>& of() const { return of_; }

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    std::optional<Mat4> affine() const override;
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

private:
    std::vector<TransferPtr> of_;
};

/// Ψ(p) = p + k(p)·Δ(p). Where k is exactly 0 it is the identity, also where Δ is undefined; undefined where k is.
/// A field k and its gradient enter the Jacobian: I + k·(J − I) + Δ ⊗ ∇k.
class ScaledMap final : public SpatialTransferFunction {
public:
    ScaledMap(FieldPtr by, TransferPtr of);
    const FieldPtr& by() const { return by_; }
    const TransferPtr& of() const { return of_; }

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    std::optional<Mat4> affine() const override;
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

private:
    FieldPtr by_;
    TransferPtr of_;
};

/// Ψ(p) = p + ΣΔᵢ(p). Undefined where any operand is.
class SumMap final : public SpatialTransferFunction {
public:
    explicit SumMap(std::vector<TransferPtr> of);
    const std::vector<TransferPtr>& of() const { return of_; }

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    std::optional<Mat4> affine() const override;
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

private:
    std::vector<TransferPtr> of_;
};

/// SD union (the larger |Δ| wins) or intersection (the smaller), the first on a tie. Undefined where any operand is.
class ChosenMap final : public SpatialTransferFunction {
public:
    enum class Choice : std::uint8_t { Larger, Smaller };
    ChosenMap(Choice choice, std::vector<TransferPtr> of);
    Choice choice() const { return choice_; }
    const std::vector<TransferPtr>& of() const { return of_; }

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

private:
    Choice choice_;
    std::vector<TransferPtr> of_;
};

/// Ψ(p) = p + (1−w)Δ₁(p) + wΔ₂(p). Undefined where an operand or w is.
class BlendedMap final : public SpatialTransferFunction {
public:
    BlendedMap(FieldPtr weight, TransferPtr first, TransferPtr second);
    const FieldPtr& weight() const { return weight_; }
    const TransferPtr& first() const { return first_; }
    const TransferPtr& second() const { return second_; }

    void map(std::span<const Vec3> p, std::span<Vec3> q) const override;
    void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const override;
    Box3 imageOf(const Box3& rest) const override;
    bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const override;
    std::optional<Mat4> affine() const override;
    void accept(TransferVisitor& visitor) const override { visitor.visit(*this); }

private:
    FieldPtr weight_;
    TransferPtr first_, second_;
};

}  // namespace voledit
