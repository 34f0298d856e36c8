#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/stf/composite_maps.h"
#include "core/stf/field_maps.h"
#include "core/stf/mapped_cells.h"
#include "tests/core/scene/compiled_json.h"

namespace voledit::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Box3 kBoxBounds{Vec3(0), {8, 4, 2}};
const std::string kTwist = R"({"type": "twist", "axis": "z", "angle": 40})";

std::string withFrame(std::string stf, const Box3& box) {
    const auto list = [](const Vec3& v) {
        return "[" + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + "]";
    };
    return stf.insert(1, R"("frame": {"min": )" + list(box.min) + R"(, "max": )" + list(box.max) + "}, ");
}

std::vector<Vec3> points() {
    std::vector<Vec3> p;
    for (int n = 0; n < 343; ++n)
        p.push_back(Vec3(n % 7, n / 7 % 7, n / 49) * Vec3(1.7, 0.9, 0.6) - Vec3(1.03, 0.71, 0.83));
    return p;
}

/// Largest distance between two maps over points in and about the box; infinite where one alone is undefined.
double distance(const SpatialTransferFunction& a, const SpatialTransferFunction& b) {
    double largest = 0;
    for (const Vec3& p : points()) {
        const Vec3 q = at(a, p), r = at(b, p);
        if (isDefined(q) != isDefined(r)) return kInfinity;
        if (isDefined(q)) largest = std::max(largest, glm::length(q - r));
    }
    return largest;
}

Box3 shifted(double x) {
    return {kBoxBounds.min + Vec3(x, 0, 0), kBoxBounds.max + Vec3(x, 0, 0)};
}
std::shared_ptr<const SpatialTransferFunction> outermost(const std::string& root, const std::string& members = "") {
    return transferOf(compiled(root, members).root).by;
}

TEST(CompileFrames, AreTheOperandsBoxAfterTheTransfersListedBefore) {
    EXPECT_EQ(distance(*outermost(transfer(kTwist)), *outermost(transfer(withFrame(kTwist, kBoxBounds)))), 0);
    const std::string list = "[" + shift(5) + ", " + kTwist + "]";
    EXPECT_EQ(distance(*outermost(transfer(list)), *outermost(transfer(withFrame(kTwist, shifted(5))))), 0);
}

TEST(CompileFrames, MembersOfASequenceTakeTheBoxAfterThoseBefore) {
    const std::string left = R"({"type": "sequence", "of": [)" + shift(5) + ", " + kTwist + "]}";
    const std::string given =
        R"({"type": "sequence", "of": [)" + shift(5) + ", " + withFrame(kTwist, shifted(5)) + "]}";
    EXPECT_EQ(distance(*outermost(transfer(left)), *outermost(transfer(given))), 0);
}

TEST(CompileFrames, BothOfTransferredTakeTheBoxOfTheFinalOperand) {
    const std::string left = R"({"type": "transferred", "by": )" + kTwist + R"(, "of": )" + shift(5) + "}";
    const std::string given =
        R"({"type": "transferred", "by": )" + withFrame(kTwist, kBoxBounds) + R"(, "of": )" + shift(5) + "}";
    EXPECT_EQ(distance(*outermost(transfer(left)), *outermost(transfer(given))), 0);
}

TEST(CompileFrames, InADisplacementAreTheBoxOfWhatIsDisplaced) {
    const auto sum = [](const std::string& twist) {
        return displace(R"({"type": "sum", "of": [{"type": "of", "transfer": )" + shift(5) +
                        R"(}, {"type": "scale", "by": 0.5, "of": {"type": "of", "transfer": )" + twist + "}}]}");
    };
    EXPECT_EQ(distance(*outermost(sum(kTwist)), *outermost(sum(withFrame(kTwist, kBoxBounds)))), 0);
}

TEST(CompileFrames, OfSharedTransfersAreThoseOfTheirFirstUse) {
    const std::string shared = R"("transfers": {"turn": )" + kTwist + "},";
    const std::string use = R"({"use": "turn"})";
    const std::string inner = displace(R"({"type": "of", "transfer": )" + use + "}");
    EXPECT_EQ(distance(*outermost(transfer("[" + shift(5) + ", " + use + "]", inner), shared),
                       *outermost(transfer(withFrame(kTwist, kBoxBounds)))),
              0);
    // Switched off, it is the first use all the same.
    const std::string off = R"({"type": "sequence", "enabled": false, "of": [)" + use + "]}";
    EXPECT_EQ(distance(*outermost(transfer("[" + off + ", " + shift(5) + ", " + use + "]"), shared),
                       *outermost(transfer(withFrame(kTwist, kBoxBounds)))),
              0);
}

TEST(CompileFrames, AComponentOfAnStfByItselfNeedsOne) {
    const auto component = [](const std::string& of, const std::string& axis = "x") {
        return R"({"type": "fields", "opacity": {"component": ")" + axis + R"(", "of": )" + of +
               R"(}, "color": [1, 1, 1]})";
    };
    const auto compileIt = [&](const std::string& root, const std::string& members = "") {
        return [=] { compiled(root, members); };
    };
    EXPECT_THAT(compileIt(component(kTwist)),
                ThrowsMessage<Error>(AllOf(HasSubstr("/root/opacity/of"), HasSubstr("give it a `frame`"))));
    EXPECT_THAT(compileIt(component(R"({"type": "of", "transfer": )" + kTwist + "}")),
                ThrowsMessage<Error>(HasSubstr("/root/opacity/of/transfer")));
    EXPECT_NO_THROW(compiled(component(withFrame(kTwist, kBoxBounds))));
    EXPECT_NO_THROW(compiled(component(shift(3)))) << "an affine map has no use for a frame";
    const std::string shared = R"("transfers": {"turn": )" + kTwist + "},";
    const std::string both =
        R"({"type": "union", "of": [)" + transfer(R"({"use": "turn"})") + ", " + component(R"({"use": "turn"})") + "]}";
    EXPECT_NO_THROW(compiled(both, shared)) << "it was used before";
}

TEST(CompileFrames, AreListedByTheirPaths) {
    const std::string sequence = R"({"type": "sequence", "of": [)" + shift(5) + ", " + kTwist + "]}";
    const CompiledScene scene =
        compiled(transfer("[" + sequence + R"(, {"use": "pull"}])"), R"("transfers": {"pull": {"type": "ffd"}},)");
    const auto& frames = defaultFrames(scene);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames.at("/root/by/0/of/1"), frameOf(shifted(5)));
    EXPECT_TRUE(frames.contains("/transfers/pull"));
}

TEST(CompileFrames, AreWrittenOutWhereverATransferStands) {
    const std::string sum = R"({"type": "sum", "of": [{"type": "of", "transfer": )" + kTwist + R"(}, {"use": "d"}]})";
    const std::string members = R"("displacements": {"d": {"type": "of", "transfer": {"type": "squeeze", "axis": "x",
        "at": 0.5, "strength": 0.3, "sigma": 0.2}}}, "objects": {"a~/b": )" +
                                transfer(R"({"type": "sequence", "of": [{"type": "ffd"}]})") + "},";
    const std::string deflect = R"({"type": "deflect", "center": [0, 0, 0], "radius": 1, "translate": [0.1, 0, 0]})";
    const Scene scene = sceneOf(R"({"type": "union", "of": [{"use": "a~/b"}, )" + displace(sum) + ", " +
                                    transfer("[" + deflect + ", " + shift(1) + "]") + "]}",
                                members);
    const Scene written = withDefaultsWrittenOut(scene, {});
    const auto& bent = std::get<TransferObject>(written.objects.at("a~/b")->kind);
    EXPECT_EQ(std::get<SequenceTransfer>(bent.by[0]->kind).of[0]->frame, TrackedFrame(frameOf(kBoxBounds)));
    EXPECT_FALSE(bent.by[0]->frame) << "a sequence has no use for one";
    const auto& of = std::get<OfDisplacement>(written.displacements.at("d")->kind);
    EXPECT_EQ(of.transfer->frame, TrackedFrame(frameOf(kBoxBounds)));
    const auto& all = std::get<CvgObject>(written.root->kind).of;
    const auto& combined = std::get<CombinedDisplacement>(std::get<DisplaceObject>(all[1]->kind).by->kind);
    EXPECT_EQ(std::get<OfDisplacement>(combined.of[0]->kind).transfer->frame, TrackedFrame(frameOf(kBoxBounds)));
    for (const auto& by : std::get<TransferObject>(all[2]->kind).by)
        EXPECT_FALSE(by->frame) << "neither deflect nor affine has a use for one";
    EXPECT_EQ(withDefaultsWrittenOut(written, {}), written);
    const CompiledScene before = compile(scene, {}, 0, nullptr);
    EXPECT_EQ(compile(written, {}, 0, &before).root, before.root) << "nothing moves";
    EXPECT_EQ(sceneFromJson(sceneToJson(written), "/scene.voledit"), written);
}

TEST(CompileAmounts, MultiplyTheStrengthOfALibraryTransfer) {
    const std::string half = R"({"type": "twist", "axis": "z", "angle": 40, "amount": 0.5})";
    const std::string twenty = R"({"type": "twist", "axis": "z", "angle": 20})";
    EXPECT_LT(distance(*outermost(transfer(half)), *outermost(transfer(twenty))), 1e-14)
        << "half the turn, not half the way";
}

TEST(CompileAmounts, ScaleTheDisplacementOfAllOthers) {
    const std::vector<std::string> others{
        R"({"type": "expression", "x": "x + 0.1*y", "y": "y^2", "z": "z", "undefined": "x > 0.9"})",
        R"({"type": "fields", "x": {"expression": "y"}, "y": {"expression": "x*z"}, "z": 1})",
        R"({"type": "sequence", "of": [)" + shift(1) + ", " + kTwist + "]}",
        R"({"type": "transferred", "by": )" + shift(1) + R"(, "of": )" + kTwist + "}",
        R"({"type": "ffd", "move": [{"point": [3, 3, 3], "by": [1, 1, 1]}]})"};
    for (const std::string& stf : others) {
        const auto whole = outermost(transfer(stf));
        std::string part = stf;
        part.insert(1, R"("amount": 0.3, )");
        const auto scaled = outermost(transfer(part));
        int defined = 0;
        for (const Vec3& p : points()) {
            const Vec3 q = at(*scaled, p), full = at(*whole, p);
            ASSERT_EQ(isDefined(q), isDefined(full)) << stf;
            if (!isDefined(q)) continue;
            ++defined;
            EXPECT_LT(glm::length(q - (p + 0.3 * (full - p))), 1e-12) << stf;
        }
        EXPECT_GT(defined, 40) << stf;
    }
}

TEST(CompileAmounts, HalfOfAHalfTurnFlattensSpaceAndStillCompiles) {
    const auto map = outermost(transfer(R"({"type": "affine", "rotate": [0, 0, 180], "amount": 0.5})"));
    EXPECT_LT(glm::length(at(*map, {3, 2, 1}) - Vec3(0, 0, 1)), 1e-14);
}

TEST(CompileOutside, HidesUnlessAFieldOfDisplacementsSaysNothing) {
    LoadedAssets assets;
    assets.volumes["v"] = unitVolume(3, 3, [](const Vec3&, int c) { return 0.1 * c; });
    const std::string members = R"("assets": {"v": {"kind": "volume", "path": "v.nrrd"}},)";
    const auto mapOfFields = [&](const std::string& more) {
        return transferOf(compiled(transfer(R"({"type": "fields", "asset": "v")" + more + "}"), members, assets).root)
            .by;
    };
    const Vec3 outside(5, 1, 1);
    EXPECT_FALSE(isDefined(at(*mapOfFields(""), outside)));
    EXPECT_EQ(at(*mapOfFields(R"(, "displacement": true)"), outside), outside);
    EXPECT_EQ(at(*mapOfFields(R"(, "outside": "keep")"), outside), outside);
    EXPECT_FALSE(isDefined(at(*mapOfFields(R"(, "displacement": true, "outside": "hide")"), outside)));
    const Vec3 inside(0.5, 0.25, 0.75);
    EXPECT_LT(glm::length(at(*mapOfFields(R"(, "displacement": true)"), inside) - (inside + Vec3(0, 0.1, 0.2))), 1e-7);
    EXPECT_LT(glm::length(at(*mapOfFields(""), inside) - Vec3(0, 0.1, 0.2)), 1e-7);
}

TEST(CompileSequence, WithoutCellsIsOneMap) {
    const CompiledScene scene = compiled(transfer(R"({"type": "sequence", "of": [)" + shift(1) + ", " + kTwist + "]}"));
    EXPECT_TRUE(dynamic_cast<const SequenceMap*>(&mapOf(scene)));
    EXPECT_TRUE(std::holds_alternative<SolidTerm>(transferOf(scene.root).of->node));
}

TEST(CompileSequence, WithCellsHasATermForEachMemberSoThatAllPreImagesCount) {
    // A lattice folded over itself, through `use` and within another sequence.
    const std::string members = R"("transfers": {"fold": {"type": "ffd", "degree": [2, 1, 1], "move": [
        {"point": [2, 0, 0], "by": [-12, 0, 0]}, {"point": [2, 1, 0], "by": [-12, 0, 0]},
        {"point": [2, 0, 1], "by": [-12, 0, 0]}, {"point": [2, 1, 1], "by": [-12, 0, 0]}]}},)";
    const std::string sequence =
        R"({"type": "sequence", "name": "s", "of": [{"type": "sequence", "of": [{"use": "fold"}]}, )" + shift(1) + "]}";
    const auto translucent = [](const std::string& by) {
        return R"({"type": "transfer", "combine": "merge", "by": )" + by +
               R"(, "of": {"type": "solid", "shape": {"box": {"min": [0, 0, 0], "max": [8, 4, 2]}}, "color": [1, 1, 1], "opacity": 0.25}})";
    };
    const CompiledScene scene = compiled(translucent(sequence), members);
    const auto& outer = transferOf(scene.root);
    const auto& inner = transferOf(outer.of);
    EXPECT_EQ(outer.role, TransferRole::Outermost);
    EXPECT_EQ(outer.name, "s");
    EXPECT_EQ(inner.role, TransferRole::Part);
    EXPECT_EQ(inner.combine, Combine::Merge);
    ASSERT_TRUE(inner.by->cells());
    const CompiledScene apart = compiled(translucent(R"([{"use": "fold"}, )" + shift(1) + "]"), members);
    int twice = 0;
    for (double x = -6; x < 9; x += 0.37) {
        const double opacity = at(scene, {x, 1, 1}).opacity;
        EXPECT_EQ(opacity, at(apart, {x, 1, 1}).opacity);
        twice += opacity > 0.4;
    }
    EXPECT_GT(twice, 2) << "where the lattice folds two layers merge";
}

TEST(CompileMapped, TakesItsCellsAsTheyAre) {
    std::string points, source;
    for (int v = 0; v < 8; ++v) {
        const Vec3 q = kBoxBounds.corner(v);
        const auto list = [](const Vec3& x) {
            return "[" + std::to_string(x.x) + ", " + std::to_string(x.y) + ", " + std::to_string(x.z) + "]";
        };
        source += (v ? ", " : "") + list(q);
        points += (v ? ", " : "") + list(2.0 * q + Vec3(1, 0, 0));
    }
    const auto map = outermost(transfer(R"({"type": "mapped", "points": [)" + points + R"(], "source": [)" + source +
                                        R"(], "cells": [[0, 1, 2, 3, 4, 5, 6, 7]]})"));
    EXPECT_LT(glm::length(at(*map, {9, 2, 2}) - Vec3(4, 1, 1)), 1e-12);
    EXPECT_FALSE(isDefined(at(*map, {0, 2, 2})));
}

TEST(CompileFormulaFiles, AreThoseThatWereLoaded) {
    const std::string stf = R"({"type": {"file": "ripple.stf"}, "height": 0.5})";
    EXPECT_THAT([&] { compiled(transfer(stf)); },
                ThrowsMessage<Error>(AllOf(HasSubstr("/root/by/0"), HasSubstr("ripple.stf"), HasSubstr("not loaded"))));
    LoadedAssets assets;
    assets.transfers["ripple.stf"] = TransferDefinition::parse(
        "title: Ripple\ndescription: Waves.\nsource: a test\n\nparameter height number suggested 0.1 strength "
        "\"Height\"\n\n"
        "[map]\nq = replace(u, 2, u[2] + height)\n",
        "ripple", "ripple.stf");
    const CompiledScene scene = compiled(transfer(stf), "", assets);
    EXPECT_LT(glm::length(at(mapOf(scene), {1, 1, 0.5}) - Vec3(1, 1, 1.5)), 1e-14) << "half of the frame's 2";
}

TEST(CompileErrors, NameThePlaceTheMistakeAndTheRemedy) {
    const auto compileIt = [](const std::string& root, const LoadedAssets& assets = {}) {
        return [=] { compiled(root, R"("assets": {"v": {"kind": "volume", "path": "v.nrrd"}},)", assets); };
    };
    LoadedAssets two;
    two.volumes["v"] = unitVolume(2, 2, [](const Vec3&, int) { return 0.0; });
    EXPECT_THAT(compileIt(transfer(R"({"type": "fields", "asset": "v"})"), two),
                ThrowsMessage<Error>(AllOf(HasSubstr("/root/by/0: "), HasSubstr("2 components"))));
    EXPECT_THAT(compileIt(transfer(
                    R"({"type": "insideOut", "line": {"point": [0, 0, 0], "direction": [0, 0, 0]}, "radius": 1})")),
                ThrowsMessage<Error>(AllOf(HasSubstr("/root/by"), HasSubstr("direction"))));
    // What a file may not say, a program may: a scene made by hand.
    Scene flat = sceneOf(transfer(shift(1)));
    auto& by = std::get<TransferObject>(flat.root.edit().kind).by[0].edit();
    std::get<AffineTransfer>(by.kind).placement.scale = Vec3(1, 0, 1);
    EXPECT_THAT([&] { compile(flat, {}, 0, nullptr); }, ThrowsMessage<Error>(HasSubstr("/root/by/0: affine transfer")));
}

TEST(CompileWarnings, SayWhatIsOddAndWhere) {
    const std::string deflect = R"({"type": "deflect", "center": [4, 2, 1], "radius": 1, "translate": [3, 0, 0]})";
    const Scene scene = sceneOf(transfer(deflect));
    const CompiledScene first = compile(scene, {}, 0, nullptr), again = compile(scene, {}, 0, &first);
    ASSERT_EQ(first.warnings.size(), 1u);
    EXPECT_THAT(first.warnings[0], HasSubstr("/root/by/0"));
    EXPECT_EQ(again.warnings, first.warnings) << "also where the map was made before";
}

}  // namespace
}  // namespace voledit::test
