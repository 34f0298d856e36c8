#include "core/fields/simple_fields.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/fields/value_bricks.h"

namespace voledit {

namespace {

constexpr std::size_t kBlock = 256;  // points whose coordinates are laid apart on the stack
constexpr std::array<int, 3> kCoordinates{0, 1, 2};

/// Calls evaluate(coordinates, begin, count) for blocks of points, with pointers to their x, y and z.
template <class Evaluate>
void inBlocks(std::span<const Vec3> p, const Evaluate& evaluate) {
    std::array<std::array<double, kBlock>, 3> x;
    const std::array<const double*, 3> coordinates{x[0].data(), x[1].data(), x[2].data()};
    for (std::size_t begin = 0; begin < p.size(); begin += kBlock) {
        const std::size_t count = std::min(kBlock, p.size() - begin);
        for (std::size_t i = 0; i < count; ++i)
            for (int a = 0; a < 3; ++a) x[std::size_t(a)][i] = p[begin + i][a];
        evaluate(coordinates, begin, count);
    }
}

FormulaSymbols worldAndTime() {
    FormulaSymbols symbols;
    symbols.variables = {{"x"}, {"y"}, {"z"}};
    symbols.parameters = {{"t"}};
    return symbols;
}

}  // namespace

void ConstantField::sample(std::span<const Vec3> p, std::span<double> value) const {
    assert(p.size() == value.size());
    for (std::size_t i = 0; i < p.size(); ++i) value[i] = isDefined(p[i]) ? value_ : kNaN;
}

void ConstantField::gradient(std::span<const Vec3>, std::span<Vec3> gradient) const {
    std::fill(gradient.begin(), gradient.end(), Vec3(0));
}

Interval ConstantField::range(const Box3&) const {
    return {value_, value_};
}

ExpressionField::ExpressionField(FormulaGraph formula, std::vector<double> parameters)
    : formula_(std::move(formula)),
      withGradient_(formula_.withDerivatives(kCoordinates)),
      parameters_(std::move(parameters)) {
    assert(formula_.outputCount() == 1 && formula_.variableCount() == 3 &&
           std::size_t(formula_.parameterCount()) == parameters_.size());
}

ExpressionField::ExpressionField(const FormulaText& text, double time)
    : ExpressionField(FormulaGraph({}, {{text, FormulaType::Number}}, worldAndTime()), {time}) {}

void ExpressionField::sample(std::span<const Vec3> p, std::span<double> value) const {
    assert(p.size() == value.size());
    inBlocks(p, [&](std::span<const double* const> coordinates, std::size_t begin, std::size_t count) {
        double* const output = value.data() + begin;
        formula_.evaluate(coordinates, parameters_, std::span(&output, 1), count);
        // A formula need not use every coordinate.
        for (std::size_t i = begin; i < begin + count; ++i)
            if (!isDefined(p[i])) value[i] = kNaN;
    });
}

void ExpressionField::gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const {
    assert(p.size() == gradient.size());
    inBlocks(p, [&](std::span<const double* const> coordinates, std::size_t begin, std::size_t count) {
        std::array<std::array<double, kBlock>, 4> result;
        const std::array<double*, 4> outputs{result[0].data(), result[1].data(), result[2].data(), result[3].data()};
        withGradient_.evaluate(coordinates, parameters_, outputs, count);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 g(result[1][i], result[2][i], result[3][i]);
            // A kink of infinite slope has no direction, though it has a value.
            const bool usable = result[0][i] == result[0][i] && isDefined(p[begin + i]) && isDefined(g);
            gradient[begin + i] = usable ? g : Vec3(0);
        }
    });
}

Interval ExpressionField::range(const Box3& box) const {
    const std::array<Interval, 3> coordinates{Interval{box.min.x, box.max.x}, Interval{box.min.y, box.max.y},
                                              Interval{box.min.z, box.max.z}};
    return formula_.bounds(coordinates, parameters_).front();
}

VolumeField::VolumeField(std::shared_ptr<const Volume> volume, int channel, Interpolation interpolation)
    : volume_(std::move(volume)), channel_(channel), interpolation_(interpolation) {
    assert(channel >= 0 && channel < volume_->grid().channels);
}

void VolumeField::sample(std::span<const Vec3> p, std::span<double> value) const {
    volume_->sample(p, value, channel_, interpolation_);
}

void VolumeField::gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const {
    volume_->gradient(p, gradient, channel_, interpolation_);
}

Interval VolumeField::range(const Box3& box) const {
    return rangeWithin(*volume_, channel_, interpolation_, movedBox(box, volume_->indexFromWorld()));
}

Box3 VolumeField::domain() const {
    return boundsOf(volume_->grid().worldFrame());
}

void MapField::sample(std::span<const Vec3> p, std::span<double> value) const {
    of_->sample(p, value);
    for (double& v : value) v = v == v ? table_(v) : kNaN;
}

void MapField::gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const {
    std::vector<double> value(p.size());
    of_->sample(p, value);
    of_->gradient(p, gradient);
    for (std::size_t i = 0; i < p.size(); ++i) gradient[i] *= value[i] == value[i] ? table_.slope(value[i]) : 0;
}

Interval MapField::range(const Box3& box) const {
    const Interval of = of_->range(box);
    return of.low <= of.high ? rangeOf(table_, of) : of;
}

}  // namespace voledit
