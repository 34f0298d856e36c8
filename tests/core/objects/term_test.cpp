#include "core/objects/term.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/stf/affine.h"
#include "core/stf/lattice.h"

namespace voledit {
namespace {

/// A smooth field of 48³ samples in [−1, 1]³.
std::shared_ptr<const Volume> smoothVolume() {
    constexpr int n = 48;
    VolumeGrid grid{Index3(n), 1, placementMatrix(Vec3(-1), Vec3(0), Vec3(2.0 / (n - 1)))};
    std::vector<float> values;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const Vec3 p = transformPoint(grid.worldFromIndex, {i, j, k});
                values.push_back(float(100 * (2 + std::sin(1.3 * p.x) + std::cos(p.y) * p.z)));
            }
    return Volume::fromValues(grid, std::move(values));
}

TransferFunction ramp(double from, double to) {
    TransferFunction f = greyRamp(from, to);
    f.color.points = {{from, Vec3(1, 0, 0)}, {to, Vec3(0, 0, 1)}};
    return f;
}

TermPtr smoothTerm() {
    return makeVolumeTerm(smoothVolume(), 0, ramp(0, 400));
}

std::vector<ObjectSample> sampled(const TermPtr& term, const std::vector<Vec3>& p, bool withGradient = false) {
    std::vector<ObjectSample> result(p.size());
    sample(*term, p, result, withGradient);
    return result;
}

std::vector<Vec3> randomPoints(std::size_t count, double size, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-size, size);
    std::vector<Vec3> p(count);
    for (Vec3& at : p) at = {unit(random), unit(random), unit(random)};
    return p;
}

std::shared_ptr<const LatticeMap> bentLattice(int cells, double amount = 0.25) {
    const Frame frame = frameOf({Vec3(-1), Vec3(1)});
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, {}};
    lattice.control = restControlPoints(lattice.basis, lattice.points, frame);
    lattice.control[lattice.indexOf({3, 3, 3})] += amount * Vec3(2, 0.5, 1);
    lattice.control[lattice.indexOf({1, 2, 1})] += amount * Vec3(-1, 1, 0.5);
    lattice.control[lattice.indexOf({2, 1, 2})] += amount * Vec3(0.5, 1, -1);
    return std::make_shared<LatticeMap>(lattice, Index3(cells), Outside::Hide);
}

TEST(Term, AVolumeIsClassifiedWhereItIsAndEmptyElsewhere) {
    const auto volume = smoothVolume();
    const auto function = ramp(0, 400);
    const auto term = makeVolumeTerm(volume, 0, function);
    const auto p = randomPoints(3000, 1.3);
    const auto s = sampled(term, p, true);
    std::vector<double> value(p.size());
    std::vector<Vec3> gradient(p.size());
    volume->sample(p, value);
    volume->gradient(p, gradient);
    int outside = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (std::isnan(value[i])) {
            ++outside;
            EXPECT_EQ(s[i].opacity, 0);
            EXPECT_TRUE(std::isnan(s[i].value));
        } else {
            EXPECT_EQ(s[i].value, value[i]);
            EXPECT_EQ(s[i].opacity, function.opacity(value[i]));
            EXPECT_EQ(s[i].color, function.color(value[i]));
            EXPECT_EQ(s[i].normalGradient, gradient[i]);
        }
    }
    EXPECT_GT(outside, 500);
    EXPECT_EQ(term->bounds, (Box3{Vec3(-1), Vec3(1)}));
}

TEST(Term, ChannelsAreChosen) {
    const VolumeGrid grid{{2, 1, 1}, 2, Mat4(1.0)};
    const auto volume = Volume::fromValues(grid, std::vector<std::uint8_t>{0, 100, 50, 200});
    EXPECT_EQ(sampled(makeVolumeTerm(volume, 1, ramp(0, 255)), {Vec3(0.5, 0, 0)})[0].value, 150);
}

TEST(Term, GradientOpacityScalesByTheUndeformedSteepness) {
    const VolumeGrid grid{{3, 3, 3}, 1, placementMatrix(Vec3(0), Vec3(0), Vec3(2))};
    std::vector<double> values;
    for (int n = 0; n < 27; ++n) values.push_back(n % 3 * 10);  // 5 data units a world unit, along x
    TransferFunction function = ramp(0, 20);
    function.opacity.points = {{0, 0.8}};
    function.gradientOpacity.points = {{0, 0}, {10, 1}};
    const auto term = makeVolumeTerm(Volume::fromValues(grid, values), 0, function);
    EXPECT_DOUBLE_EQ(sampled(term, {Vec3(2)})[0].opacity, 0.4);
    const auto stretched = makeTransferTerm(std::make_shared<AffineMap>(placementMatrix(Vec3(0), Vec3(0), Vec3(3))),
                                            term, Combine::Union, "");
    EXPECT_DOUBLE_EQ(sampled(stretched, {Vec3(6)})[0].opacity, 0.4) << "stretching does not thin it";
}

TEST(Term, ATransferShowsAtPWhatItsOperandHoldsAtQ) {
    const auto object = smoothTerm();
    const auto map = bentLattice(16);
    const auto term = makeTransferTerm(map, object, Combine::Union, "pull");
    const auto p = randomPoints(3000, 1.5);
    std::vector<Vec3> q(p.size());
    map->map(p, q);
    const auto moved = sampled(term, p), rest = sampled(object, q);
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_EQ(moved[i].opacity, rest[i].opacity);
        EXPECT_TRUE(moved[i].opacity == 0 || moved[i].value == rest[i].value);
    }
    EXPECT_EQ(term->bounds, map->imageOf(object->bounds));
}

TEST(Term, AListIsAppliedInOrder) {
    const auto s1 = std::make_shared<AffineMap>(placementMatrix({0.3, 0, 0}, {0, 0, 0.4}, Vec3(1)));
    const auto s2 = std::make_shared<AffineMap>(placementMatrix({0, 0.2, 0}, {0.5, 0, 0}, Vec3(1.5, 1, 1)));
    const auto first = makeTransferTerm(s1, smoothTerm(), Combine::Union, "s1", TransferRole::SameList);
    const auto both = makeTransferTerm(s2, first, Combine::Union, "s2");
    const auto p = randomPoints(500, 1);
    std::vector<Vec3> q(p.size());
    s2->map(p, q);
    s1->map(q, q);  // o(Ψ₁(Ψ₂(p)))
    const auto found = sampled(both, p), expected = sampled(smoothTerm(), q);
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_EQ(found[i].opacity, expected[i].opacity);
}

/// Gradient of the sampled value by differences of the whole term.
Vec3 differences(const TermPtr& term, const Vec3& p, double h) {
    Vec3 g;
    for (int a = 0; a < 3; ++a) {
        Vec3 step(0);
        step[a] = h;
        const auto s = sampled(term, {p + step, p - step});
        g[a] = (s[0].value - s[1].value) / (2 * h);
    }
    return g;
}

TEST(Term, GradientsUnderAnAffineMapAreThoseOfTheDeformedField) {
    const auto map = std::make_shared<AffineMap>(placementMatrix({3, 2, 1}, {0.4, -0.8, 1.2}, {2, 0.7, -1.3}));
    const auto term = makeTransferTerm(map, smoothTerm(), Combine::Union, "");
    for (const Vec3& q : randomPoints(200, 0.8)) {
        const Vec3 p = transformPoint(map->worldFromRest(), q);
        // Differences over about a voxel: both are then means over the trilinear pieces, and agree up to curvature.
        const Vec3 expected = differences(term, p, 0.04);
        EXPECT_LT(glm::length(sampled(term, {p}, true)[0].normalGradient - expected),
                  0.02 * glm::length(expected) + 0.3);
    }
}

TEST(Term, GradientsUnderALatticeAreThoseOfTheDeformedField) {
    // The value of many small cells is differenced; the gradient comes from Jacobians between few vertices.
    const auto fine = makeTransferTerm(bentLattice(48), smoothTerm(), Combine::Union, "");
    const auto map = bentLattice(16);
    const auto term = makeTransferTerm(map, smoothTerm(), Combine::Union, "");
    for (const Vec3& u : randomPoints(300, 0.4, 2)) {
        const Vec3 p = evaluate(map->lattice(), 0.5 + u);
        const Vec3 expected = differences(fine, p, 0.04);
        const Vec3 found = sampled(term, {p}, true)[0].normalGradient;
        EXPECT_LT(glm::length(found - expected), 0.05 * glm::length(expected));
    }
}

/// x = 0, 2, 1, 3 for q = 0, 1, 2, 3: three sheets between x = 1 and 2.
class FoldedMap final : public CellMap {
public:
    explicit FoldedMap(Outside outside) : CellMap(data(), outside) {}

private:
    static MappedCells::Data data() {
        auto data = gridCells({Vec3(0), {Vec3(3, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}}, {3, 1, 1});
        for (Vec3& p : data.deformed) p.x = p.x == 1 ? 2 : p.x == 2 ? 1 : p.x;
        // Facetted, so that the expected gradients are those of each piece.
        for (const Vec3& q : data.source) data.jacobian.push_back(Mat3(q.x > 0.5 && q.x < 2.5 ? -1 : 0.5));
        return data;
    }
};

/// Opacity v / 10 and red v / 10 of a volume that is 1, 2, 4, 9 at x = 0 … 3, wider than the folded row.
TermPtr steps() {
    const VolumeGrid grid{{6, 2, 2}, 1, placementMatrix({-1, 0, 0}, Vec3(0), Vec3(1))};
    std::vector<double> values;
    for (int n = 0; n < 4; ++n)
        for (const double v : {5, 1, 2, 4, 9, 5}) values.push_back(v);
    TransferFunction function;
    function.opacity.points = {{0, 0}, {10, 1}};
    function.color.points = {{0, Vec3(0)}, {10, Vec3(1, 0, 0)}};
    return makeVolumeTerm(Volume::fromValues(grid, values), 0, function);
}

TEST(Term, AFoldCombinesAllItsPreImages) {
    const std::vector<Vec3> p{Vec3(1.5, 0.3, 0.6), Vec3(0.5, 0.3, 0.6), Vec3(2.9, 0.1, 0.1), Vec3(3.5, 0.5, 0.5)};
    // At 1.5: q = 0.75, 1.5, 2.25, values 1.75, 3, 5.25.
    const auto fold = [&](Combine by, Outside outside) {
        return sampled(makeTransferTerm(std::make_shared<FoldedMap>(outside), steps(), by, ""), p, true);
    };
    const auto united = fold(Combine::Union, Outside::Hide);
    EXPECT_NEAR(united[0].opacity, 0.525, 1e-12);
    EXPECT_NEAR(united[0].value, 5.25, 1e-12);
    EXPECT_NEAR(united[0].color.r, 0.525, 1e-12);
    EXPECT_NEAR(united[1].value, 1.25, 1e-12);
    EXPECT_EQ(united[3].opacity, 0);
    const auto merged = fold(Combine::Merge, Outside::Hide);
    EXPECT_NEAR(merged[0].opacity, 1, 1e-12);
    EXPECT_NEAR(fold(Combine::Intersection, Outside::Hide)[0].opacity, 0.175, 1e-12);
    EXPECT_NEAR(fold(Combine::First, Outside::Hide)[0].opacity, 0.175, 1e-12);
    EXPECT_NEAR(fold(Combine::First, Outside::Keep)[3].value, 7, 1e-12) << "kept: the identity there";
    // At q = 2.25 the volume rises by 2.75, and dq/dp comes to −0.625 between the vertices' −1 and 0.5.
    EXPECT_NEAR(united[0].normalGradient.x, -0.625 * 2.75, 1e-12);
}

TEST(Term, ManyPointsAreTheSameAsOneByOne) {
    const auto term = makeTransferTerm(bentLattice(6, -2), smoothTerm(), Combine::Union, "");
    ASSERT_TRUE(std::get<TransferTerm>(term->node).by->cells()->mayOverlap());
    const auto p = randomPoints(5000, 1.5);
    const auto all = sampled(term, p, true);
    for (std::size_t i = 0; i < p.size(); i += 7) {
        const auto one = sampled(term, {p[i]}, true)[0];
        EXPECT_EQ(all[i].opacity, one.opacity);
        EXPECT_EQ(all[i].normalGradient, one.normalGradient);
    }
}

}  // namespace
}  // namespace voledit
