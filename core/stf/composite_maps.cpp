#include "core/stf/composite_maps.h"

#include <algorithm>
#include <cassert>
#include <glm/matrix.hpp>

#include "core/fields/simple_fields.h"
#include "core/stf/affine.h"
#include "core/stf/displacement_image.h"
#include "core/stf/field_maps.h"
#include "core/stf/formula_map.h"

namespace voledit {

namespace {

using Points = std::vector<Vec3>;
using Matrices = std::vector<Mat3>;

Points mapped(const SpatialTransferFunction& map, std::span<const Vec3> p) {
    Points q(p.size());
    map.map(p, q);
    return q;
}

Matrices jacobianOf(const SpatialTransferFunction& map, std::span<const Vec3> p) {
    Matrices jacobian(p.size());
    map.jacobian(p, jacobian);
    return jacobian;
}

/// A field's values and, where they are asked for, gradients.
struct Weights {
    Weights(const ScalarField& field, std::span<const Vec3> p, bool withGradient) : value(p.size()) {
        field.sample(p, value);
        if (!withGradient) return;
        gradient.resize(p.size());
        field.gradient(p, gradient);
    }
    std::vector<double> value;
    Points gradient;
};

double squaredLength(const Vec3& v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}

/// The value of a field that is one number; nullopt for others.
std::optional<double> constantOf(const ScalarField& field) {
    const auto* constant = dynamic_cast<const ConstantField*>(&field);
    return constant ? std::optional(constant->value()) : std::nullopt;
}

bool isEmpty(const Interval& interval) {
    return !(interval.low <= interval.high);
}

/// Where the maps that a displacement is made of would each take a box. (Not their imageOf: that of each level would
/// search again for all levels below it.)
class LikelyImage final : public TransferVisitor {
public:
    LikelyImage(const SpatialTransferFunction& map, const Box3& rest) : rest_(rest) { map.accept(*this); }
    const Box3& box() const { return box_; }

    void visit(const AffineMap& map) override { add(map); }
    void visit(const FormulaMap& map) override { add(map); }
    void visit(const FieldsMap& map) override { add(map); }
    void visit(const SequenceMap& map) override { add(map); }
    void visit(const ScaledMap& map) override { map.of()->accept(*this); }
    void visit(const SumMap& map) override { visitAll(map.of()); }
    void visit(const ChosenMap& map) override { visitAll(map.of()); }
    void visit(const BlendedMap& map) override {
        map.first()->accept(*this);
        map.second()->accept(*this);
    }
    void visitCells(const SpatialTransferFunction& map) override { add(map); }

private:
    template <class Map>
    void add(const Map& map) {
        box_ = join(box_, map.imageOf(rest_));
    }
    void visitAll(const std::vector<TransferPtr>& maps) {
        for (const TransferPtr& map : maps) map->accept(*this);
    }

    const Box3& rest_;
    Box3 box_;
};

}  // namespace

// ---- Sequences ------------------------------------------------------------------------------------------------------

SequenceMap::SequenceMap(std::vector<TransferPtr> of) : of_(std::move(of)) {
    assert(!of_.empty());
}

void SequenceMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    of_.back()->map(p, q);
    for (std::size_t n = of_.size() - 1; n-- > 0;) of_[n]->map(q, q);
}

void SequenceMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    Points at(p.begin(), p.end());
    std::fill(jacobian.begin(), jacobian.end(), Mat3(1));
    for (std::size_t n = of_.size(); n-- > 0;) {
        const Matrices inner = jacobianOf(*of_[n], at);
        for (std::size_t i = 0; i < p.size(); ++i) jacobian[i] = inner[i] * jacobian[i];
        of_[n]->map(at, at);
    }
    for (std::size_t i = 0; i < p.size(); ++i)
        if (!isDefined(at[i])) jacobian[i] = Mat3(1);
}

Box3 SequenceMap::imageOf(const Box3& rest) const {
    Box3 image = rest;
    for (const TransferPtr& map : of_) image = map->imageOf(image);
    return image;
}

bool SequenceMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    const std::function<bool(const Box3&, std::size_t)> below = [&](const Box3& at, std::size_t count) {
        if (count == 0) return found(at);
        return of_[count - 1]->anySourceBox(at, [&](const Box3& source) { return below(source, count - 1); });
    };
    return below(box, of_.size());
}

std::optional<Mat4> SequenceMap::affine() const {
    Mat4 restFromWorld(1);
    for (std::size_t n = of_.size(); n-- > 0;) {
        const auto matrix = of_[n]->affine();
        if (!matrix) return std::nullopt;
        restFromWorld = *matrix * restFromWorld;
    }
    return restFromWorld;
}

// ---- Scaled ---------------------------------------------------------------------------------------------------------

ScaledMap::ScaledMap(FieldPtr by, TransferPtr of) : by_(std::move(by)), of_(std::move(of)) {
    assert(by_ && of_);
}

void ScaledMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    const Weights k(*by_, p, false);
    const Points full = mapped(*of_, p);
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (k.value[i] == 0)
            q[i] = p[i];
        else if (k.value[i] == 1)  // to the bit, which p + (Ψ − p) would not be
            q[i] = full[i];
        else
            q[i] = p[i] + k.value[i] * (full[i] - p[i]);
        if (!isDefined(q[i])) q[i] = kUndefined;
    }
}

void ScaledMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    const Weights k(*by_, p, true);
    const Points full = mapped(*of_, p);
    of_->jacobian(p, jacobian);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 delta = full[i] - p[i];
        jacobian[i] = isDefined(delta) && k.value[i] == k.value[i]
                          ? Mat3(1) + k.value[i] * (jacobian[i] - Mat3(1)) + glm::outerProduct(delta, k.gradient[i])
                          : Mat3(1);
    }
}

Box3 ScaledMap::imageOf(const Box3& rest) const {
    const auto k = constantOf(*by_);
    if (k == 0.0) return rest;
    if (k == 1.0) return of_->imageOf(rest);
    return imageByDisplacement(*this, rest, LikelyImage(*this, rest).box());
}

bool ScaledMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    const Interval k = by_->range(box);
    if (isEmpty(k)) return false;
    if (k.contains(0) && found(box)) return true;  // also where Δ is undefined
    if (k.low == 0 && k.high == 0) return false;
    return of_->anySourceBox(box, [&](const Box3& full) { return found(blended(k, box, full)); });
}

std::optional<Mat4> ScaledMap::affine() const {
    const auto k = constantOf(*by_);
    if (k == 0.0) return Mat4(1);
    const auto full = of_->affine();
    if (!k || !full) return std::nullopt;
    return *k == 1 ? *full : Mat4(1) + *k * (*full - Mat4(1));
}

// ---- Sums -----------------------------------------------------------------------------------------------------------

SumMap::SumMap(std::vector<TransferPtr> of) : of_(std::move(of)) {
    assert(!of_.empty());
}

void SumMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    Points sum(p.size(), Vec3(0)), full(p.size());
    for (const TransferPtr& operand : of_) {
        operand->map(p, full);
        for (std::size_t i = 0; i < p.size(); ++i) sum[i] += full[i] - p[i];
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
        q[i] = p[i] + sum[i];
        if (!isDefined(q[i])) q[i] = kUndefined;
    }
}

void SumMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    Matrices one(p.size());
    std::fill(jacobian.begin(), jacobian.end(), Mat3(1));
    for (const TransferPtr& operand : of_) {
        operand->jacobian(p, one);
        for (std::size_t i = 0; i < p.size(); ++i) jacobian[i] += one[i] - Mat3(1);
    }
    const Points q = mapped(*this, p);
    for (std::size_t i = 0; i < p.size(); ++i)
        if (!isDefined(q[i])) jacobian[i] = Mat3(1);
}

Box3 SumMap::imageOf(const Box3& rest) const {
    if (of_.size() == 1) return of_[0]->imageOf(rest);
    return imageByDisplacement(*this, rest, LikelyImage(*this, rest).box());
}

bool SumMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    if (of_.size() == 1) return of_[0]->anySourceBox(box, found);
    Box3 sum = combination(1 - double(of_.size()), box, 0, box);  // ΣΨᵢ(p) − (n−1)·p
    for (const TransferPtr& operand : of_) {
        const Box3 hull = sourceHull(*operand, box);
        if (hull.empty()) return false;
        sum = combination(1, sum, 1, hull);
    }
    return found(sum);
}

std::optional<Mat4> SumMap::affine() const {
    Mat4 sum(1);
    for (const TransferPtr& operand : of_) {
        const auto matrix = operand->affine();
        if (!matrix) return std::nullopt;
        sum += *matrix - Mat4(1);
    }
    return of_.size() == 1 ? of_[0]->affine() : sum;
}

// ---- The larger or the smaller --------------------------------------------------------------------------------------

ChosenMap::ChosenMap(Choice choice, std::vector<TransferPtr> of) : choice_(choice), of_(std::move(of)) {
    assert(!of_.empty());
}

namespace {

/// What every operand gives at p, and which of them wins: of_.size() where one is undefined.
struct Chosen {
    Chosen(const ChosenMap& map, std::span<const Vec3> p) : winner(p.size(), 0) {
        for (const TransferPtr& operand : map.of()) q.push_back(mapped(*operand, p));
        for (std::size_t i = 0; i < p.size(); ++i) {
            double best = squaredLength(q[0][i] - p[i]);
            for (std::size_t n = 1; n < q.size(); ++n) {
                const double length = squaredLength(q[n][i] - p[i]);
                if (map.choice() == ChosenMap::Choice::Larger ? length > best : length < best) {
                    best = length;
                    winner[i] = n;
                }
            }
            for (const Points& of : q)
                if (!isDefined(of[i])) winner[i] = q.size();
        }
    }
    std::vector<Points> q;
    std::vector<std::size_t> winner;
};

}  // namespace

void ChosenMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    const Chosen chosen(*this, p);
    for (std::size_t i = 0; i < p.size(); ++i)
        q[i] = chosen.winner[i] < of_.size() ? chosen.q[chosen.winner[i]][i] : kUndefined;
}

void ChosenMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    const Chosen chosen(*this, p);
    std::fill(jacobian.begin(), jacobian.end(), Mat3(1));
    for (std::size_t n = 0; n < of_.size(); ++n) {
        Points at;
        std::vector<std::size_t> won;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (chosen.winner[i] == n) {
                won.push_back(i);
                at.push_back(p[i]);
            }
        const Matrices winners = jacobianOf(*of_[n], at);
        for (std::size_t w = 0; w < won.size(); ++w) jacobian[won[w]] = winners[w];
    }
}

Box3 ChosenMap::imageOf(const Box3& rest) const {
    Box3 image;  // Ψ(p) is some Ψᵢ(p)
    for (const TransferPtr& operand : of_) image = join(image, operand->imageOf(rest));
    return image;
}

bool ChosenMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    const auto isDefinedSomewhere = [&](const TransferPtr& operand) {
        return operand->anySourceBox(box, [](const Box3&) { return true; });
    };
    if (!std::all_of(of_.begin(), of_.end(), isDefinedSomewhere)) return false;
    return std::any_of(of_.begin(), of_.end(), [&](const TransferPtr& of) { return of->anySourceBox(box, found); });
}

// ---- Blends ---------------------------------------------------------------------------------------------------------

BlendedMap::BlendedMap(FieldPtr weight, TransferPtr first, TransferPtr second)
    : weight_(std::move(weight)), first_(std::move(first)), second_(std::move(second)) {
    assert(weight_ && first_ && second_);
}

void BlendedMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    const Weights w(*weight_, p, false);
    const Points a = mapped(*first_, p), b = mapped(*second_, p);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double weight = w.value[i];
        const bool defined = isDefined(a[i]) && isDefined(b[i]);
        if (defined && (weight == 0 || weight == 1))
            q[i] = weight == 0 ? a[i] : b[i];  // to the bit
        else
            q[i] = p[i] + (1 - weight) * (a[i] - p[i]) + weight * (b[i] - p[i]);
        if (!isDefined(q[i])) q[i] = kUndefined;
    }
}

void BlendedMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    const Weights w(*weight_, p, true);
    const Points a = mapped(*first_, p), b = mapped(*second_, p);
    const Matrices ja = jacobianOf(*first_, p), jb = jacobianOf(*second_, p);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double weight = w.value[i];
        const Vec3 difference = b[i] - a[i];
        jacobian[i] = isDefined(difference) && weight == weight
                          ? (1 - weight) * ja[i] + weight * jb[i] + glm::outerProduct(difference, w.gradient[i])
                          : Mat3(1);
    }
}

Box3 BlendedMap::imageOf(const Box3& rest) const {
    const auto w = constantOf(*weight_);
    if (w == 0.0) return first_->imageOf(rest);
    if (w == 1.0) return second_->imageOf(rest);
    return imageByDisplacement(*this, rest, LikelyImage(*this, rest).box());
}

bool BlendedMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    const Interval w = weight_->range(box);
    const Box3 a = sourceHull(*first_, box), b = sourceHull(*second_, box);
    if (isEmpty(w) || a.empty() || b.empty()) return false;
    return found(blended(w, a, b));
}

std::optional<Mat4> BlendedMap::affine() const {
    const auto w = constantOf(*weight_);
    const auto a = first_->affine(), b = second_->affine();
    if (!w || !a || !b) return std::nullopt;
    return (1 - *w) * *a + *w * *b;
}

}  // namespace voledit
