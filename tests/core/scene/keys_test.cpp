#include "core/scene/keys.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "core/base/error.h"
#include "core/scene/scene_at.h"
#include "core/scene/scene_json.h"
#include "tests/core/scene/compiled_json.h"
#include "tests/core/scene/random_scenes.h"

namespace voledit::test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;
using Interpolation = Track::Interpolation;

Scene bent() {
    return sceneOf(transfer(R"([{"use": "bend"}, {"use": "pull"}])",
                            R"({"type": "place", "translate": [1, 2, 3], "of": {"use": "head"}})"),
                   R"("assets": {"v": {"kind": "volume", "path": "v.nrrd"}},
           "objects": {"head": {"type": "volume", "asset": "v", "appearance": {"opacity": [[0, 0], [1, 1]]}}},
           "transfers": {"bend": {"type": "bend", "axis": "z", "toward": "x", "angle": 30, "range": [0, 0.5],
                                  "frame": {"min": [0, 0, 0], "max": [1, 1, 1]}},
                         "pull": {"type": "ffd", "move": [{"point": [0, 3, 0], "by": [1, 0, 0]}]},
                         "in": {"type": "insideOut", "line": {"point": [0, 0, 0], "direction": [0, 0, 1]}, "radius": 2},
                         "k": {"type": "fields", "x": {"map": [[0, 0]], "of": 7}, "y": 3, "z": 0}},
           "camera": {"eye": [0, -5, 0], "target": [0, 0, 0]}, )");
}

TEST(KeyableValues, AreFoundWhereverTheyStand) {
    const Scene scene = bent();
    const auto numbers = [&](const ValuePath& path) {
        const auto value = valueAt(scene, path);
        EXPECT_TRUE(value) << path;
        return value ? value->numbers : std::vector<double>{};
    };
    EXPECT_THAT(numbers("/transfers/bend/angle"), ElementsAre(30));
    EXPECT_THAT(numbers("/transfers/bend/range"), ElementsAre(0, 0.5));
    EXPECT_THAT(numbers("/transfers/bend/amount"), ElementsAre(1));
    EXPECT_THAT(numbers("/transfers/bend/frame/max"), ElementsAre(1, 1, 1));
    EXPECT_THAT(numbers("/transfers/pull/move/12/by"), ElementsAre(1, 0, 0));
    EXPECT_THAT(numbers("/transfers/in/line/direction"), ElementsAre(0, 0, 1));
    EXPECT_THAT(numbers("/transfers/k/y"), ElementsAre(3)) << "a number that is a field";
    EXPECT_THAT(numbers("/transfers/k/x/map"), ElementsAre(0, 0));
    EXPECT_THAT(numbers("/root/of/translate"), ElementsAre(1, 2, 3));
    EXPECT_THAT(numbers("/objects/head/appearance/opacity"), ElementsAre(0, 0, 1, 1));
    EXPECT_THAT(numbers("/camera/eye"), ElementsAre(0, -5, 0));
    EXPECT_THAT(numbers("/render/ambient"), ElementsAre(0.3));
    for (const char* none : {"", "/", "/root", "/root/of/turn", "/transfers/bend/angle/", "/transfers/bend//angle",
                             "/transfers/pull/move/11/by", "/camera", "/eye", "/opacityDistance", "/transfers/none/at"})
        EXPECT_FALSE(valueAt(scene, none)) << none;
    EXPECT_EQ(valueAt(scene, "/transfers/bend/angle")->node, "/transfers/bend");
    EXPECT_EQ(valueAt(scene, "/camera/eye")->node, "");
    Scene without = scene;
    without.camera.reset();
    EXPECT_FALSE(valueAt(without, "/camera/eye"));
}

TEST(KeyableValues, HaveLabelsForPeople) {
    const Scene scene = bent();
    EXPECT_EQ(valueAt(scene, "/transfers/bend/angle")->label, "bend · angle");
    EXPECT_EQ(valueAt(scene, "/transfers/bend/frame/max")->label, "bend · frame max");
    EXPECT_EQ(valueAt(scene, "/transfers/pull/move/12/by")->label, "pull · point 12");
    EXPECT_EQ(valueAt(scene, "/objects/head/appearance/opacity")->label, "head · opacity");
    EXPECT_EQ(valueAt(scene, "/root/of/translate")->label, "place · translate");
    EXPECT_EQ(valueAt(scene, "/transfers/k/y")->label, "k · y");
    EXPECT_EQ(valueAt(scene, "/camera/eye")->label, "camera · eye");
    const Scene walker = sceneOf(R"({"type": "actor", "of": )" + kBox + R"(, "skeleton": {"joints":
        [{"name": "Left/Arm", "parent": null, "at": [0, 0, 0]}]}})");
    const auto joint = valueAt(walker, "/root/skeleton/joints/Left~1Arm/rotate");
    ASSERT_TRUE(joint);
    EXPECT_EQ(joint->label, "actor · Left/Arm rotate");
}

TEST(KeyableValues, OfANodeAreThoseOfItself) {
    const Scene scene = bent();
    std::vector<ValuePath> paths;
    for (const KeyableValue& value : valuesOf(scene, "/root/of")) paths.push_back(value.path);
    EXPECT_THAT(paths, ElementsAre("/root/of/translate", "/root/of/rotate", "/root/of/scale"));
    EXPECT_TRUE(valuesOf(scene, "/root/nothing").empty());
    EXPECT_FALSE(valuesOf(scene, "").empty());
}

TEST(KeyableValues, EveryOneOfAnySceneIsFoundByItsPath) {
    RandomScenes random(31);
    std::size_t found = 0;
    for (int n = 0; n < 25; ++n) {
        const Scene scene = random.next();
        const auto values = animatedValues(scene);
        for (const KeyableValue& value : values) {
            const auto again = valueAt(scene, value.path);
            ASSERT_TRUE(again) << value.path;
            EXPECT_EQ(again->numbers, value.numbers) << value.path;
            EXPECT_TRUE(again->animated);
            EXPECT_FALSE(keysOf(scene, value.path).empty()) << value.path;
            EXPECT_FALSE(value.label.empty());
            ++found;
        }
        EXPECT_EQ(values.empty(), !hasTracks(scene));
    }
    EXPECT_GT(found, 200u);
}

TEST(Keys, SetIsWhatIsShownThen) {
    RandomScenes random(37);
    std::mt19937 numbers(1);
    for (int n = 0; n < 12; ++n) {
        Scene scene = random.next();
        for (const KeyableValue& value : animatedValues(scene)) {
            const double t = std::uniform_real_distribution<double>(-20, 20)(numbers);
            std::vector<double> wanted = numbersAt(scene, value.path, t);
            for (double& w : wanted) w += 1.0 / 1024;
            if (wanted.size() != value.numbers.size()) continue;
            setKey(scene, value.path, t, wanted);
            EXPECT_EQ(numbersAt(scene, value.path, t), wanted) << value.path;
        }
    }
}

TEST(Keys, BetweenTwoKeepTheShapeOfLinearOnes) {
    Scene scene = bent();
    const ValuePath path = "/transfers/bend/angle";
    setKey(scene, path, 0, {10});
    setKey(scene, path, 2, {50});
    EXPECT_THAT(numbersAt(scene, path, 1), ElementsAre(30));
    setKey(scene, path, 0.5);
    EXPECT_THAT(keysOf(scene, path), ElementsAre(KeyMark{0, Interpolation::Linear}, KeyMark{0.5, Interpolation::Linear},
                                                 KeyMark{2, Interpolation::Linear}));
    for (double t = -1; t < 3; t += 0.125)
        EXPECT_THAT(numbersAt(scene, path, t), ElementsAre(DoubleNear(10 + 20 * std::clamp(t, 0.0, 2.0), 1e-12)));
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);
}

TEST(Keys, BetweenTwoGoOnAsTheOneBefore) {
    Scene scene = bent();
    const ValuePath path = "/camera/eye";
    setKey(scene, path, 0, {1, 0, 0});
    setKey(scene, path, 2, {3, 0, 0});
    setInterpolation(scene, {path, 0}, Interpolation::Step);
    setKey(scene, path, 1);
    EXPECT_THAT(keysOf(scene, path), ElementsAre(KeyMark{0, Interpolation::Step}, KeyMark{1, Interpolation::Step},
                                                 KeyMark{2, Interpolation::Linear}));
    EXPECT_THAT(numbersAt(scene, path, 1.5), ElementsAre(1, 0, 0));
    EXPECT_EQ(sceneFromJson(sceneToJson(scene), "/scene.voledit"), scene);
}

TEST(Keys, TheFirstGivesAValueItsTrackAndTheLastTakesIt) {
    const Scene before = bent();
    for (const ValuePath path : {"/transfers/bend/angle", "/transfers/bend/frame/min", "/transfers/pull/move/12/by",
                                 "/transfers/in/line/point", "/transfers/k/y", "/root/of/translate", "/render/ambient",
                                 "/objects/head/appearance/opacity", "/transfers/bend/amount"}) {
        Scene scene = before;
        setKey(scene, path, 1.25);
        EXPECT_EQ(animatedValues(scene).size(), 1u) << path;
        EXPECT_THAT(keysOf(scene, path), ElementsAre(KeyMark{1.25, Interpolation::Linear}));
        removeKey(scene, path, 1.25);
        EXPECT_EQ(scene, before) << path;
        setKey(scene, path, 1);
        auto other = numbersAt(scene, path, 1);
        other[0] += 0.25;
        setKey(scene, path, 2, other);
        clearKeys(scene, path, 1.5);
        EXPECT_TRUE(keysOf(scene, path).empty());
        EXPECT_NEAR(valueAt(scene, path)->numbers[0], valueAt(before, path)->numbers[0] + 0.125, 1e-12) << path;
    }
}

TEST(Keys, RemovingTheLastLeavesItsValue) {
    Scene scene = bent();
    const ValuePath path = "/transfers/bend/angle";
    setKey(scene, path, 0, {10});
    setKey(scene, path, 1, {20});
    removeKey(scene, path, 0);
    EXPECT_THAT(numbersAt(scene, path, -5), ElementsAre(20));
    removeKey(scene, path, 7);  // there is none
    removeKey(scene, path, 1 + 1e-9);
    EXPECT_THAT(valueAt(scene, path)->numbers, ElementsAre(20));
    EXPECT_FALSE(valueAt(scene, path)->animated);
}

TEST(Keys, MoveAndCopyTogether) {
    Scene scene = bent();
    const ValuePath angle = "/transfers/bend/angle", eye = "/camera/eye";
    for (int k = 0; k < 4; ++k) setKey(scene, angle, k, {double(10 * k)});
    setKey(scene, eye, 1, {1, 1, 1});
    setInterpolation(scene, {angle, 1}, Interpolation::Smooth);
    Scene moved = scene;
    const auto now = moveKeys(moved, {{angle, 1}, {angle, 2}, {eye, 1}, {angle, 9}}, 1, false);
    EXPECT_THAT(now, ElementsAre(KeyRef{angle, 2}, KeyRef{angle, 3}, KeyRef{eye, 2}));
    EXPECT_THAT(keysOf(moved, angle), ElementsAre(KeyMark{0, Interpolation::Linear}, KeyMark{2, Interpolation::Smooth},
                                                  KeyMark{3, Interpolation::Linear}));
    EXPECT_THAT(numbersAt(moved, angle, 2), ElementsAre(10));
    EXPECT_THAT(numbersAt(moved, angle, 3), ElementsAre(20)) << "what was there is replaced";
    EXPECT_THAT(keysOf(moved, eye), ElementsAre(KeyMark{2, Interpolation::Linear}));

    Scene copied = scene;
    moveKeys(copied, {{angle, 0}, {angle, 1}}, 4, true);
    EXPECT_EQ(keysOf(copied, angle).size(), 6u);
    EXPECT_THAT(numbersAt(copied, angle, 5), ElementsAre(10));
    EXPECT_THAT(numbersAt(copied, angle, 1), ElementsAre(10));

    Scene back = moved = scene;
    moveKeys(moved, {{angle, 0}, {angle, 1}, {angle, 2}, {angle, 3}}, 0.75, false);
    moveKeys(moved, {{angle, 0.75}, {angle, 1.75}, {angle, 2.75}, {angle, 3.75}}, -0.75, false);
    EXPECT_EQ(moved, back);
}

TEST(Keys, OfPartsAreOneRow) {
    Scene scene = sceneOf(R"({"type": "place", "translate": [{"keys": [[0, 0], [2, 2]]}, 5,
        {"keys": [[1, 1], [2, 3]], "interpolation": "step"}], "of": )" +
                          kBox + "}");
    const ValuePath path = "/root/translate";
    EXPECT_THAT(keysOf(scene, path), ElementsAre(KeyMark{0, Interpolation::Linear}, KeyMark{1, Interpolation::Step},
                                                 KeyMark{2, Interpolation::Step}));
    EXPECT_THAT(numbersAt(scene, path, 1), ElementsAre(1, 5, 1));
    moveKeys(scene, {{path, 2}}, 2, false);
    EXPECT_THAT(numbersAt(scene, path, 4), ElementsAre(2, 5, 3));
    removeKey(scene, path, 1);
    removeKey(scene, path, 4);
    EXPECT_THAT(numbersAt(scene, path, 9), ElementsAre(0, 5, 3)) << "the last key of z leaves its value";
}

TEST(Keys, AtAJumpBothGoTogetherAndTheSecondIsSet) {
    Scene scene = sceneOf(R"({"type": "place", "translate": {"keys": [[0, [0, 0, 0]], [1, [1, 0, 0]], [1, [5, 0, 0]],
        [2, [6, 0, 0]]]}, "of": )" +
                          kBox + "}");
    const ValuePath path = "/root/translate";
    EXPECT_EQ(keysOf(scene, path).size(), 3u);
    setKey(scene, path, 1, {7, 0, 0});
    EXPECT_THAT(numbersAt(scene, path, 1), ElementsAre(7, 0, 0));
    EXPECT_THAT(numbersAt(scene, path, 0.5), ElementsAre(0.5, 0, 0)) << "up to the jump nothing changes";
    moveKeys(scene, {{path, 1}}, 0.5, false);
    EXPECT_THAT(numbersAt(scene, path, 1.5), ElementsAre(7, 0, 0));
    EXPECT_THAT(numbersAt(scene, path, 0.75), ElementsAre(0.5, 0, 0));
}

TEST(Keys, RefuseWhatCannotBe) {
    Scene scene = bent();
    const Scene before = scene;
    EXPECT_THROW(setKey(scene, "/transfers/bend/none", 0), Error);
    EXPECT_THROW(setKey(scene, "/transfers/bend/angle", 0, {1, 2}), Error);
    EXPECT_THROW(setKey(scene, "/transfers/bend/angle", std::nan("")), Error);
    EXPECT_THROW(removeKey(scene, "/nothing", 0), Error);
    EXPECT_THROW(numbersAt(scene, "/nothing", 0), Error);
    setKey(scene, "/transfers/bend/angle", 0);
    EXPECT_THROW(moveKeys(scene, {{"/transfers/bend/angle", 0}, {"/nothing", 0}}, 1, false), Error);
    EXPECT_THROW(setTimeline(scene, {24, 3, 3}), Error);
    EXPECT_THROW(setTimeline(scene, {0, 0, 3}), Error);
    clearKeys(scene, "/transfers/bend/angle", 0);
    EXPECT_EQ(scene, before);
    setTimeline(scene, {30, -5, 100});
    EXPECT_EQ(scene.timeline, (Timeline{30, -5, 100}));
}

TEST(Keys, OfJointsAreDegrees) {
    Scene scene = sceneOf(R"({"type": "actor", "of": )" + kBox + R"(, "skeleton": {"joints":
        [{"name": "arm", "parent": null, "at": [0, 0, 0]}]}})");
    const ValuePath path = "/root/skeleton/joints/arm/rotate";
    setKey(scene, path, 0, {0, 0, 170});
    setKey(scene, path, 1, {0, 0, -170});
    EXPECT_NEAR(std::abs(numbersAt(scene, path, 0.5)[2]), 180, 1e-9);
    EXPECT_THAT(numbersAt(scene, path, 1), ElementsAre(0, 0, -170));
    setKey(scene, path, 0.25);
    EXPECT_THAT(numbersAt(scene, path, 0.75), Pointwise(DoubleNear(1e-9), {0.0, 0.0, -175.0}));
}

}  // namespace
}  // namespace voledit::test
