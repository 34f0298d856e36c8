#include <gmock/gmock.h>

#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/stf/mesh_field.h"
#include "tests/core/scene/compiled_json.h"
#include "tests/support/meshes.h"

namespace voledit::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kAsset = R"("assets": {"v": {"kind": "volume", "path": "v.nrrd"}},)";

LoadedAssets steps() {
    LoadedAssets assets;
    assets.volumes["v"] = unitVolume(5, 1, [](const Vec3& p, int) { return 4 * p.x; });
    return assets;
}

std::string solid(const std::string& shape, const std::string& more = R"("opacity": 1)") {
    return R"({"type": "solid", "color": [0.2, 0.4, 0.6], "shape": )" + shape + ", " + more + "}";
}

TEST(CompileSolid, EveryShapeStandsWhereItSays) {
    const struct {
        std::string shape;
        Vec3 inside, outside;
    } cases[] = {
        {R"({"sphere": {"center": [1, 0, 0], "radius": 2}})", {2.9, 0, 0}, {-1.1, 0, 0}},
        {R"({"box": {"min": [0, 0, 0], "max": [1, 2, 3]}})", {0.9, 1.9, 2.9}, {1.1, 1, 1}},
        {R"({"cylinder": {"from": [0, 0, 0], "to": [0, 0, 4], "radius": 1}})", {0.9, 0, 3.9}, {0, 0, 4.1}},
        {R"({"capsule": {"from": [0, 0, 0], "to": [0, 0, 4], "radius": 1}})", {0, 0, 4.9}, {0, 0, 5.1}},
        {R"({"torus": {"center": [0, 0, 0], "axis": [0, 0, 1], "major": 2, "minor": 0.5}})", {2.4, 0, 0}, {0, 0, 0}},
        {R"({"text": {"string": "I", "height": 2, "depth": 1}})", {0, 0, -9}, {0, 0, 9}},  // its inside is sought below
        {R"json({"expression": {"d": "abs(x) + abs(y) + abs(z) - 1"}})json", {0.9, 0, 0}, {0.5, 0.5, 0.5}},
    };
    for (const auto& c : cases) {
        const CompiledScene scene = compiled(solid(c.shape));
        Vec3 inside = c.inside;
        if (c.shape.find("text") != std::string::npos) inside = scene.root->bounds.center();
        const ObjectSample in = at(scene, inside), out = at(scene, c.outside);
        EXPECT_EQ(in.opacity, 1) << c.shape;
        EXPECT_EQ(in.color, Vec3(0.2, 0.4, 0.6)) << c.shape;
        EXPECT_EQ(out.opacity, 0) << c.shape;
    }
}

TEST(CompileSolid, OpacityMayBeAFormulaAndFadesOverTheFalloff) {
    const std::string sphere = R"({"sphere": {"center": [1, 0, 0], "radius": 2}})";
    const CompiledScene scene = compiled(solid(sphere, R"("opacity": "-d / 4 + 0*r*x*y*z*t", "falloff": 0.5)"));
    EXPECT_NEAR(at(scene, {1, 0, 0}).opacity, 0.5, 1e-12);
    EXPECT_NEAR(at(scene, {2, 0, 0}).opacity, 0.25, 1e-12);
    const CompiledScene faded = compiled(solid(sphere, R"("opacity": 0.8, "falloff": 0.5)"));
    EXPECT_NEAR(at(faded, {3.25, 0, 0}).opacity, 0.4, 1e-12);
    EXPECT_EQ(at(faded, {3.6, 0, 0}).opacity, 0);
    EXPECT_THAT([&] { compiled(solid(R"({"sphere": {"center": [0, 0, 0], "radius": -1}})")); },
                ThrowsMessage<Error>(HasSubstr("radius")));
}

TEST(CompileFields, OpacityColourAndNamedAttributes) {
    const std::string fields =
        R"({"type": "fields", "opacity": {"expression": "x"}, "color": [0.5, {"expression": "y"}, 1],
        "bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}, "heat": {"expression": "100*z"}})";
    const CompiledScene scene = compiled(fields);
    const ObjectSample found = at(scene, {0.25, 0.5, 0.75}, "heat");
    EXPECT_EQ(found.opacity, 0.25);
    EXPECT_EQ(found.color, Vec3(0.5, 0.5, 1));
    EXPECT_EQ(found.value, 75);
    EXPECT_EQ(at(scene, {1.5, 0.5, 0.5}).opacity, 0) << "outside of its bounds";
}

TEST(CompileFieldKinds, GiveTheirValues) {
    const auto fieldAt = [](const std::string& field, const Vec3& p) {
        const std::string root = R"({"type": "fields", "bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]}, "opacity": 1,
            "color": [0, 0, 0], "value": )" +
                                 field + "}";
        return at(compiled(root, kAsset, steps()), p, "value").value;
    };
    const Vec3 p(0.5, 0.25, 0.125);
    EXPECT_EQ(fieldAt("0.75", p), 0.75);
    EXPECT_EQ(fieldAt(R"({"expression": "x + 10*y"})", p), 3);
    EXPECT_EQ(fieldAt(R"({"asset": "v"})", p), 2);
    EXPECT_NE(fieldAt(R"({"asset": "v"})", Vec3(2)), fieldAt(R"({"asset": "v"})", Vec3(2))) << "undefined outside";
    EXPECT_EQ(fieldAt(R"({"map": [[0, 10], [4, 30]], "of": {"asset": "v"}})", p), 20);
    EXPECT_EQ(fieldAt(R"({"component": "x", "of": )" + shift(3) + "}", p), -2.5) << "Ψ";
    EXPECT_EQ(fieldAt(R"({"component": "x", "of": {"type": "of", "transfer": )" + shift(3) + "}}", p), -3) << "Δ";
    EXPECT_EQ(fieldAt(R"({"attribute": "opacity", "of": )" + kBox + "}", p), 1);
    EXPECT_EQ(fieldAt(R"({"attribute": "scalar", "of": {"type": "volume", "asset": "v"}})", p), 2);
    EXPECT_EQ(fieldAt(R"({"attribute": "heat", "of": {"type": "fields", "opacity": 1, "color": [0, 0, 0],
        "heat": {"expression": "7*x"}}})",
                      p),
              3.5);
}

TEST(CompileCvg, EveryOperatorIsItself) {
    const auto half = [](double opacity) {
        return solid(R"({"sphere": {"center": [0, 0, 0], "radius": 2}})", R"("opacity": )" + std::to_string(opacity));
    };
    const auto opacityOf = [&](const std::string& type, const std::string& more = "") {
        return at(compiled(R"({"type": ")" + type + R"(", "of": [)" + half(0.5) + ", " + half(0.25) + "]" + more + "}"),
                  Vec3(0))
            .opacity;
    };
    EXPECT_EQ(opacityOf("union"), 0.5);
    EXPECT_EQ(opacityOf("intersection"), 0.25);
    EXPECT_EQ(opacityOf("difference"), 0.25);
    EXPECT_EQ(opacityOf("merge"), 0.75);
    EXPECT_EQ(opacityOf("cap"), 0);
    EXPECT_EQ(opacityOf("trim"), 0.5);
    EXPECT_EQ(opacityOf("blend", R"(, "weight": 0.5)"), 0.375);
    EXPECT_EQ(opacityOf("blend", R"(, "weight": {"expression": "1 - x"})"), 0.25);
}

TEST(CompileRecolor, LaysItsTablesOverAnAttribute) {
    const CompiledScene scene = compiled(
        R"({"type": "recolor", "from": "scalar", "color": [[0, 1, 0, 0], [4, 0, 0, 1]], "opacity": [[0, 0.5], [4, 1]],
            "of": {"type": "volume", "asset": "v", "appearance": {"opacity": [[0, 1]]}}})",
        kAsset, steps());
    const ObjectSample found = at(scene, {0.5, 0.5, 0.5});
    EXPECT_EQ(found.opacity, 0.75);
    EXPECT_EQ(found.color, Vec3(0.5, 0, 0.5));
}

TEST(CompileVolume, InterpolatesAsAsked) {
    for (const auto& [name, value] : {std::pair{"linear", 0.8}, {"nearest", 1.0}}) {
        const CompiledScene scene = compiled(
            R"({"type": "volume", "asset": "v", "interpolation": ")" + std::string(name) + R"("})", kAsset, steps());
        EXPECT_NEAR(at(scene, {0.2, 0.5, 0.5}).value, value, 1e-6) << name;
    }
}

TEST(CompileMesh, IsAGreyRampOverItsValuesWithoutTables) {
    MeshData data = warpedGrid(Index3(3));
    for (std::size_t n = 0; n < data.points.size(); ++n)
        data.values[n] = float(10 + 20 * double(n) / double(data.points.size() - 1));
    LoadedAssets assets;
    assets.meshes["v"] = std::make_shared<const Mesh>(std::move(data));
    const CompiledScene scene = compiled(R"({"type": "volume", "asset": "v"})", kAsset, assets);
    ASSERT_TRUE(std::holds_alternative<MeshTerm>(scene.root->node));
    const ObjectSample found = at(scene, Vec3(0.1));
    EXPECT_GT(found.value, 10);
    EXPECT_NEAR(found.opacity, (found.value - 10) / 20, 1e-6);
    EXPECT_EQ(scene.opacityDistance, 1) << "a mesh has no spacing";
    EXPECT_DOUBLE_EQ(
        scene.unitStep,
        std::max({scene.root->bounds.size().x, scene.root->bounds.size().y, scene.root->bounds.size().z}) / 256);
    EXPECT_THAT([&] { compiled(R"({"type": "volume", "asset": "v", "channel": 1})", kAsset, assets); },
                ThrowsMessage<Error>(HasSubstr("no channel 1")));
}

TEST(CompileDisplace, CombinesDisplacements) {
    const auto delta = [](const std::string& x) { return R"({"type": "fields", "x": )" + x + R"(, "y": 0, "z": 0})"; };
    const auto xAt = [](const std::string& by, const Vec3& p) { return at(mapOf(compiled(displace(by))), p).x - p.x; };
    const Vec3 p(1, 2, 3);
    const auto of = [&](const std::string& type, const std::string& more = "") {
        return R"({"type": ")" + type + R"(", "of": [)" + delta("0.5") + ", " + delta("-2") + "]" + more + "}";
    };
    EXPECT_EQ(xAt(of("sum"), p), -1.5);
    EXPECT_EQ(xAt(of("union"), p), -2);
    EXPECT_EQ(xAt(of("intersection"), p), 0.5);
    EXPECT_EQ(xAt(of("blend", R"(, "weight": 0.25)"), p), -0.125);
    EXPECT_EQ(xAt(R"({"type": "scale", "by": 3, "of": )" + delta("0.5") + "}", p), 1.5);
    EXPECT_EQ(xAt(R"({"type": "scale", "by": {"expression": "y"}, "of": )" + delta("0.5") + "}", p), 1);
    EXPECT_EQ(transferOf(compiled(displace(of("sum"))).root).role, TransferRole::Displace);
    const CompiledScene named =
        compiled(displace(R"({"use": "d"})"), R"("displacements": {"d": )" + delta("0.5") + "},");
    EXPECT_EQ(at(mapOf(named), p).x - p.x, 0.5);
}

/// One of every kind of object, transfer, displacement and field.
std::string everything(const std::string& radius = "1") {
    const std::string twist = R"({"type": "twist", "axis": "z", "angle": 30})";
    const std::string wave =
        R"json({"type": "expression", "x": "x + 0.1*sin(y)", "y": "y", "z": "z", "amount": 0.5})json";
    const std::string fields = R"({"type": "fields", "displacement": true, "x": {"expression": "0.1*y"}, "y": 0,
        "z": {"component": "x", "of": )" +
                               shift(1) + "}}";
    const std::string by = "[" + twist + ", " + wave + ", " + fields +
                           R"(, {"type": "ffd"}, {"type": "sequence", "of": [)" + twist + ", " + twist +
                           R"(]}, {"type": "transferred", "by": )" + twist + R"(, "of": )" + wave + "}]";
    const std::string sum =
        R"({"type": "sum", "of": [{"type": "of", "transfer": )" + twist +
        R"(}, {"type": "union", "of": [{"type": "of", "transfer": )" + wave +
        R"(}, {"type": "fields", "x": 0.1, "y": 0, "z": 0}]}, {"type": "scale", "by": {"expression": "x"},
                            "of": {"type": "of", "transfer": )" +
        wave + R"(}}, {"type": "blend", "weight": 0.5, "of": [
                            {"type": "of", "transfer": )" +
        wave + R"(}, {"type": "of", "transfer": )" + twist + "}]}]}";
    const std::string object = R"({"type": "fields", "color": [0.5, 0.5, {"map": [[0, 0], [1, 1]], "of": 0.5}],
        "opacity": {"attribute": "opacity", "of": {"type": "volume", "asset": "v", "interpolation": "cubic"}}})";
    const std::string text = solid(R"({"text": {"string": "ab", "height": 1, "depth": 0.5}})");
    return R"({"type": "union", "of": [)" + transfer(by) + ", " + displace(sum) + R"(, {"type": "recolor",
        "opacity": [[0, 0], [1, 0.5]], "of": )" +
           object + R"(}, {"type": "place", "translate": [1, 0, 0], "of": )" + text +
           R"(}, {"type": "blend", "weight": 0.5, "of": [{"type": "volume", "asset": "v"}, )" +
           solid(R"({"sphere": {"center": [0, 0, 0], "radius": )" + radius + "}}") + "]}]}";
}

TEST(CompileReuse, EqualPiecesOfEveryKindAreTheVeryObjects) {
    const LoadedAssets assets = steps();
    const CompiledScene first = compile(sceneOf(everything(), kAsset), assets, 0, nullptr);
    const CompiledScene second = compile(sceneOf(everything(), kAsset), assets, 0, &first);
    EXPECT_EQ(second.root.get(), first.root.get());
    const CompiledScene later = compile(sceneOf(everything(), kAsset), assets, 3.5, &second);
    EXPECT_EQ(later.root.get(), first.root.get()) << "nothing reads the time";

    const CompiledScene other = compile(sceneOf(everything("1.25"), kAsset), assets, 0, &later);
    EXPECT_NE(other.root, first.root);
    const auto& before = std::get<CvgTerm>(first.root->node).of;
    const auto& after = std::get<CvgTerm>(other.root->node).of;
    for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(after[n].get(), before[n].get()) << n;
    EXPECT_EQ(std::get<CvgTerm>(after[4]->node).of[0], std::get<CvgTerm>(before[4]->node).of[0]) << "the volume";
    EXPECT_EQ(std::get<CvgTerm>(after[4]->node).weight, std::get<CvgTerm>(before[4]->node).weight);
}

TEST(CompileReuse, ASharedObjectIsCompiledOnce) {
    const CompiledScene scene = compiled(R"({"type": "union", "of": [{"use": "o"}, {"use": "o"}, )" + kBox + "]}",
                                         R"("objects": {"o": )" + kBox + "},");
    const auto& of = std::get<CvgTerm>(scene.root->node).of;
    EXPECT_EQ(of[0], of[1]);
    EXPECT_EQ(of[0], of[2]) << "and so is an equal one";
}

TEST(CompileTracks, FramesAndCameraAreThoseOfTheTimelinesStart) {
    const std::string grow = R"({"type": "affine", "scale": {"keys": [[0, 1], [2, 3]]}})";
    const std::string twist = R"({"type": "twist", "axis": "z", "angle": {"keys": [[0, 0], [2, 90]]}})";
    const std::string root = transfer("[" + grow + ", " + twist + "]");
    const std::string timeline = R"("timeline": {"fps": 10, "start": 10, "end": 20},)";
    const Scene scene = sceneOf(root, timeline);
    const CompiledScene start = compile(scene, {}, 1, nullptr), later = compile(scene, {}, 2, nullptr);
    const std::map<std::string, Frame> expected{{"/root/by/1", frameOf({Vec3(0), {16, 8, 4}})}};
    EXPECT_EQ(defaultFrames(start), expected) << "twice as large at one second";
    EXPECT_EQ(defaultFrames(later), expected);
    EXPECT_EQ(later.camera, start.camera);
    EXPECT_EQ(later.unitStep, start.unitStep);
    EXPECT_NE(later.root->bounds, start.root->bounds);
    // At two seconds the object is three times as large, and turned by 90° over the frame of the start.
    const auto map = transferOf(later.root).by;
    const std::string given =
        R"({"type": "twist", "axis": "z", "angle": 90, "frame": {"min": [0, 0, 0], "max": [16, 8, 4]}})";
    const auto expectedMap = transferOf(compiled(transfer(given)).root).by;
    for (int n = 0; n < 20; ++n) EXPECT_EQ(at(*map, Vec3(n % 5, n % 3, n)), at(*expectedMap, Vec3(n % 5, n % 3, n)));
    EXPECT_EQ(std::get<TransferObject>(withDefaultsWrittenOut(scene, {}).root->kind).by[1]->frame,
              TrackedFrame(expected.begin()->second));
}

TEST(CompileTracks, PlayingKeepsWhatDoesNotMove) {
    const std::string moving =
        transfer(R"({"type": "affine", "translate": {"keys": [[0, [0, 0, 0]], [1, [5, 0, 0]]]}})");
    const Scene scene = sceneOf(R"({"type": "union", "of": [)" + moving + ", " +
                                transfer(R"({"type": "twist", "axis": "z", "angle": 30})") + "]}");
    const CompiledScene first = compile(scene, {}, 0, nullptr), second = compile(scene, {}, 0.5, &first),
                        third = compile(scene, {}, 0.75, &second);
    const auto part = [](const CompiledScene& s, std::size_t n) { return std::get<CvgTerm>(s.root->node).of[n]; };
    EXPECT_EQ(part(second, 1), part(first, 1));
    EXPECT_EQ(part(third, 1), part(first, 1));
    EXPECT_NE(part(third, 0), part(second, 0));
    EXPECT_EQ(transferOf(part(third, 0)).of, transferOf(part(first, 0)).of);
    EXPECT_EQ(third.root->bounds.max.x, 11.75);
}

TEST(CompileTime, FormulasSeeItInSeconds) {
    const std::string wave = R"({"type": "expression", "space": "world", "x": "x + 2*t", "y": "y", "z": "z"})";
    const std::string later = transfer("[" + wave + R"(, {"type": "ffd"}])");
    const Scene scene = sceneOf(later);
    const CompiledScene compiledThen = compile(scene, {}, 1.5, nullptr);
    EXPECT_EQ(at(*transferOf(transferOf(compiledThen.root).of).by, Vec3(0)).x, 3);
    EXPECT_EQ(defaultFrames(compiledThen), defaultFrames(compile(scene, {}, 0, nullptr)));
    const std::string fading = R"({"type": "fields", "opacity": {"expression": "t / 4"}, "color": [1, 1, 1]})";
    EXPECT_EQ(at(compile(sceneOf(fading), {}, 1, nullptr), Vec3(0)).opacity, 0.25);
    const std::string grown = solid(R"json({"expression": {"d": "abs(x) - t / 2"}})json", R"("opacity": "t / 2")");
    const CompiledScene big = compile(sceneOf(grown), {}, 1, nullptr);
    EXPECT_EQ(at(big, {0.4, 0, 0}).opacity, 0.5);
    EXPECT_EQ(at(big, {0.6, 0, 0}).opacity, 0);
}

TEST(CompileDepth, TheDeepestOfEveryKindCompilesAndIsSampled) {
    const auto chain = [](int depth, const std::string& inner,
                          const std::function<std::string(const std::string&)>& outer, const std::string& kind) {
        std::string members = R"(")" + kind + R"(": {"n0": )" + inner;
        for (int n = 1; n < depth; ++n)
            members +=
                R"(, "n)" + std::to_string(n) + R"(": )" + outer(R"({"use": "n)" + std::to_string(n - 1) + R"("})");
        return std::pair(members + "},", R"({"use": "n)" + std::to_string(depth - 1) + R"("})");
    };
    const int depth = 160;  // a name, what stands there and what it becomes are three levels
    const auto objects = chain(
        depth, kBox,
        [](const std::string& of) { return R"({"type": "recolor", "opacity": [[0, 0], [1, 1]], "of": )" + of + "}"; },
        "objects");
    EXPECT_EQ(at(compiled(objects.second, objects.first), {1, 1, 1}).opacity, 1);
    const auto unions = chain(
        depth, kBox, [](const std::string& of) { return R"({"type": "union", "of": [)" + kBox + ", " + of + "]}"; },
        "objects");
    EXPECT_EQ(at(compiled(unions.second, unions.first), {1, 1, 1}).opacity, 1);
    const auto sequences = chain(
        depth, shift(1),
        [](const std::string& of) { return R"({"type": "sequence", "amount": 0.99, "of": [)" + of + "]}"; },
        "transfers");
    EXPECT_LT(at(mapOf(compiled(transfer(sequences.second), sequences.first)), Vec3(5)).x, 5);
    const auto sums = chain(
        depth, R"({"type": "fields", "x": {"expression": "0.01*y"}, "y": 0, "z": 0})",
        [](const std::string& of) {
            return R"({"type": "sum", "of": [{"type": "fields", "x": 0.01, "y": 0, "z": 0}, )" + of + "]}";
        },
        "displacements");
    EXPECT_NEAR(at(mapOf(compiled(displace(sums.second), sums.first)), Vec3(0)).x, 1.59, 1e-9);
}

TEST(CompileDepth, WhatIsSharedTooOftenIsRefused) {
    std::string members = R"("objects": {"n0": )" + kBox;
    for (int n = 1; n < 60; ++n) {
        const std::string use = R"({"use": "n)" + std::to_string(n - 1) + R"("})";
        members += R"(, "n)" + std::to_string(n) + R"(": {"type": "union", "of": [)" + use + ", " + use + "]}";
    }
    EXPECT_THAT([&] { compiled(R"({"use": "n59"})", members + "},"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("/objects/n"), HasSubstr("100000"))));
}

}  // namespace
}  // namespace voledit::test
