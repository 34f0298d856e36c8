#include "core/eval/cut_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/eval/ray_caster.h"
#include "core/scene/lighting.h"
#include "core/stf/transfer_definition.h"
#include "tests/support/scenes.h"

namespace voledit {
namespace {

using namespace test;

constexpr double kThickness = 0.05;

/// Opaque noise over [−1, 1]³: its gradients point anywhere.
TermPtr noise() {
    TransferFunction look = constantLook(0.9, Vec3(0.8, 0.6, 0.4));
    return makeVolumeTerm(
        sampledVolume(41, [](const Vec3& p) { return std::sin(913 * p.x + 677 * p.y * p.y + 541 * p.z); }), 0, look);
}

TransferPtr library(const std::string& name, std::map<std::string, TransferArgument> arguments) {
    const TransferDefinitionPtr definition = libraryTransfer(name);
    TransferDefinition::Use use;
    for (const TransferParameter& parameter : definition->parameters())
        use.arguments[parameter.name] = parameter.suggested;
    for (auto& [parameter, value] : arguments) use.arguments[parameter] = std::move(value);
    use.frame = frameOf({Vec3(-1), Vec3(1)});
    return definition->make(use);
}

TermPtr through(const TransferPtr& map, const TermPtr& of) {
    return makeTransferTerm(map, of, Combine::Union, "");
}

TermPtr turned(const TermPtr& of) {
    return through(std::make_shared<AffineMap>(placementMatrix(Vec3(0.1, 0.2, 0), Vec3(30, 20, 10), Vec3(1))), of);
}

double degreesBetween(const Vec3& a, const Vec3& b) {
    return glm::degrees(std::acos(std::clamp(std::abs(glm::dot(a, b)), 0.0, 1.0)));
}

// Rays towards the cut at x = `face` of what lies at smaller x, from 0 to 70° off its normal.
void expectNormals(const TermPtr& term, double face, const Mat4& worldFromRest) {
    const CutFinder cuts(*term, kThickness);
    ASSERT_TRUE(cuts.mayCut());
    const Vec3 normal = glm::normalize(transformVector(worldFromRest, Vec3(1, 0, 0)));
    for (const double y : {-0.6, 0.05, 0.7})
        for (const double tilt : {0.0, 0.5, 1.2, 2.7}) {
            const Vec3 direction = glm::normalize(transformVector(worldFromRest, Vec3(-1, tilt, 0.3 * tilt)));
            const Vec3 target = transformPoint(worldFromRest, Vec3(face, y, 0.1));
            const Vec3 origin = target - 5.0 * direction;
            const auto cut = cuts.before(origin, direction, 5 + 0.4 * kThickness);
            ASSERT_TRUE(cut) << y << " " << tilt;
            EXPECT_NEAR(cut->depth, 5, 1e-6);
            const Vec3 shown = cuts.blended(*cut, target, 5, Vec3(0.1, 0.2, 0.3));
            EXPECT_LT(degreesBetween(shown, normal), 0.01) << y << " " << tilt;
        }
}

TEST(CutFaces, OfASplitAreItsPlanes) {
    // The gap is 0.3 of the box: what was at x < 0 now ends at −0.3.
    const TransferPtr split = library("split", {{"axis", std::vector<int>{0}}, {"gap", std::vector<double>{0.3}}});
    expectNormals(through(split, noise()), -0.3, Mat4(1));
    const Mat4 place = placementMatrix(Vec3(0.1, 0.2, 0), Vec3(30, 20, 10), Vec3(1));
    expectNormals(turned(through(split, noise())), -0.3, place);
}

TEST(CutFaces, OfAVolumesBoxAndOfASolidAreTheirs) {
    expectNormals(noise(), 1, Mat4(1));
    const TermPtr knife = solid(BoxShape{Vec3(0.2, -3, -3), Vec3(3, 3, 3)}, Vec3(1), "1");
    expectNormals(makeCvgTerm(CvgOperator::Difference, {noise(), knife}), 0.2, Mat4(1));
    expectNormals(makeCvgTerm(CvgOperator::Trim, {noise(), knife}), 0.2, Mat4(1));
    const TermPtr window = solid(BoxShape{Vec3(-3, -3, -3), Vec3(0.2, 3, 3)}, Vec3(1), "1");
    expectNormals(makeCvgTerm(CvgOperator::Intersection, {noise(), window}), 0.2, Mat4(1));
}

/// A lattice over `frame`, its far face along x bent out of its plane.
TransferPtr lattice(const Frame& frame, double bend, Outside outside = Outside::Hide) {
    Lattice lattice{LatticeBasis::Bezier, {4, 4, 4}, frame, restControlPoints(LatticeBasis::Bezier, Index3(4), frame)};
    for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k)
            lattice.control[lattice.indexOf({3, j, k})] += bend * Vec3((j - 1.5) * (j - 1.5), 0.3 * k, 0.2 * j);
    return std::make_shared<LatticeMap>(lattice, Index3(16), outside);
}

TEST(CutFaces, OfALatticeWhoseFrameIsSmallerAreItsFaces) {
    expectNormals(through(lattice(frameOf({Vec3(-1), Vec3(0.3, 1, 1)}), 0), noise()), 0.3, Mat4(1));
    // A frame that is turned about z, as the volume is not.
    const Mat4 turn = placementMatrix(Vec3(0), Vec3(0, 0, 0.4), Vec3(1));
    Frame frame = frameOf({Vec3(-0.6, -0.8, -0.8), Vec3(0.3, 0.8, 0.8)});
    frame.corner = transformPoint(turn, frame.corner);
    for (Vec3& edge : frame.edge) edge = transformVector(turn, edge);
    expectNormals(through(lattice(frame, 0), noise()), 0.3, turn);
}

TEST(CutFaces, OfABentLatticeAreSmooth) {
    const Frame frame = frameOf({Vec3(-1), Vec3(0.3, 1, 1)});
    const TransferPtr map = lattice(frame, 0.1);
    const Lattice& bent = static_cast<const LatticeMap&>(*map).lattice();
    const TermPtr term = through(map, noise());
    const CutFinder cuts(*term, kThickness);
    for (double v = 0.07; v < 1; v += 0.11)
        for (double w = 0.05; w < 1; w += 0.13) {
            Mat3 slopes;
            const Vec3 target = evaluate(bent, Vec3(1, v, w), slopes);
            const Vec3 normal = glm::normalize(glm::cross(slopes[1], slopes[2]));
            const Vec3 direction = -glm::normalize(normal + Vec3(0, 0.3, -0.2));
            const auto cut = cuts.before(target - 5.0 * direction, direction, 5 + 0.5 * kThickness);
            ASSERT_TRUE(cut) << v << " " << w;
            EXPECT_NEAR(cut->depth, 5, 0.05 * kThickness);
            const double depth = cut->depth + 0.01 * kThickness;
            const Vec3 p = target + (depth - 5) * direction;
            // Facets of 16 cells would lie up to 2° off.
            EXPECT_LT(degreesBetween(cuts.blended(*cut, p, depth, Vec3(0.1, 0.2, 0.3)), normal), 0.3);
        }
}

TEST(CutFaces, AreWhereDataEndAndNotWhereTheyAreClear) {
    // Clear for x > 0, to the end of the box at 1: the surface at 0 is the data's own.
    TransferFunction look;
    look.opacity.points = {{-0.1, 1}, {0, 0}};
    look.color.points = {{0, Vec3(1)}};
    const TermPtr half = makeVolumeTerm(sampledVolume(41, [](const Vec3& p) { return p.x; }), 0, look);
    const CutFinder cuts(*half, kThickness);
    EXPECT_FALSE(cuts.before(Vec3(5, 0, 0), Vec3(-1, 0, 0), 5.05));
    EXPECT_FALSE(CutFinder(*solid(SphereShape{}, Vec3(1), "1"), kThickness).mayCut());
    // Deep behind a cut it does not count.
    EXPECT_FALSE(CutFinder(*noise(), kThickness).before(Vec3(5, 0, 0), Vec3(-1, 0, 0), 4 + 2.1 * kThickness));
}

// Volumes are seen up to a thousandth of a voxel outside their boxes.
TEST(CutFaces, AreFoundFromWhereRoundingShowsThem) {
    const TermPtr box = noise();
    const CutFinder cuts(*box, kThickness);
    const auto cut = cuts.before(Vec3(5, 0, 0), Vec3(-1, 0, 0), 4 - 4e-5);
    ASSERT_TRUE(cut);
    EXPECT_NEAR(cut->depth, 4, 1e-6);
    EXPECT_LT(degreesBetween(cuts.blended(*cut, Vec3(1 + 4e-5, 0, 0), 4 - 4e-5, Vec3(0)), Vec3(1, 0, 0)), 0.01);
}

TEST(CutFaces, OfTwoThingsInOnePlaceAreThoseOfTheOneThatIsSeen) {
    TransferFunction clear = constantLook(0, Vec3(1));
    const TermPtr around = makeVolumeTerm(sampledVolume(5, [](const Vec3&) { return 1; }), 0, clear);
    const TransferPtr split = library("split", {{"axis", std::vector<int>{0}}, {"gap", std::vector<double>{0.3}}});
    const TermPtr both = makeCvgTerm(CvgOperator::Union, {around, through(split, noise())});
    expectNormals(both, -0.3, Mat4(1));
}

// Beside edges, near and far, and where hardly anything is left behind the face.
TEST(CutFaces, AreFoundUpToTheirEdges) {
    const TermPtr box = noise();
    const CutFinder cuts(*box, kThickness);
    const Vec3 direction = glm::normalize(Vec3(0.3, 0.8, -0.5));
    for (const double along : {-0.99, -0.98, -0.9, 0.0, 0.9, 0.96, 0.98, 0.99}) {
        const Vec3 target(0.1, along, 1);
        for (const double behind : {0.01, 0.1}) {
            const auto cut = cuts.before(target - 5.0 * direction, direction, 5 + behind * kThickness);
            ASSERT_TRUE(cut) << along;
            EXPECT_LT(degreesBetween(cuts.blended(*cut, target, 5, Vec3(0.1, 0.2, 0.3)), Vec3(0, 0, 1)), 0.01) << along;
        }
    }
}

TEST(CutFaces, ShowAsFlatLitFacesInAPicture) {
    const TransferPtr split = library("split", {{"axis", std::vector<int>{0}}, {"gap", std::vector<double>{0.3}}});
    CompiledScene scene = sceneOf(through(split, noise()), {Vec3(7, -1, 1.5), Vec3(-0.3, 0, 0), Vec3(0, 0, 1), 3}, 0.5);
    // The flank at larger x is out of the way.
    scene.root = makeCvgTerm(CvgOperator::Intersection,
                             {scene.root, solid(BoxShape{Vec3(-3), Vec3(0, 3, 3)}, Vec3(0.8, 0.6, 0.4), "1")});
    scene.unitStep = scene.opacityDistance = kThickness;
    scene.render.shading = true;
    scene.render.light = Vec3(0.8, -0.3, 0.2);
    const Index2 size(24, 18);
    const Picture picture = castRays(scene, size);
    const Lights lights = lightsOf(scene.render, scene.camera);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const Vec3 toEye = -rayThrough(scene.camera, size, x, y);
            const Vec3 expected = litColor(scene.render, lights, Vec3(0.8, 0.6, 0.4), Vec3(1, 0, 0), toEye);
            // A hundredth of the light comes from deeper than the face.
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.at(x, y)[c], expected[c], 0.02);
        }
}

}  // namespace
}  // namespace voledit
