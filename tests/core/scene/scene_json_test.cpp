#include "core/scene/scene_json.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/base/error.h"
#include "core/base/paths.h"
#include "core/scene/edits.h"
#include "tests/core/scene/random_scenes.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const fs::path kPath = "/somewhere/s.voledit";

Scene read(const std::string& text) {
    return sceneFromJson(text, kPath);
}

/// A scene with `root`, an asset "h", an object "o" that shows it, and more top-level members.
std::string sceneWith(const std::string& root, const std::string& more = "") {
    return R"({"voledit": 1, "assets": {"h": {"kind": "volume", "path": "h.nrrd"}}, )" + more + R"("root": )" + root +
           "}";
}
std::string transferBy(const std::string& stf, const std::string& more = "") {
    return sceneWith(R"({"type": "transfer", "by": )" + stf + R"(, "of": {"type": "volume", "asset": "h"}})", more);
}
const std::string kVolume = R"({"type": "volume", "asset": "h"})";

// ---- Reading ------------------------------------------------------------------------------------------------------

TEST(SceneFromJson, ReadsTheExampleOfTheContract) {
    const Scene scene = read(R"({
      "voledit": 1,
      "assets": { "head": { "kind": "volume", "path": "ct-head.nrrd" },
                  "walk": { "kind": "motion", "path": "walk.bvh" } },
      "objects": { "skull": { "type": "volume", "asset": "head", "appearance": { "preset": "ct-bone" } } },
      "transfers": { "pull": { "type": "ffd", "degree": [3, 3, 3],
                               "move": [ { "point": [3, 3, 3], "by": [20, 0, 10] } ] } },
      "root": { "type": "transfer", "by": [ { "use": "pull" } ], "of": { "use": "skull" } },
      "opacityDistance": 1.0,
      "camera": { "eye": [0, -400, 80], "target": [0, 0, 0], "up": [0, 0, 1], "fovY": 30 },
      "render": { "background": [0, 0, 0], "step": 0.5, "shading": true, "ambient": 0.3, "diffuse": 0.7,
                  "specular": 0.2, "shininess": 20, "light": "headlight" },
      "timeline": { "fps": 24, "start": 0, "end": 48 } })");
    EXPECT_EQ(scene.assets.at("walk").kind, AssetKind::Motion);
    const auto& pull = std::get<FfdTransfer>(scene.transfers.at("pull")->kind);
    EXPECT_EQ(pull.points, Index3(4));
    EXPECT_EQ(pull.cells, Index3(16));
    ASSERT_EQ(pull.moves.size(), 1u);
    EXPECT_EQ(pull.moves.at(63), (FfdTransfer::Move{{20, 0, 10}, false}));
    EXPECT_EQ(scene.opacityDistance, 1.0);
    EXPECT_EQ(scene.camera, (Camera{{0, -400, 80}, {0, 0, 0}, {0, 0, 1}, 30}));
    EXPECT_EQ(scene.render, RenderSettings{}) << "the example's values are the defaults";
    EXPECT_EQ(scene.timeline, Timeline{});
    EXPECT_EQ(std::get<TransferObject>(scene.root->kind).combine, Combine::Union);
}

TEST(SceneFromJson, MembersLeftOutTakeTheContractsDefaults) {
    const Scene scene = read(sceneWith(kVolume, R"("camera": {"fovY": 40}, "render": {"step": 1}, )"));
    EXPECT_EQ(scene.camera, (Camera{{0, -400, 80}, {0, 0, 0}, {0, 0, 1}, 40}));
    RenderSettings expected;
    expected.step = 1;
    EXPECT_EQ(scene.render, expected);
    EXPECT_EQ(read(sceneWith(kVolume)).camera, std::nullopt);
    EXPECT_EQ(read(sceneWith(kVolume)).opacityDistance, std::nullopt);
}

TEST(SceneFromJson, ReadsEveryFormOfWhatIsBuilt) {
    const Scene scene = read(transferBy(R"([
        {"type": "affine", "matrix": [1, 0, 0, 10, 0, 0, -1, 20, 0, 1, 0, 30, 0, 0, 0, 1], "name": "turn"},
        {"type": "affine", "translate": [1, 2, 3], "rotate": [0, 0, 90], "scale": 2, "amount": 0.5, "enabled": false},
        {"type": "ffd", "basis": "bspline", "points": [4, 5, 6], "cells": [2, 3, 4], "outside": "keep",
         "frame": {"min": [0, 0, 0], "max": [1, 2, 3]}, "move": [{"point": [1, 2, 3], "to": [7, 8, 9]}]},
        {"type": "ffd", "degree": [1, 1, 1], "frame": {"corner": [1, 1, 1], "x": [2, 0, 0], "y": [1, 2, 0], "z": [0, 0, 2]},
         "control": [[0,0,0], [1,0,0], [0,1,0], [1,1,0], [0,0,1], [1,0,1], [0,1,1], [1,1,2]]}])"));
    const auto& by = std::get<TransferObject>(scene.root->kind).by;
    ASSERT_EQ(by.size(), 4u);
    const Mat4 matrix = worldFromRest(std::get<AffineTransfer>(by[0]->kind).placement);
    EXPECT_EQ(transformPoint(matrix, {1, 2, 3}), Vec3(11, 17, 32)) << "row by row, q to p";
    EXPECT_EQ(by[0]->name, "turn");
    EXPECT_EQ(std::get<AffineTransfer>(by[1]->kind).placement.scale, Vec3(2));
    EXPECT_FALSE(by[1]->enabled);
    EXPECT_EQ(by[1]->amount, 0.5);
    const auto& spline = std::get<FfdTransfer>(by[2]->kind);
    EXPECT_EQ(spline.points, Index3(4, 5, 6));
    EXPECT_EQ(spline.moves.at(1 + 4 * (2 + 5 * 3)), (FfdTransfer::Move{{7, 8, 9}, true}));
    EXPECT_EQ(by[2]->outside, Outside::Keep);
    EXPECT_EQ(by[2]->frame, frameOf({{0, 0, 0}, {1, 2, 3}}));
    EXPECT_EQ(std::get<FfdTransfer>(by[3]->kind).moves.at(7), (FfdTransfer::Move{{1, 1, 2}, true}));
    EXPECT_EQ((**by[3]->frame).edge[1], Vec3(1, 2, 0));
}

// ---- Bad scenes ---------------------------------------------------------------------------------------------------

struct BadScene {
    std::string text, pointer, cause, remedy;
};

std::string sceneOfField(const std::string& field) {
    return sceneWith(R"({"type": "fields", "opacity": )" + field + R"(, "color": [1, 1, 1]})");
}
std::string sceneOfShape(const std::string& shape) {
    return sceneWith(R"({"type": "solid", "shape": )" + shape + R"(, "color": [1, 1, 1], "opacity": 1})");
}
/// o0 is a volume, every other object the union of two of the one before.
std::string doublings(int n) {
    std::string objects = R"("o0": )" + kVolume;
    for (int i = 1; i < n; ++i) {
        const std::string use = R"({"use": "o)" + std::to_string(i - 1) + "\"}";
        objects += R"(, "o)" + std::to_string(i) + R"(": {"type": "union", "of": [)" + use + ", " + use + "]}";
    }
    return sceneWith(R"({"use": "o)" + std::to_string(n - 1) + "\"}", "\"objects\": {" + objects + "}, ");
}
/// `levels` objects within each other.
std::string nested(int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += R"({"type": "place", "of": )";
    return sceneWith(text + kVolume + std::string(std::size_t(levels), '}'));
}

std::vector<BadScene> badScenes() {
    const std::string tooDeep = [] {
        std::string objects;
        for (int i = 0; i < 2000; ++i) {
            const std::string of = i ? "{\"use\": \"o" + std::to_string(i - 1) + "\"}" : kVolume;
            objects += (i ? ", " : "") + ("\"o" + std::to_string(i)) + R"(": {"type": "place", "of": )" + of + "}";
        }
        return sceneWith(R"({"use": "o1999"})", "\"objects\": {" + objects + "}, ");
    }();
    return {
        {R"({"voledit": 2, "root": {"use": "a"}})", "/voledit", "format version 2", "understands 1"},
        {R"({"voledit": "1", "root": {"use": "a"}})", "/voledit", "format version \"1\"", ""},
        {R"({"root": {"use": "a"}})", "/", "\"voledit\": 1 is missing", ""},
        {"[]", "/", "found a list of 0, expected a scene", ""},
        {sceneWith(R"({"use": "skul"})", R"("objects": {"skull": )" + kVolume + "}, "), "/root/use",
         "no object \"skul\"", "did you mean \"skull\"?"},
        {transferBy(R"({"use": "pull"})"), "/root/by/use", "no transfer \"pull\"", "define it in `transfers`"},
        {sceneWith(R"({"type": "volume", "asset": "g"})"), "/root/asset", "no asset \"g\"", "did you mean \"h\"?"},
        {R"({"voledit": 1, "assets": {"m": {"kind": "motion", "path": "m.bvh"}},
             "root": {"type": "volume", "asset": "m"}})",
         "/root/asset", "not of kind \"volume\"", ""},
        {sceneWith(R"({"use": "a"})",
                   R"("objects": {"a": {"use": "b"}, "b": {"type": "place", "of": {"use": "a"}}}, )"),
         "/objects/a", "a cycle: it uses itself (a → b → a)", "break the circle"},
        {sceneWith(kVolume, R"("objects": {"a": {"use": "a"}}, )"), "/objects/a", "a cycle", ""},
        {transferBy(R"({"use": "s"})", R"("transfers": {"s": {"use": "t"}, "t": {"use": "s"}}, )"), "/transfers/s",
         "a cycle", ""},
        {tooDeep, "/objects/o", "deeper than 500 levels", "fewer levels"},
        {transferBy(R"({"type": "ffd", "cells": [1000, 1000, 1000]})"), "/root/by/cells", "1000000000 cells",
         "fewer cells"},
        {transferBy(R"([{"type": "ffd", "cells": [150, 150, 150]}, {"type": "ffd", "cells": [150, 150, 150]}])"),
         "/root/by/1/cells", "6750000 cells", ""},
        {transferBy(R"({"type": "ffd", "basis": "bspline", "points": [1000, 1000, 1000]})"), "/root/by",
         "control points", "fewer points"},
        {transferBy(R"({"type": "ffd", "move": [{"point": [4, 0, 0], "by": [0, 0, 1]}]})"), "/root/by/move/0/point/0",
         "control points 0 to 3 along x", ""},
        {transferBy(R"({"type": "ffd", "move": [{"point": [1, 0, 0], "by": [0, 0, 1]},
                                                {"point": [1, 0, 0], "to": [0, 0, 1]}]})"),
         "/root/by/move/1", "moved twice", "join"},
        {transferBy(R"({"type": "ffd", "control": [[0, 0, 0]]})"), "/root/by/control", "found a list of 1",
         "every control point"},
        {transferBy(R"({"type": "ffd", "frame": {"min": [0, 0, 0], "max": [1, 0, 1]}})"), "/root/by/frame",
         "not above its min along y", ""},
        {transferBy(
             R"({"type": "ffd", "frame": {"corner": [0, 0, 0], "x": [1, 0, 0], "y": [1, 0, 0], "z": [0, 0, 1]}})"),
         "/root/by/frame", "flat", "independent edges"},
        {transferBy(R"({"type": "affine", "scale": [1, 0, 1]})"), "/root/by", "flattens space", "scale"},
        {transferBy(R"({"type": "affine", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1]})"),
         "/root/by/matrix", "last row", "affine matrix"},
        {sceneWith(R"({"type": "place", "matrix": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1], "of": )" + kVolume +
                   "}"),
         "/root", "flattens space", "determinant"},
        {sceneWith(R"({"type": "volume", "asset": "h", "appearance": {"preset": "ct-bones"}})"),
         "/root/appearance/preset", "no appearance preset", "did you mean \"ct-bone\"?"},
        {sceneWith(R"({"type": "volume", "asset": "h", "appearance": {"opacity": [[1, 0], [0, 1]]}})"),
         "/root/appearance/opacity/1", "decrease", "sort"},
        {sceneWith(R"({"type": "volume", "asset": "h", "appearance": {"preset": "ct-bone", "opacity": [[0, 1]]}})"),
         "/root/appearance", "preset together with tables", "keep one"},
        {sceneWith(kVolume, R"("camera": {"eye": [0, 0, 0]}, )"), "/camera", "one point", "move"},
        {sceneWith(kVolume, R"("camera": {"up": [0, 0, 0]}, )"), "/camera/up", "vector 0", ""},
        {sceneWith(kVolume, R"("timeline": {"start": 10, "end": 10}, )"), "/timeline", "not after its start",
         "exclusive"},
        // Types of the contract that this version has not built.
        {sceneWith(R"({"type": "images", "asset": "h"})"), "/root", "\"images\" are not built yet in this version", ""},
        {transferBy(R"({"type": "skeleton", "skeleton": {"motion": "h"}, "limb": "arm"})"), "/root/by/skeleton/motion",
         "not of kind \"motion\"", "name one that is"},
        // Names.
        {transferBy(R"({"type": "fdd"})"), "/root/by/type", "no type of transfer that voledit knows",
         "did you mean \"ffd\"?"},
        {transferBy(R"({"type": "twits"})"), "/root/by/type", "no type of transfer", "did you mean \"twist\"?"},
        {transferBy(R"({"type": "wibblywobbly"})"), "/root/by/type", "no type of transfer", "use one of: expression"},
        {sceneWith(R"({"type": "displace", "by": {"use": "d"}, "of": )" + kVolume + "}"), "/root/by/use",
         "no displacement \"d\"", "define it in `displacements`"},
        {sceneOfField(R"({"component": "x", "of": {"use": "s"}})"), "/root/opacity/of/use", "no transfer \"s\"", ""},
        {sceneOfField(R"({"asset": "g"})"), "/root/opacity/asset", "no asset \"g\"", "did you mean \"h\"?"},
        {transferBy(R"({"type": "fields", "asset": "g"})"), "/root/by/asset", "no asset \"g\"", ""},
        // Circles through everything that holds something else.
        {sceneWith(kVolume, R"("objects": {"a": {"type": "fields", "opacity": {"attribute": "x", "of": {"type": "union",
             "of": [{"use": "b"}, {"use": "b"}]}}, "color": [0, 0, 0]}, "b": {"use": "a"}}, )"),
         "/objects/a", "a cycle: it uses itself (a → b → a)", ""},
        {sceneWith(kVolume, R"("transfers": {"s": {"type": "fields", "x": {"component": "x", "of": {"use": "t"}},
             "y": 0, "z": 0}, "t": {"type": "sequence", "of": [{"type": "affine"}, {"use": "s"}]}}, )"),
         "/transfers/s", "a cycle: it uses itself (s → t → s)", ""},
        {sceneWith(kVolume, R"("displacements": {"d": {"type": "scale", "by": {"attribute": "opacity", "of":
             {"use": "o"}}, "of": {"type": "of", "transfer": {"type": "affine"}}}}, "objects": {"o": {"type": "displace",
             "by": {"type": "sum", "of": [{"use": "d"}]}, "of": )" +
                                kVolume + "}}, "),
         "/displacements/d", "a cycle: it uses itself (d → o → d)", ""},
        {doublings(30), "/objects/o1", "more than 100000 nodes", "less often"},
        // Tracks.
        {sceneWith(kVolume, R"("opacityDistance": {"keys": [[1, 1], [0, 2]]}, )"), "/opacityDistance/keys/1/0",
         "found 0 after 1", "order"},
        {sceneWith(kVolume, R"("opacityDistance": {"keys": [[0, 1], [1, 0]]}, )"), "/opacityDistance/keys/1/1",
         "expected a number above 0", ""},
        {transferBy(R"({"type": "mapped", "points": {"keys": [[0, [[0, 0, 0]]], [1, []]]}, "source": [[0, 0, 0]],
             "cells": []})"),
         "/root/by/points/keys/1/1", "has 0 numbers, the first key's 3", "one length"},
        {transferBy(R"({"type": "ffd", "control": {"keys": [[0, [[0, 0, 0]]]]}})"), "/root/by/control",
         "found a list of 1", "every control point"},
        {transferBy(R"({"type": "affine", "scale": {"keys": [[0, 1], [2.5, 0]]}})"), "/root/by", "flattens space",
         "scale"},
        {transferBy(R"({"type": "ffd", "frame": {"min": [0, {"keys": [[0, 0], [3, 1]]}, 0], "max": [1, 1, 1]}})"),
         "/root/by/frame", "not above its min along y at 3 s", ""},
        {sceneWith(kVolume, R"("camera": {"target": {"keys": [[0, [0, 0, 0]], [1, [0, -400, 80]]]}}, )"), "/camera",
         "one point at 1 s", ""},
        // Shapes and mapped cells.
        {sceneOfShape(R"({"box": {"min": [0, 0, 0], "max": [1, 1, 0]}})"), "/root/shape/box", "along z", "size"},
        {sceneOfShape(R"({"cylinder": {"from": [1, 0, 0], "to": [1, 0, 0], "radius": 1}})"), "/root/shape/cylinder",
         "ends are one point", "move"},
        {sceneOfShape(R"({"torus": {"center": [0, 0, 0], "axis": [0, 0, 0], "major": 2, "minor": 1}})"),
         "/root/shape/torus/axis", "vector 0", ""},
        {transferBy(R"({"type": "mapped", "points": [[0, 0, 0]], "source": [], "cells": []})"), "/root/by/source",
         "0 vectors, `points` 1", ""},
        {transferBy(R"({"type": "mapped", "points": [[0, 0, 0]], "source": [[0, 0, 0]],
             "cells": [[0, 0, 0, 0, 0, 0, 0, 1]]})"),
         "/root/by/cells/0/7", "vertex 1 of 1", "from 0"},
        // Formula files' arguments.
        {transferBy(R"({"type": {"file": "ripple.stf"}, "height": true})"), "/root/by/height", "expected a number", ""},
        {transferBy(R"({"type": {"file": "ripple.stf"}, "height": [1]})"), "/root/by/height", "two or more", ""},
        {transferBy(R"({"type": {"file": "ripple.stf"}, "along": "up"})"), "/root/by/along", "\"x\", \"y\", \"z\"", ""},
        {transferBy(R"({"type": {"file": "/etc/ripple.stf"}})"), "/root/by/type/file", "absolute", "--allow-outside"},
        // Formulas.
        {sceneOfField(R"({"expression": "x + wobble"})"), "/root/opacity/expression", "wobble", ""},
        {sceneOfField(R"({"expression": "x +"})"), "/root/opacity/expression", "", "^"},
        {sceneOfShape(R"({"expression": {"d": "d"}})"), "/root/shape/expression/d", "'d' has no meaning", "^"},
        {transferBy(R"({"type": "expression", "x": "a", "y": "y", "z": "x && y"})"), "/root/by/x", "'a' has no meaning",
         "^"},
        {transferBy(R"({"type": "expression", "x": "x", "y": "y", "z": "z", "let": [["a", "b"]]})"), "/root/by/let/0/1",
         "'b' has no meaning", "^"},
        {sceneOfField(R"({"expression": ")" + std::string(1'000'000, '1') + R"("})"), "/root/opacity/expression",
         "characters", ""},
        {sceneOfField(R"({"expression": ")" + std::string(40'000, '(') + "x" + std::string(40'000, ')') + R"("})"),
         "/root/opacity/expression", "deep", ""},
        {nested(10'000), "/root/of/of", "deep", ""},
    };
}

TEST(BadScenes, AreRefusedWithFilePlaceCauseAndRemedy) {
    for (const auto& [text, pointer, cause, remedy] : badScenes()) {
        try {
            read(text);
            ADD_FAILURE() << "accepted: " << text.substr(0, 300);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), testing::StartsWith(kPath.string() + ": " + pointer));
            EXPECT_THAT(error.what(), AllOf(HasSubstr(cause), HasSubstr(remedy)));
        }
    }
}

TEST(SharedNodes, AreCountedAsOftenAsTheyAreUsed) {
    EXPECT_NO_THROW(read(doublings(16))) << "65,535 nodes";
    EXPECT_THROW(read(doublings(17)), Error);
}

TEST(BadScenes, HalfOfAnyFileIsAnErrorNotACrash) {
    const std::string text = transferBy(R"([{"use": "p"}, {"type": "affine", "scale": [1, 2, 3]}])",
                                        R"("transfers": {"p": {"type": "ffd", "control": []}}, )");
    for (std::size_t n = 0; n < text.size(); ++n) EXPECT_THROW(read(text.substr(0, n)), Error) << n;
}

TEST(BadScenes, DamagedBytesAreAnErrorOrASceneNeverACrash) {
    const std::string text =
        transferBy(R"([{"type": "ffd", "degree": [2, 2, 2], "move": [{"point": [1, 1, 1], "by": [1, 2, 3]}]}])",
                   R"("camera": {"eye": [1, 2, 3]}, "render": {"light": [1, 0, 0]}, )");
    std::mt19937 random(3);
    int refused = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        std::string damaged = text;
        for (int n = 0; n < 1 + trial % 3; ++n)
            damaged[random() % damaged.size()] =
                trial % 2 ? char(random() % 256) : "0123456789.-eE[]{}\",: "[random() % 22];
        try {
            read(damaged);
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 10'000);
}

// ---- Assets' paths ------------------------------------------------------------------------------------------------

std::string sceneOfPath(const std::string& path) {
    return json{
        {"voledit", 1}, {"assets", {{"h", {{"kind", "volume"}, {"path", path}}}}}, {"root", json::parse(kVolume)}}
        .dump();
}

TEST(AssetPaths, StayAtOrBelowTheScenesFolder) {
    const fs::path folder = test::scratchFolder();
    fs::create_directory(folder / "scenes");
    std::ofstream(folder / "outside.nrrd") << "x";
    fs::create_symlink(folder / "outside.nrrd", folder / "scenes" / "link.nrrd");
    fs::create_symlink(folder, folder / "scenes" / "up");
    const fs::path scene = folder / "scenes" / "s.voledit";
    for (const char* good : {"a.nrrd", "deep/er/a.nrrd", "./a.nrrd", "slices_%03d.png", "..a", "."})
        EXPECT_NO_THROW(sceneFromJson(sceneOfPath(good), scene)) << good;
    for (const char* bad : {"../outside.nrrd", "deep/../../x", "..", "/etc/passwd", "link.nrrd", "up/outside.nrrd"}) {
        EXPECT_THAT([&] { sceneFromJson(sceneOfPath(bad), scene); },
                    ThrowsMessage<Error>(AllOf(HasSubstr("/assets/h/path"), HasSubstr("--allow-outside"))))
            << bad;
        EXPECT_NO_THROW(sceneFromJson(sceneOfPath(bad), scene, {.allowOutside = true})) << bad;
    }
    EXPECT_THROW(sceneFromJson(sceneOfPath(std::string("a\0b", 3)), scene, {.allowOutside = true}), Error);
}

TEST(AssetPaths, OfScenesInResourcesReachAllOfResources) {
    const fs::path scene = resourceFolder() / "scenes" / "s.voledit";
    EXPECT_NO_THROW(sceneFromJson(sceneOfPath("../volumes/a.nrrd"), scene));
    EXPECT_THROW(sceneFromJson(sceneOfPath("../../a.nrrd"), scene), Error);
    EXPECT_THROW(sceneFromJson(sceneOfPath("/etc/passwd"), scene), Error);
}

TEST(AssetPath, IsSeenFromTheScenesFolder) {
    EXPECT_EQ(assetPath({AssetKind::Volume, "a/../b.nrrd"}, "/data"), "/data/b.nrrd");
    EXPECT_EQ(assetPath({AssetKind::Volume, "/x/b.nrrd"}, "/data"), "/x/b.nrrd");
}

// ---- There and back -----------------------------------------------------------------------------------------------

TEST(SceneToJson, GivesEqualScenesBack) {
    test::RandomScenes scenes(17);
    for (int trial = 0; trial < 300; ++trial) {
        const Scene scene = scenes.next();
        const std::string text = sceneToJson(scene);
        ASSERT_EQ(read(text), scene) << text;
        ASSERT_EQ(sceneToJson(read(text)), text);
    }
}

TEST(SceneToJson, KeepsTheContractsOrderAndForms) {
    Scene scene = sceneOfVolume("h.nrrd", "h", "ct-bone");
    addLattice(scene, "pull", {}, frameOf({{0, 0, 0}, {1, 2, 3}}));
    moveControlPoints(scene, "pull", {63}, {20, 0, 10});
    scene.opacityDistance = 1;
    scene.camera = Camera{};
    const std::string text = sceneToJson(scene);
    std::size_t last = 0;
    for (const char* member : {"\"voledit\"", "\"assets\"", "\"objects\"", "\"transfers\"", "\"root\"",
                               "\"opacityDistance\"", "\"camera\"", "\"render\"", "\"timeline\""}) {
        const std::size_t at = text.find(member);
        ASSERT_NE(at, std::string::npos) << member;
        EXPECT_GT(at, last) << member;
        last = at;
    }
    EXPECT_THAT(text, HasSubstr(R"("move": [{ "point": [3, 3, 3], "by": [20, 0, 10] }])"));
    EXPECT_THAT(text, HasSubstr(R"("frame": { "min": [0, 0, 0], "max": [1, 2, 3] })"));
    EXPECT_THAT(text, testing::Not(HasSubstr("control")));
    auto& ffd = std::get<FfdTransfer>(scene.transfers.at("pull").edit().kind);
    for (std::size_t i = 0; i < 64; ++i) ffd.moves[i] = {Vec3(double(i)), true};
    EXPECT_THAT(sceneToJson(scene), AllOf(HasSubstr("\"control\""), testing::Not(HasSubstr("\"move\""))));
}

// ---- Files --------------------------------------------------------------------------------------------------------

TEST(LoadScene, NamesFilesThatCannotBeRead) {
    const fs::path folder = test::scratchFolder();
    EXPECT_THAT([&] { loadScene(folder / "none.voledit"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("none.voledit"), HasSubstr("no such file"))));
    EXPECT_THAT([&] { loadScene(folder); }, ThrowsMessage<Error>(HasSubstr("not a file")));
    EXPECT_THAT([&] { loadScene("/dev/zero"); }, ThrowsMessage<Error>(HasSubstr("not a file")));
    std::ofstream(folder / "empty.voledit");
    EXPECT_THAT([&] { loadScene(folder / "empty.voledit"); }, ThrowsMessage<Error>(HasSubstr("empty")));
    std::ofstream(folder / "big.voledit");
    fs::resize_file(folder / "big.voledit", std::uintmax_t(300) << 20);
    EXPECT_THAT([&] { loadScene(folder / "big.voledit"); }, ThrowsMessage<Error>(HasSubstr("300 MiB")));
    std::ofstream(folder / "binary.voledit") << std::string(1000, '\x01');
    EXPECT_THAT([&] { loadScene(folder / "binary.voledit"); }, ThrowsMessage<Error>(HasSubstr("not JSON")));
}

TEST(SaveScene, ReadsBackAndRewritesPathsForTheNewFolder) {
    const fs::path folder = test::scratchFolder();
    fs::create_directories(folder / "scenes" / "data");
    const Scene scene = sceneOfVolume("data/h.nrrd", "h", "ct-bone");
    saveScene(scene, folder / "scenes" / "s.voledit", folder / "scenes");
    EXPECT_EQ(loadScene(folder / "scenes" / "s.voledit"), scene);

    saveScene(scene, folder / "above.voledit", folder / "scenes");
    EXPECT_EQ(loadScene(folder / "above.voledit").assets.at("h").path, "scenes/data/h.nrrd");

    const fs::path elsewhere = test::scratchFolder();
    saveScene(scene, elsewhere / "s.voledit", folder / "scenes");
    const Scene outside = loadScene(elsewhere / "s.voledit", {.allowOutside = true});
    EXPECT_EQ(outside.assets.at("h").path, (folder / "scenes/data/h.nrrd").string());
    saveScene(outside, elsewhere / "s.voledit", elsewhere);
    EXPECT_EQ(loadScene(elsewhere / "s.voledit", {.allowOutside = true}), outside) << "outside paths are kept";
    saveScene(outside, folder / "back.voledit", elsewhere);
    EXPECT_EQ(loadScene(folder / "back.voledit").assets.at("h").path, "scenes/data/h.nrrd");
}

TEST(SaveScene, RewritesPathsOfFormulaFilesWhereverTheyAre) {
    const fs::path folder = test::scratchFolder();
    fs::create_directories(folder / "scenes");
    const std::string text =
        transferBy(R"({"type": "sequence", "of": [{"type": {"file": "ripple.stf"}, "height": 2}]})",
                   R"("transfers": {"t": {"type": {"file": "deep/wave.stf"}}}, )");
    const Scene scene = sceneFromJson(text, folder / "scenes" / "s.voledit");
    saveScene(scene, folder / "above.voledit", folder / "scenes");
    const std::string above = sceneToJson(loadScene(folder / "above.voledit"));
    EXPECT_THAT(above, AllOf(HasSubstr("\"scenes/ripple.stf\""), HasSubstr("\"scenes/deep/wave.stf\"")));
    EXPECT_THAT([&] { sceneFromJson(transferBy(R"({"type": {"file": "../ripple.stf"}})"), kPath); },
                ThrowsMessage<OutsideFolderError>(HasSubstr("/root/by/type/file")));
}

TEST(SaveScene, KeepsPathsWithDotsInTheirOwnFolder) {
    const fs::path folder = test::scratchFolder();
    const Scene scene = sceneOfVolume("../h.nrrd", "h", "");
    saveScene(scene, folder / "s.voledit", folder);
    EXPECT_EQ(loadScene(folder / "s.voledit", {.allowOutside = true}), scene);
}

TEST(SaveScene, AFailureLeavesTheOldFileAndNothingBeside) {
    const fs::path folder = test::scratchFolder();
    Scene scene = sceneOfVolume("h.nrrd", "h", "");
    saveScene(scene, folder / "s.voledit", folder);
    Scene wrong = scene;
    wrong.opacityDistance = kNaN;
    EXPECT_THROW(saveScene(wrong, folder / "s.voledit", folder), Error);
    EXPECT_EQ(loadScene(folder / "s.voledit"), scene);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
    EXPECT_THAT([&] { saveScene(scene, folder / "none" / "s.voledit", folder); },
                ThrowsMessage<Error>(HasSubstr("folder does not exist")));
    EXPECT_THAT([&] { saveScene(scene, folder, folder); }, ThrowsMessage<Error>(HasSubstr("it is a folder")));
}

TEST(SaveScene, KeepsPermissionsAndLinks) {
    const fs::path folder = test::scratchFolder();
    const Scene scene = sceneOfVolume("h.nrrd", "h", "");
    saveScene(scene, folder / "s.voledit", folder);
    fs::permissions(folder / "s.voledit", fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink(folder / "s.voledit", folder / "link.voledit");
    saveScene(sceneOfVolume("other.nrrd", "h", ""), folder / "link.voledit", folder);
    EXPECT_TRUE(fs::is_symlink(folder / "link.voledit"));
    EXPECT_EQ(loadScene(folder / "s.voledit").assets.at("h").path, "other.nrrd");
    EXPECT_EQ(fs::status(folder / "s.voledit").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

}  // namespace
}  // namespace voledit
