// Motions of glTF, Collada and FBX, read by the parser process.

#include <gtest/gtest.h>

#include <random>

#include "core/base/error.h"
#include "core/io/bvh.h"
#include "tests/core/io/files.h"
#include "tests/core/io/model_files.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

MotionFile read(const std::string& name, const std::string& bytes) {
    IoClient io;
    return io.readMotion(test::writeFile(test::scratchFolder() / name, bytes));
}

std::map<std::string, Vec3> placesAt(const Motion& motion, double t) {
    const Skeleton skeleton = skeletonOf(motion);
    const auto posed = posedJoints(skeleton, poseAt(motion, t));
    std::map<std::string, Vec3> places;
    for (std::size_t j = 0; j < posed.size(); ++j) places[skeleton.joints[j].name] = posed[j].position;
    return places;
}

void expectNear(const Vec3& found, const Vec3& wanted, const std::string& what) {
    EXPECT_LT(glm::length(found - wanted), 1e-5 * (1 + glm::length(wanted)))
        << what << ": " << found.x << " " << found.y << " " << found.z;
}

/// Of the glTF file at t seconds: the hips run along their z, the arm turns about its z by half a turn.
void expectGltfPlaces(const Motion& motion) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        auto places = placesAt(motion, t);
        // The armature turns (x, y, z) to (x, z, −y) and makes it ten times as large.
        const auto world = [](const Vec3& v) { return 10.0 * Vec3(v.x, v.z, -v.y); };
        const Vec3 hips(0, 1, 4 * t), arm = hips + Vec3(1, 0, 0);
        expectNear(places["Hips"], world(hips), "Hips");
        expectNear(places["Arm"], world(arm), "Arm");
        expectNear(places["Hand"], world(arm + 2.0 * Vec3(std::cos(kPi * t), std::sin(kPi * t), 0)), "Hand");
    }
}

TEST(ModelMotion, GltfWithItsBufferWithin) {
    const MotionFile file = read("arm.gltf", test::embeddedGltf());
    EXPECT_EQ(file.format, "gltf");
    EXPECT_TRUE(file.warnings.empty()) << file.warnings.front();
    EXPECT_EQ(file.motion->frames, 3u);
    EXPECT_NEAR(file.motion->frameTime, 0.5, 1e-6);
    ASSERT_EQ(file.motion->joints.size(), 3u);  // what stands above the moving nodes is no joint
    EXPECT_EQ(file.motion->joints[0].name, "Hips");
    EXPECT_EQ(file.motion->joints[2].name, "Hand");
    expectNear(skeletonOf(*file.motion).joints[2].at, Vec3(30, 0, -10), "Hand at rest");
    expectGltfPlaces(*file.motion);
}

TEST(ModelMotion, Glb) {
    expectGltfPlaces(*read("arm.glb", test::glbBytes()).motion);
}

TEST(ModelMotion, GltfWithABufferBesideIt) {
    const fs::path folder = test::scratchFolder();
    test::writeFile(folder / "arm.bin", test::clipBytes());
    test::writeFile(folder / "arm.gltf", test::gltfText("arm.bin"));
    IoClient io;
    expectGltfPlaces(*io.readMotion(folder / "arm.gltf").motion);
}

TEST(ModelMotion, BuffersElsewhereAreNotRead) {
    const fs::path folder = test::scratchFolder();
    fs::create_directory(folder / "inner");
    test::writeFile(folder / "arm.bin", test::clipBytes());
    IoClient io;
    for (const std::string& uri : {std::string("../arm.bin"), (folder / "arm.bin").string(), std::string("link.bin")}) {
        fs::remove(folder / "inner" / "link.bin");
        fs::create_symlink(folder / "arm.bin", folder / "inner" / "link.bin");
        test::writeFile(folder / "inner" / "arm.gltf", test::gltfText(uri));
        EXPECT_THROW(io.readMotion(folder / "inner" / "arm.gltf"), Error) << uri;
    }
}

TEST(ModelMotion, OfSeveralClipsTheFirst) {
    const MotionFile file = read("arm.gltf", test::embeddedGltf(3));
    expectGltfPlaces(*file.motion);
    ASSERT_EQ(file.warnings.size(), 1u);
    for (const char* part : {"3 clips", "\"clip 0\" was read", "\"clip 1\"", "\"clip 2\""})
        EXPECT_NE(file.warnings[0].find(part), std::string::npos) << file.warnings[0];
}

void expectArm(const Motion& motion) {
    for (const double t : {0.0, 0.25, 0.5, 1.0}) {
        auto places = placesAt(motion, t);
        expectNear(places["Arm"], Vec3(1, 1, 0), "Arm");
        expectNear(places["Hand"], Vec3(1 + 2 * std::cos(kPi * t), 1 + 2 * std::sin(kPi * t), 0), "Hand");
    }
}

TEST(ModelMotion, Collada) {
    const MotionFile file = read("arm.dae", test::colladaText());
    EXPECT_EQ(file.format, "dae");
    expectArm(*file.motion);
}

TEST(ModelMotion, Fbx) {
    const MotionFile file = read("arm.FBX", test::fbxText());
    EXPECT_EQ(file.format, "fbx");
    ASSERT_EQ(file.motion->joints.size(), 2u);  // nothing moves the hips, nor is anything bound to them
    expectArm(*file.motion);
}

TEST(ModelMotion, BecomesBvh) {
    const Motion motion = *read("arm.gltf", test::embeddedGltf()).motion;
    EXPECT_EQ(parseBvh(bvhText(motion), "arm.bvh"), motion);
}

TEST(ModelMotion, WithoutAClipOrASkeleton) {
    EXPECT_THROW(read("still.gltf", test::embeddedGltf(0)), Error);  // nodes alone are no skeleton
    for (const char* name : {"bad.gltf", "bad.glb", "bad.dae", "bad.fbx"}) {
        EXPECT_THROW(read(name, ""), Error) << name;
        EXPECT_THROW(read(name, "rubbish"), Error) << name;
        EXPECT_THROW(read(name, std::string(5000, '\xff')), Error) << name;
    }
    IoClient io;
    EXPECT_THROW(io.readMotion(test::scratchFolder() / "missing.fbx"), Error);
}

TEST(ModelMotion, DeepNodesAreRefusedOrKillTheParserAlone) {
    std::string nodes, text = test::embeddedGltf();
    const int depth = 20'000;
    for (int n = 4; n < 4 + depth; ++n) nodes += ",{\"name\":\"n\",\"children\":[" + std::to_string(n + 1) + "]}";
    nodes += ",{\"name\":\"last\"}";
    const std::string hand = "\"translation\":[2,0,0]";
    text.insert(text.find(hand) + hand.size(), ",\"children\":[4]");
    text.insert(text.find("],\"buffers\""), nodes);
    EXPECT_THROW(read("deep.gltf", text), Error);
    EXPECT_NO_THROW(read("arm.gltf", test::embeddedGltf()));
}

/// One to four bytes replaced, dropped or doubled.
std::string mutated(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    for (std::size_t n = 1 + below(4); n > 0; --n) {
        const std::size_t at = below(bytes.size());
        const char interesting[] = {'\0', '\xff', '0', '9', '-', ' ', '"', ','};
        switch (below(4)) {
            case 0:
                bytes[at] = char(below(256));
                break;
            case 1:
                bytes[at] = interesting[below(sizeof interesting)];
                break;
            case 2:
                bytes.erase(at, 1 + below(8));
                break;
            default:
                bytes.insert(at, bytes.substr(at, 1 + below(8)));
        }
    }
    return bytes;
}

class ModelMutations : public testing::TestWithParam<const char*> {};

TEST_P(ModelMutations, NeverHarmTheClient) {
    const std::string ending = GetParam();
    const std::string bytes = ending == "gltf"  ? test::embeddedGltf()
                              : ending == "glb" ? test::glbBytes()
                              : ending == "dae" ? test::colladaText()
                                                : test::fbxText();
    const fs::path path = test::scratchFolder() / ("mutated." + ending);
    IoClient io({}, {.processorSeconds = 2, .wallSeconds = 60});
    std::mt19937 random(6);
    int read = 0, refused = 0;
    for (int n = 0; n < 300; ++n) {
        test::writeFile(path, mutated(bytes, random));
        try {
            const Motion m = *io.readMotion(path).motion;
            EXPECT_EQ(m.values.size(), m.frames * m.channelCount());
            ++read;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("mutated"), std::string::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_EQ(read + refused, 300);
    test::writeFile(path, bytes);
    EXPECT_NO_THROW(io.readMotion(path));
}

INSTANTIATE_TEST_SUITE_P(, ModelMutations, testing::Values("gltf", "glb", "dae", "fbx"));

}  // namespace
}  // namespace voledit
