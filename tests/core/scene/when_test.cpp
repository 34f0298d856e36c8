#include "core/scene/when.h"

#include <gmock/gmock.h>

#include "core/scene/edits.h"
#include "core/scene/scene_json.h"

namespace voledit {
namespace {

using testing::ElementsAre;

Tracked<double> ramp() {
    Tracked<double> value = 0.0;
    value.setTracks({{PartTrack::kWhole, Track{{{0, {0}}, {1, {10}}}}}});
    return value;
}

TEST(When, AtAllTimesTheKeysGo) {
    Tracked<double> value = ramp();
    setWhen(value, 3.0, {});
    EXPECT_FALSE(value.animated());
    EXPECT_EQ(*value, 3);
}

TEST(When, AtATimeAnAnimatedValueGetsAKey) {
    Tracked<double> value = ramp();
    setWhen(value, 7.0, {0.5, false});
    EXPECT_EQ(value.at(0.5), 7);
    EXPECT_EQ(value.at(0), 0);
    EXPECT_EQ(value.at(1), 10);
    EXPECT_EQ(value.at(0.25), 3.5);
}

TEST(When, AKeyOfNearlyThatTimeIsThatKey) {
    Tracked<double> value = ramp();
    setWhen(value, 7.0, {1 - 1e-9, false});
    ASSERT_EQ(value.tracks()[0].track.keys.size(), 2u);
    EXPECT_EQ(value.at(1), 7);
}

TEST(When, OnlyAutoKeyAnimatesWhatIsNot) {
    Tracked<Vec3> value{Vec3(1)};
    setWhen(value, Vec3(2), {0.5, false});
    EXPECT_FALSE(value.animated());
    EXPECT_EQ(*value, Vec3(2));
    setWhen(value, Vec3(3), {0.5, true});
    ASSERT_TRUE(value.animated());
    EXPECT_EQ(value.tracks()[0].track.keys[0].time, 0.5);
    EXPECT_EQ(value.at(9), Vec3(3));
}

TEST(When, OfAValueWithAnAnimatedPartTheOthersChangeForAllTimes) {
    Tracked<Vec3> value{Vec3(0)};
    value.setTracks({{1, Track{{{0, {0}}, {1, {10}}}}}});
    setWhen(value, Vec3(5, 4, 3), {1, false});
    EXPECT_EQ(value.at(1), Vec3(5, 4, 3));
    EXPECT_EQ(value.at(0), Vec3(5, 0, 3));
}

TEST(When, ControlPointsThatHaveKeysMoveAtThatTimeAlone) {
    Scene scene = sceneFromJson(R"({ "voledit": 1, "transfers": { "pull": { "type": "ffd",
          "frame": { "min": [0,0,0], "max": [1,1,1] },
          "move": [{ "point": [0,0,0], "by": { "keys": [[0, [0,0,0]], [2, [4,0,0]]] } }] } },
        "root": { "type": "transfer", "by": [{ "use": "pull" }], "of": { "type": "solid", "color": [1,1,1],
                  "opacity": 1, "shape": { "sphere": { "center": [0,0,0], "radius": 1 } } } } })",
                                "test.voledit");
    const auto move = [&](std::size_t point) {
        return std::get<FfdTransfer>(findTransfer(scene, "pull")->kind).moves.at(point).vector;
    };
    moveControlPoints(scene, "pull", {0, 5}, Vec3(0, 1, 0), {1, false});
    EXPECT_EQ(move(0).at(0), Vec3(0));
    EXPECT_EQ(move(0).at(1), Vec3(2, 1, 0));
    EXPECT_EQ(move(0).at(2), Vec3(4, 0, 0));
    EXPECT_FALSE(move(5).animated());
    moveControlPoints(scene, "pull", {6}, Vec3(0), {1, true});  // a key at rest
    EXPECT_TRUE(move(6).animated());
    moveControlPoints(scene, "pull", {0}, Vec3(0, 0, 1));  // at every time
    EXPECT_EQ(move(0).at(0), Vec3(0, 0, 1));
    EXPECT_EQ(move(0).at(1), Vec3(2, 1, 1));
}

TEST(When, SettingsKeepTheKeysOfWhatStaysTheSame) {
    Scene scene;
    scene.render.ambient.setTracks({{PartTrack::kWhole, Track{{{0, {0.1}}, {1, {0.3}}}}}});
    RenderSettings now = scene.render;
    now.ambient = 0.2;  // as it is at 0.5 s
    now.diffuse = 0.9;
    setRenderSettings(scene, now, {0.5, false});
    EXPECT_THAT(scene.render.ambient.tracks()[0].track.keys.size(), 2u);
    EXPECT_EQ(*scene.render.diffuse, 0.9);
    EXPECT_FALSE(scene.render.diffuse.animated());
    now.ambient = 0.7;
    setRenderSettings(scene, now, {0.5, false});
    EXPECT_EQ(scene.render.ambient.at(0.5), 0.7);
    EXPECT_EQ(scene.render.ambient.at(0), 0.1);
}

}  // namespace
}  // namespace voledit
