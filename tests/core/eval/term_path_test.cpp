#include "core/eval/term_path.h"

#include <gtest/gtest.h>

#include "core/eval/voxelise.h"
#include "core/scene/scene_json.h"

namespace voledit {
namespace {

const std::string kBall =
    R"({"type": "solid", "shape": {"sphere": {"center": [0, 0, 0], "radius": 1}}, "color": [1, 1, 1], "opacity": 1})";

std::string shift(double x, const std::string& name) {
    return R"({"type": "affine", "name": ")" + name + R"(", "translate": [)" + std::to_string(x) + ", 0, 0]}";
}
/// A lattice at rest over a box that holds all the points of these tests, so that members with cells become parts.
const std::string kRest = R"({"type": "ffd", "name": "rest", "frame": {"min": [-9, -9, -9], "max": [9, 9, 9]}})";

CompiledScene sceneOf(const std::string& root) {
    return compile(sceneFromJson(R"({"voledit": 1, "root": )" + root + "}", "/path.voledit"), {}, 0, nullptr);
}
std::string transfer(const std::string& by, const std::string& of) {
    return R"({"type": "transfer", "by": )" + by + R"(, "of": )" + of + "}";
}

/// "name:x" for each entry.
std::string written(const std::vector<PathPoint>& path) {
    std::string text;
    for (const PathPoint& entry : path) {
        const std::string x = isDefined(entry.point) ? std::to_string(int(std::lround(entry.point.x))) : "-";
        text += (text.empty() ? "" : " ") + entry.name + ":" + x;
    }
    return text;
}

TEST(PathThrough, LeadsThroughAnActorByItsName) {
    const auto scene = sceneOf(R"({"type": "actor", "name": "rod", "of": )" + kBall + R"(, "skeleton": {"joints": [
        {"name": "a", "parent": null, "at": [-1, 0, 0], "translate": [5, 0, 0]},
        {"name": "b", "parent": "a", "at": [1, 0, 0]}],
        "limbs": [{"name": "l", "from": "a", "to": "b", "size": [2, 2]}]}})");
    EXPECT_EQ(written(pathThrough(*scene.root, {6, 0, 0})), "rod:1");
    EXPECT_EQ(written(pathThrough(*scene.root, {3, 0, 0})), "rod:-");
    EXPECT_EQ(outermostTransfer(*scene.root).list.size(), 1u);
}

TEST(PathThrough, HasOneEntryForEachOfAListTheOutermostFirst) {
    const auto scene = sceneOf(transfer("[" + shift(1, "a") + ", " + shift(2, "b") + "]", kBall));
    EXPECT_EQ(written(pathThrough(*scene.root, {5, 0, 0})), "b:3 a:2");
    const auto nested = sceneOf(transfer(shift(2, "b"), transfer(shift(1, "a"), kBall)));
    EXPECT_EQ(written(pathThrough(*nested.root, {5, 0, 0})), "b:3 a:2");
}

TEST(PathThrough, ASequenceIsOneEntryAfterAllOfItsMembers) {
    const std::string members = "[" + shift(1, "a") + ", " + kRest + ", " + shift(2, "b") + "]";
    const std::string sequence = R"({"type": "sequence", "name": "s", "of": )" + members + "}";
    const auto scene = sceneOf(transfer("[" + shift(10, "far") + ", " + sequence + "]", kBall));
    EXPECT_EQ(written(pathThrough(*scene.root, {5, 0, 0})), "s:2 far:-8");
    const std::string plain =
        R"({"type": "sequence", "name": "s", "of": [)" + shift(1, "a") + ", " + shift(2, "b") + "]}";
    EXPECT_EQ(written(pathThrough(*sceneOf(transfer(plain, kBall)).root, {5, 0, 0})), "s:2");
}

TEST(PathThrough, GoesOnThroughPlacementsDisplacementsAndRecolouring) {
    const std::string inner = transfer(shift(1, "a"), kBall);
    const std::string recolored = R"({"type": "recolor", "opacity": [[0, 0], [1, 0.5]], "of": )" + inner + "}";
    const std::string displaced =
        R"({"type": "displace", "by": {"type": "fields", "x": -1, "y": 0, "z": 0}, "of": )" + recolored + "}";
    const auto scene = sceneOf(R"({"type": "place", "translate": [2, 0, 0], "of": )" + displaced + "}");
    EXPECT_EQ(written(pathThrough(*scene.root, {5, 0, 0})), "a:1");
    const auto* outermost = outermostTransfer(*scene.root).list.at(0);
    EXPECT_EQ(outermost->name, "a");
    EXPECT_EQ(outermostTransfer(*scene.root).above.size(), 2u);
}

TEST(PathThrough, EndsWhereItWouldPart) {
    const std::string both = R"({"type": "union", "of": [)" + transfer(shift(1, "a"), kBall) + ", " + kBall + "]}";
    const auto scene = sceneOf(transfer(shift(2, "b"), both));
    EXPECT_EQ(written(pathThrough(*scene.root, {5, 0, 0})), "b:3");
    EXPECT_TRUE(pathThrough(*sceneOf(both).root, {5, 0, 0}).empty());
    EXPECT_TRUE(outermostTransfer(*sceneOf(both).root).list.empty());
}

TEST(PathThrough, SaysWhereAPointIsLost) {
    const std::string cut = R"({"type": "expression", "name": "cut", "space": "world", "x": "x", "y": "y", "z": "z",
        "undefined": "x > 4"})";
    const auto scene = sceneOf(transfer("[" + shift(1, "a") + ", " + cut + ", " + shift(2, "b") + "]", kBall));
    EXPECT_EQ(written(pathThrough(*scene.root, {5, 0, 0})), "b:3 cut:3 a:2");
    EXPECT_EQ(written(pathThrough(*scene.root, {7, 0, 0})), "b:5 cut:- a:-");
}

TEST(OutermostTransfer, IsTheWholeList) {
    const std::string sequence = R"({"type": "sequence", "of": [)" + kRest + ", " + shift(1, "a") + "]}";
    const auto scene =
        sceneOf(transfer("[" + shift(4, "b") + ", " + sequence + "]", transfer(shift(8, "inner"), kBall)));
    EXPECT_EQ(outermostTransfer(*scene.root).list.size(), 3u)
        << "both members of the sequence, and b; not the inner one";
    VolumeGrid grid;
    const auto displacement = voxelise(scene, {grid, VoxeliseWhat::Displacement, VoxelType::Double, 0});
    EXPECT_NEAR(displacement->at({0, 0, 0}, 0), -5, 1e-12);
}

TEST(OneSource, IsTheVolumeThatAChainLeadsTo) {
    const auto volume = Volume::fromValues(VolumeGrid{Index3(2), 1, Mat4(1)}, std::vector<short>(8, 7));
    const auto source = [&](const std::string& root) {
        const std::string text = R"({"voledit": 1, "assets": {"v": {"kind": "volume", "path": "v.nrrd"}},
            "objects": {"o": {"type": "volume", "asset": "v"}}, "root": )" +
                                 root + "}";
        return compile(sceneFromJson(text, "/p.voledit"), LoadedVolumes{{"v", volume}}, 0, nullptr);
    };
    const std::string use = R"({"use": "o"})";
    for (const std::string& root :
         {use, transfer(shift(0.25, "a"), R"({"type": "recolor", "opacity": [[0, 0], [1, 1]], "of": )" + use + "}")}) {
        const CompiledScene scene = source(root);
        ASSERT_TRUE(oneSourceOf(*scene.root));
        VolumeGrid grid;
        grid.worldFromIndex[3] = Vec4(0.5, 0.5, 0.5, 1);
        EXPECT_EQ(voxelise(scene, {grid, VoxeliseWhat::Scalar, VoxelType::Double, -1})->at({0, 0, 0}), 7);
    }
    const CompiledScene composite = source(R"({"type": "merge", "of": [)" + use + ", " + use + "]}");
    EXPECT_FALSE(oneSourceOf(*composite.root));
    EXPECT_THROW(voxelise(composite, {VolumeGrid{}, VoxeliseWhat::Scalar, VoxelType::Double, 0}), std::exception);
}

}  // namespace
}  // namespace voledit
