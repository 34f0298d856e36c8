#include "core/scene/scene_at.h"

#include <gtest/gtest.h>

#include "core/scene/scene_children.h"
#include "core/scene/scene_json.h"
#include "core/scene/scene_walk.h"
#include "tests/core/scene/random_scenes.h"

namespace voledit {
namespace {

Tracked<double> ramp(double from, double to) {
    Tracked<double> value = from;
    value.setTracks({{PartTrack::kWhole, {{{0, {from}}, {1, {to}}}, Track::Interpolation::Linear}}});
    return value;
}

Scene read(const std::string& text) {
    return sceneFromJson(text, "/s.voledit");
}

TEST(SceneAt, TakesEveryTrackedValue) {
    const Scene scene = read(R"({"voledit": 1,
        "transfers": {"t": {"type": "twist", "axis": "z", "angle": {"keys": [[0, 0], [2, 90]]},
                            "amount": {"keys": [[0, 1], [2, 0]]},
                            "frame": {"min": [0, 0, 0], "max": {"keys": [[0, [1, 1, 1]], [2, [3, 3, 3]]]}}}},
        "root": {"type": "transfer", "by": {"use": "t"}, "of": {"type": "solid", "color": [1, {"keys": [[0, 0], [2, 1]]}, 0],
                 "shape": {"sphere": {"center": {"keys": [[0, [0, 0, 0]], [2, [2, 4, 6]]]}, "radius": 1}}, "opacity": 1}},
        "opacityDistance": {"keys": [[0, 1], [2, 3]]},
        "camera": {"eye": {"keys": [[0, [0, -10, 0]], [2, [0, -20, 0]]]}},
        "render": {"light": {"keys": [[0, [1, 0, 0]], [2, [3, 0, 0]]]}}})");
    ASSERT_TRUE(animated(scene));
    const Scene expected = read(R"({"voledit": 1,
        "transfers": {"t": {"type": "twist", "axis": "z", "angle": 45, "amount": 0.5,
                            "frame": {"min": [0, 0, 0], "max": [2, 2, 2]}}},
        "root": {"type": "transfer", "by": {"use": "t"}, "of": {"type": "solid", "color": [1, 0.5, 0],
                 "shape": {"sphere": {"center": [1, 2, 3], "radius": 1}}, "opacity": 1}},
        "opacityDistance": 2, "camera": {"eye": [0, -15, 0]}, "render": {"light": [2, 0, 0]}})");
    EXPECT_EQ(sceneAt(scene, 1), expected);
    EXPECT_FALSE(animated(expected));
}

TEST(SceneAt, HasNoTracksLeftWhateverTheScene) {
    test::RandomScenes scenes(5);
    int moving = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Scene scene = scenes.next();
        const Scene now = sceneAt(scene, trial % 7 - 3);
        EXPECT_FALSE(hasTracks(now));
        EXPECT_EQ(sceneToJson(now).find("\"keys\""), std::string::npos) << "a member that is not visited";
        EXPECT_EQ(hasTracks(scene), sceneToJson(scene).find("\"keys\"") != std::string::npos);
        EXPECT_TRUE(animated(scene) || !hasTracks(scene));
        moving += hasTracks(scene);
    }
    EXPECT_GT(moving, 50);
}

TEST(SceneAt, SharesEveryNodeWithoutTracksBelow) {
    test::RandomScenes scenes(6);
    std::size_t shared = 0, made = 0;
    for (int trial = 0; trial < 50; ++trial) {
        const Scene scene = scenes.next();
        const Scene now = sceneAt(scene, 1);
        std::map<NodePath, NodePointer> before;
        forEachNode(scene, [&](const NodePath& path, const NodePointer& node) { before[path] = node; });
        forEachNode(now, [&](const NodePath& path, const NodePointer& node) {
            const bool same = before.at(path) == node;
            bool equal = false;
            std::visit([&]<class Node>(const Node* mine) { equal = *mine == *std::get<const Node*>(before.at(path)); },
                       node);
            EXPECT_EQ(same, equal) << path;
            ++(same ? shared : made);
        });
    }
    EXPECT_GT(shared, 100u);
    EXPECT_GT(made, 100u);
}

TEST(SceneAt, ASceneWithoutTracksIsReturnedAsItIs) {
    test::RandomScenes scenes(7, false);
    for (int trial = 0; trial < 20; ++trial) {
        const Scene scene = scenes.next();
        const Scene now = sceneAt(scene, 3);
        EXPECT_EQ(now, scene);
        EXPECT_TRUE(now.root.sharesWith(scene.root));
        for (const auto& [name, transfer] : scene.transfers)
            EXPECT_TRUE(now.transfers.at(name).sharesWith(transfer)) << name;
    }
}

TEST(SceneAt, HoldsAmountsAndTablesInTheirRange) {
    Scene scene;
    Transfer transfer;
    transfer.amount = ramp(0, 1);
    auto tracks = transfer.amount.tracks();
    tracks[0].track.interpolation = Track::Interpolation::Smooth;
    tracks[0].track.keys = {{0, {0}}, {1, {1}}, {2, {1}}, {3, {0}}};
    transfer.amount.setTracks(tracks);
    ASSERT_GT(transfer.amount.at(1.5), 1) << "it overshoots";
    scene.transfers["t"] = transfer;
    EXPECT_EQ(*sceneAt(scene, 1.5).transfers.at("t")->amount, 1);

    RecolorObject recolor;
    Tracked<PiecewiseLinear> table(PiecewiseLinear{{{0, 0}, {1, 1}}});
    table.setTracks({{0, {{{0, {0}}, {1, {4}}}, {}}}});
    recolor.opacity = table;
    scene.root = Object{recolor};
    const auto now = *std::get<RecolorObject>(sceneAt(scene, 1).root->kind).opacity;
    EXPECT_EQ(now, (PiecewiseLinear{{{4, 0}, {4, 1}}}));
}

}  // namespace
}  // namespace voledit
