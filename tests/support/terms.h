#pragma once
// Volumes, looks and lattices made by hand, for the evaluators' tests.

#include <random>

#include "core/fields/simple_fields.h"
#include "core/objects/solid_shapes.h"
#include "core/objects/term.h"
#include "core/stf/affine.h"
#include "core/stf/lattice.h"

namespace voledit::test {

/// A volume of `value(p)` on n samples an axis over [−1, 1]³.
template <class Function>
std::shared_ptr<const Volume> sampledVolume(int n, const Function& value) {
    VolumeGrid grid{Index3(n), 1, placementMatrix(Vec3(-1), Vec3(0), Vec3(2.0 / (n - 1)))};
    std::vector<double> values;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) values.push_back(value(transformPoint(grid.worldFromIndex, {i, j, k})));
    return Volume::fromValues(grid, std::move(values));
}

/// One opacity and colour whatever the value.
inline TransferFunction constantLook(double opacity, const Vec3& color) {
    TransferFunction f;
    f.opacity.points = {{0, opacity}};
    f.color.points = {{0, color}};
    return f;
}

/// A Bézier lattice of 4³ points over [−1, 1]³, some of them moved by up to `amount` of the box.
inline std::shared_ptr<const LatticeMap> bentLattice(double amount, int cells, Outside outside = Outside::Hide) {
    const Frame frame = frameOf({Vec3(-1), Vec3(1)});
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, restControlPoints(LatticeBasis::Bezier, Index3(4), frame)};
    lattice.control[lattice.indexOf({3, 3, 3})] += amount * Vec3(2, 0.5, 1);
    lattice.control[lattice.indexOf({0, 2, 1})] += amount * Vec3(-1, 1, 0.5);
    lattice.control[lattice.indexOf({2, 0, 3})] += amount * Vec3(0.5, -2, -1);
    lattice.control[lattice.indexOf({1, 2, 2})] += amount * Vec3(1, 1, 1);
    return std::make_shared<LatticeMap>(lattice, Index3(cells), outside);
}

/// A field of a formula over x, y, z and t = 0.
inline FieldPtr expression(const std::string& text) {
    return std::make_shared<ExpressionField>(FormulaText{text, "", 1, 1}, 0.0);
}

/// The opacity of a solid, over x, y, z, r, d.
inline FormulaGraph solidOpacity(const std::string& text) {
    FormulaSymbols symbols;
    symbols.variables = {{"x"}, {"y"}, {"z"}, {"r"}, {"d"}};
    return FormulaGraph({}, {{{text, "", 1, 1}, FormulaType::Number}}, symbols);
}

inline TermPtr solid(const SolidShape& shape, const Vec3& color, const std::string& opacity, double falloff = 0) {
    const SolidDistance d = distanceOf(shape, 0);
    return makeSolidTerm({d.distance, d.center, d.box, color, solidOpacity(opacity), {}, falloff});
}

/// An object of fields over [−1, 1]³, of one colour.
inline TermPtr fields(const std::string& opacity, const Vec3& color, std::map<std::string, FieldPtr> attributes = {}) {
    const auto number = [](double v) { return std::make_shared<ConstantField>(v); };
    return makeFieldsTerm({expression(opacity),
                           {number(color.r), number(color.g), number(color.b)},
                           {Vec3(-1), Vec3(1)},
                           std::move(attributes)});
}

inline std::vector<ObjectSample> sampled(const TermPtr& term, const std::vector<Vec3>& p, bool withGradient = false,
                                         const std::string& attribute = "scalar") {
    std::vector<ObjectSample> result(p.size());
    sample(*term, p, result, withGradient, attribute);
    return result;
}

inline std::vector<Vec3> randomPoints(std::size_t count, double size, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-size, size);
    std::vector<Vec3> p(count);
    for (Vec3& at : p)
        for (int a = 0; a < 3; ++a) at[a] = unit(random);
    return p;
}

}  // namespace voledit::test
