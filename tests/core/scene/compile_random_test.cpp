// Scenes of everything, put together at random: whatever compiles must hold together.

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "tests/core/scene/compiled_json.h"
#include "tests/core/scene/random_scenes.h"

namespace voledit::test {
namespace {

/// A motion with the joints that random skeletons have.
std::shared_ptr<const Motion> legs() {
    Motion motion;
    motion.joints = {{"hip", Joint::kNoParent, {0, 0, 1}, {MotionChannel::Zposition, MotionChannel::Xrotation}},
                     {"knee/~", 0, {0, 0, -3}, {MotionChannel::Xrotation}},
                     {"foot", 1, {0, 0.5, -3}, {}},
                     {"\"ü\"", 0, {2, 0, 0}, {}}};
    motion.frames = 3;
    motion.frameTime = 0.5;
    motion.values = {0, 0, 0, 1, 30, 10, 2, 60, 90};
    return std::make_shared<const Motion>(motion);
}

TEST(CompileRandomScenes, GivesATermThatCanBeSampledOrAnErrorWithItsPlace) {
    LoadedAssets assets;
    assets.volumes["a \"é\" /~"] =
        unitVolume(9, 3, [](const Vec3& p, int c) { return 1000 * p.x * p.y + 300 * c * p.z; });
    assets.motions["b"] = legs();
    RandomScenes random(11, true, false);
    int compiledWell = 0, refused = 0;
    for (int n = 0; n < 150; ++n) {
        const Scene scene = random.next();
        for (const double t : {scene.timeline.start / scene.timeline.fps, 0.37, -50.0}) {
            try {
                const CompiledScene first = compile(scene, assets, t, nullptr);
                ++compiledWell;
                const Box3 box = first.root->bounds;
                std::vector<Vec3> p{Vec3(0), Vec3(0.5), Vec3(1e7), kUndefined};
                if (!box.empty())
                    for (int k = 1; k < 8; ++k) p.push_back(box.min + double(k) / 8.0 * (box.max - box.min));
                std::vector<ObjectSample> found(p.size());
                sample(*first.root, p, found, true);
                for (const ObjectSample& s : found) {
                    EXPECT_TRUE(s.opacity >= 0 && s.opacity <= 1) << n << " " << s.opacity;
                    EXPECT_TRUE(isDefined(s.normalGradient)) << n;
                }
                EXPECT_EQ(compile(scene, assets, t, &first).root.get(), first.root.get()) << n;
                EXPECT_GT(first.stepLength(), 0);
            } catch (const Error& error) {
                ++refused;
                EXPECT_THAT(error.what(), testing::StartsWith("/")) << n;
            }
        }
    }
    EXPECT_GT(compiledWell, 150);
    EXPECT_GT(refused, 20);
}

TEST(CompileRandomScenes, WritingFramesOutMovesNothing) {
    LoadedAssets assets;
    assets.volumes["a \"é\" /~"] = unitVolume(5, 3, [](const Vec3& p, int) { return 1000 * p.x; });
    assets.motions["b"] = legs();
    RandomScenes random(12, true, false);
    int compared = 0;
    for (int n = 0; n < 120; ++n) {
        const Scene scene = random.next();
        std::optional<CompiledScene> before;
        try {
            before = compile(scene, assets, 0.25, nullptr);
        } catch (const Error&) {
            continue;
        }
        const Scene written = withDefaultsWrittenOut(scene, assets);
        const CompiledScene after = compile(written, assets, 0.25, &*before);
        EXPECT_EQ(after.root.get(), before->root.get()) << n;
        EXPECT_TRUE(defaultFrames(after).empty()) << n;
        ++compared;
    }
    EXPECT_GT(compared, 40);
}

}  // namespace
}  // namespace voledit::test
