// voledit rig, as a script calls it: a person rigged by one command, and what is refused.

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::run;
using testing::HasSubstr;

json jsonOf(const fs::path& path) {
    std::ifstream in(path);
    return json::parse(in);
}

class RigCommand : public testing::Test {
protected:
    /// A scene in a folder of its own, with the solids of a scene's `of`.
    fs::path write(const std::string& name, const json& root) const {
        const fs::path path = folder / name;
        std::ofstream(path) << json{{"voledit", 1}, {"root", root}};
        return path;
    }
    const fs::path folder = test::scratchFolder();
};

json capsule(const std::array<double, 3>& from, const std::array<double, 3>& to, double radius) {
    return {{"type", "solid"},
            {"color", {1, 1, 1}},
            {"opacity", 1},
            {"shape", {{"capsule", {{"from", from}, {"to", to}, {"radius", radius}}}}}};
}

TEST_F(RigCommand, LaysTheBipedIntoAPerson) {
    VOLEDIT_SHARED_OR_SKIP(body, "data/volumes/human_body.mhd");
    for (const char* file : {"human_body.mhd", "human_body.zraw"})
        fs::copy_file(body.parent_path() / file, folder / file);
    const auto result = run("voledit",
                            {"rig", (folder / "human_body.mhd").string(), "-o", (folder / "a.voledit").string(),
                             "--report", (folder / "a.json").string()},
                            300);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("biped"));
    const json report = jsonOf(folder / "a.json");
    EXPECT_EQ(report["template"], "biped");
    EXPECT_EQ(report["limbs"].size(), 24u);
    EXPECT_GE(report["covered"].get<double>(), 0.9999);
    // Regions are widened about hubs, where they overlap on purpose (core/rigging/README.md): chest and pelvis.
    EXPECT_LT(report["doubly"].get<double>(), 0.45 * report["opaque"].get<double>());
    const auto joint = [&](const std::string& name) { return report["joints"][name].get<std::array<double, 3>>(); };
    // Where MakeHuman, whose figure this is, has its joints: to a 37th of the height of 16.6.
    const std::vector<std::pair<std::string, std::array<double, 3>>> places{{"Hips", {0, 0.73, 0.14}},
                                                                            {"Neck", {0, 5.89, 0.07}},
                                                                            {"Head", {0, 6.97, 0.16}},
                                                                            {"LeftUpLeg", {1.10, 0.49, 0.12}},
                                                                            {"LeftLeg", {1.58, -3.69, 0.32}},
                                                                            {"LeftFoot", {2.20, -7.45, -0.01}},
                                                                            {"LeftToeBase", {2.20, -8.10, 1.21}},
                                                                            {"LeftArm", {1.68, 5.25, 0.15}},
                                                                            {"LeftForeArm", {3.13, 3.49, 0.13}},
                                                                            {"LeftHand", {4.31, 2.45, 1.76}}};
    for (const auto& [name, at] : places) {
        const auto found = joint(name);
        EXPECT_LT(std::hypot(found[0] - at[0], found[1] - at[1], found[2] - at[2]), 0.45) << name;
    }
    for (const char* name : {"UpLeg", "Leg", "Foot", "ToeBase", "Shoulder", "Arm", "ForeArm", "Hand", "Hand_End"}) {
        const auto left = joint(std::string("Left") + name), right = joint(std::string("Right") + name);
        EXPECT_LT(std::hypot(left[0] + right[0], left[1] - right[1], left[2] - right[2]), 0.08) << name;
    }
    const json scene = jsonOf(folder / "a.voledit");
    EXPECT_EQ(scene["root"]["type"], "actor");
    EXPECT_EQ(scene["assets"]["human_body"]["path"], "human_body.mhd");
    EXPECT_EQ(run("voledit", {"info", (folder / "a.voledit").string(), "--json"}).status, 0);
}

TEST_F(RigCommand, LaysAChainIntoWhatIsNoBody) {
    const fs::path rod = write("rod.voledit", capsule({0, 0, -3}, {0, 0, 3}, 0.5));
    const auto result = run("voledit", {"rig", rod.string(), "-o", (folder / "chain.voledit").string(), "--bones", "5",
                                        "--report", (folder / "chain.json").string()});
    ASSERT_EQ(result.status, 0) << result.err;
    const json report = jsonOf(folder / "chain.json");
    EXPECT_EQ(report["template"], "chain");
    EXPECT_EQ(report["limbs"].size(), 5u);
    EXPECT_EQ(report["uncovered"], 0);
    // The rod's opacity where the actor rests is the rod's.
    for (const char* at : {"0,0,0", "0.3,0.2,2.5", "0.7,0,0", "0,0,3.4"})
        EXPECT_EQ(
            json::parse(run("voledit", {"sample", rod.string(), "--at", at, "--json"}).out)["samples"][0]["opacity"],
            json::parse(run("voledit", {"sample", (folder / "chain.voledit").string(), "--at", at, "--json"})
                            .out)["samples"][0]["opacity"])
            << at;
}

TEST_F(RigCommand, SaysWhatIsWrong) {
    const fs::path rod = write("rod.voledit", capsule({0, 0, -3}, {0, 0, 3}, 0.5));
    const std::string out = (folder / "out.voledit").string();
    EXPECT_EQ(run("voledit", {"rig", rod.string(), "-o", out, "--template", "centaur"}).status, 2);
    EXPECT_EQ(run("voledit", {"rig", rod.string(), "-o", out, "--bones", "0"}).status, 2);
    EXPECT_EQ(run("voledit", {"rig", rod.string(), "-o", out, "--thinness", "-1"}).status, 2);
    EXPECT_EQ(run("voledit", {"rig", rod.string(), "-o", (folder / "out.png").string()}).status, 2);
    const auto legs = run("voledit", {"rig", rod.string(), "-o", out, "--template", "quadruped"});
    EXPECT_EQ(legs.status, 1);
    EXPECT_THAT(legs.err, HasSubstr("four legs"));
    const auto motion = run("voledit", {"rig", rod.string(), "-o", out, "--motion", (folder / "none.bvh").string()});
    EXPECT_EQ(motion.status, 1);
    json hidden = capsule({0, 0, -3}, {0, 0, 3}, 0.5);
    hidden["opacity"] = 0;
    const auto nothing = run("voledit", {"rig", write("hidden.voledit", hidden).string(), "-o", out});
    EXPECT_EQ(nothing.status, 1);
    EXPECT_THAT(nothing.err, HasSubstr("opaque"));
    EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace voledit
