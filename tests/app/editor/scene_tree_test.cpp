#include "app/editor/scene_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/scene_json.h"

namespace voledit {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Scene sceneOf(const std::string& members) {
    return sceneFromJson("{ \"voledit\": 1, " + members + " }", "test.voledit");
}

/// "depth label" of every row.
std::vector<std::string> outline(const Scene& scene, const std::set<std::string>& closed = {}) {
    std::vector<std::string> lines;
    for (const SceneRow& row : sceneRows(scene, closed)) lines.push_back(std::to_string(row.depth) + " " + row.label);
    return lines;
}

constexpr const char* kSphere = R"({ "type": "solid", "shape": { "sphere": { "center": [0,0,0], "radius": 1 } },
    "color": [1,1,1], "opacity": 1 })";

const std::string kTwisted = R"("objects": { "ball": )" + std::string(kSphere) + R"( },
    "transfers": { "turn": { "type": "twist", "axis": "z", "angle": 30 },
                   "spare": { "type": "split", "axis": "x", "gap": 0.1 } },
    "root": { "type": "transfer", "by": [ { "use": "turn" }, { "type": "affine", "translate": [1, 0, 0] } ],
              "of": { "type": "union", "of": [ { "use": "ball" }, { "use": "ball" } ] } })";

TEST(SceneTree, RowsFollowTheFileAndUnusedOnesComeLast) {
    EXPECT_THAT(outline(sceneOf(kTwisted)),
                ElementsAre("0 Transfer", "1 turn", "1 Affine", "1 Union", "2 ball", "2 ball", "0 spare"));
}

TEST(SceneTree, PathsAreThoseOfTheFileAndUsesKnowWhatTheyName) {
    const Scene scene = sceneOf(kTwisted);
    const std::vector<SceneRow> rows = sceneRows(scene, {});
    const SceneRow* turn = rowAt(rows, "/root/by/0");
    ASSERT_NE(turn, nullptr);
    EXPECT_TRUE(turn->link);
    EXPECT_EQ(turn->target, "/transfers/turn");
    EXPECT_EQ(turn->on, true);
    EXPECT_EQ(turn->detail, "Twist");
    EXPECT_FALSE(turn->repeated);
    const SceneRow* second = rowAt(rows, "/root/of/of/1");
    ASSERT_NE(second, nullptr);
    EXPECT_TRUE(second->repeated);
    EXPECT_EQ(second->widget, "ball 2");
    EXPECT_TRUE(rows.back().unused);
    EXPECT_FALSE(rows.front().unused);
    EXPECT_EQ(rowAt(rows, "/root/nothing"), nullptr);
}

TEST(SceneTree, ClosedRowsHideWhatIsBelowButDoNotMakeItUnused) {
    EXPECT_THAT(outline(sceneOf(kTwisted), {"/root/of"}),
                ElementsAre("0 Transfer", "1 turn", "1 Affine", "1 Union", "0 spare"));
    EXPECT_THAT(outline(sceneOf(kTwisted), {"/root"}), ElementsAre("0 Transfer", "0 spare"));
}

TEST(SceneTree, WhatUnusedOnesUseStandsBelowThem) {
    const Scene scene =
        sceneOf(R"("objects": { "a": )" + std::string(kSphere) +
                R"(, "b": { "type": "place", "translate": [1,0,0], "of": { "use": "a" } } }, "root": )" + kSphere);
    EXPECT_THAT(outline(scene), ElementsAre("0 Sphere", "0 b", "1 a"));
}

TEST(SceneTree, DisplacementsAndCompoundFieldsHaveRows) {
    const Scene scene = sceneOf(R"("transfers": { "turn": { "type": "twist", "axis": "z", "angle": 30,
            "frame": { "min": [-1,-1,-1], "max": [1,1,1] } } },
        "root": { "type": "displace",
          "by": { "type": "blend", "weight": { "component": "x", "of": { "use": "turn" } },
                  "of": [ { "type": "of", "transfer": { "use": "turn" } },
                          { "type": "scale", "by": 0.5, "of": { "type": "fields", "x": 1, "y": 0, "z": 0 } } ] },
          "of": )" + std::string(kSphere) +
                                "}");
    EXPECT_THAT(outline(scene), ElementsAre("0 Displace", "1 Blend", "2 weight: x of", "3 turn", "2 Displacement of",
                                            "3 turn", "2 Scale", "3 Fields", "1 Sphere"));
}

TEST(SceneTree, DeepTermsStopAtTheDeepestRow) {
    Object object{SolidObject{}};
    for (int n = 0; n < 300; ++n) object = Object{PlaceObject{{}, ObjectRef(std::move(object))}};
    Scene scene;
    scene.root = ObjectRef(std::move(object));
    EXPECT_EQ(sceneRows(scene, {}).size(), std::size_t(kDeepestRow) + 1);
}

}  // namespace
}  // namespace voledit
