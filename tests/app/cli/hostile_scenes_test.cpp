// Scenes with mistakes, and scenes made to hurt: one clear message, or the right answer, in a short time.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

const json kBall =
    json::parse(R"({"type":"solid","shape":{"sphere":{"center":[0,0,0],"radius":1}},"color":[1,0,0],"opacity":1})");

json sceneOf(json root) {
    return {{"voledit", 1}, {"root", std::move(root)}};
}

/// The ball moved by formulas in world coordinates.
json moved(const std::string& x, json more = json::object()) {
    json by{{"type", "expression"}, {"x", x}, {"y", "y"}, {"z", "z"}, {"space", "world"}};
    by.update(more);
    return sceneOf({{"type", "transfer"}, {"by", by}, {"of", kBall}});
}

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int n = 0; n < count; ++n) all += text;
    return all;
}

class HostileScenes : public testing::Test {
protected:
    test::RunResult sample(const std::string& bytes, const std::string& at = "0.1,0.2,0.3") {
        std::ofstream(folder_ / "scene.voledit") << bytes;
        const auto result =
            test::run("voledit", {"sample", (folder_ / "scene.voledit").string(), "--json", "--at", at}, 10);
        EXPECT_LT(result.peakBytes, std::size_t(1) << 30);
        return result;
    }

    /// The message of a scene that must be refused: names the file, is short, stands alone.
    std::string rejection(const std::string& bytes) {
        const auto result = sample(bytes);
        EXPECT_EQ(result.status, 1) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_THAT(result.err, testing::StartsWith("voledit: "));
        EXPECT_THAT(result.err, HasSubstr("scene.voledit: /"));
        EXPECT_LT(result.err.size(), 1200u);
        return result.err;
    }
    std::string rejection(const json& scene) { return rejection(scene.dump()); }

    json sampled(const json& scene, const std::string& at) {
        const auto result = sample(scene.dump(), at);
        EXPECT_EQ(result.status, 0) << result.err;
        return json::parse(result.out, nullptr, false)["samples"][0];
    }

    const fs::path folder_ = test::scratchFolder();
};

TEST_F(HostileScenes, FormulaMistakesAreShownWhereTheyAre) {
    const std::string star = rejection(moved("sin(x) +\n 2 * * y"));
    EXPECT_THAT(star, HasSubstr("/root/by/x, line 2, column 6"));
    EXPECT_THAT(star, HasSubstr("\n     2 * * y\n         ^")) << "the line, and a caret below its column";
    EXPECT_THAT(rejection(moved("x + foo")), HasSubstr("line 1, column 5: 'foo'"));
    EXPECT_THAT(rejection(moved("frobnicate(x)")), HasSubstr("no function 'frobnicate'"));
    EXPECT_THAT(rejection(moved("atan2(x)")), HasSubstr("atan2 takes 2 arguments"));
    EXPECT_THAT(rejection(moved("(x")), HasSubstr("expected ')'"));
    EXPECT_THAT(rejection(moved("")), HasSubstr("/root/by/x"));
    EXPECT_THAT(rejection(moved("x $ 2")), HasSubstr("column 3"));
    EXPECT_THAT(rejection(moved("x", {{"undefined", "y +"}})), HasSubstr("/root/by/undefined"));
    EXPECT_THAT(rejection(moved("a", {{"let", json::parse(R"([["a","x +"]])")}})), HasSubstr("/root/by/let/0/1"));
    EXPECT_THAT(rejection(moved("a", {{"let", json::parse(R"([["a","b"],["b","a"]])")}})),
                HasSubstr("'b' has no meaning here"));
    EXPECT_THAT(rejection(sceneOf({{"type", "fields"}, {"opacity", {{"expression", "1 +"}}}, {"color", {1, 1, 1}}})),
                HasSubstr("/root/opacity/expression, line 1, column 4"));
    json solid = kBall;
    solid["opacity"] = "1 - q";
    EXPECT_THAT(rejection(sceneOf(solid)), HasSubstr("/root/opacity"));
}

TEST_F(HostileScenes, NamesThatAreNotKnownAreNamedWithWhatIsNear) {
    const json twits{{"type", "transfer"}, {"by", {{"type", "twits"}, {"axis", "z"}, {"angle", 3}}}, {"of", kBall}};
    EXPECT_THAT(rejection(sceneOf(twits)),
                testing::AllOf(HasSubstr("/root/by/type"), HasSubstr("did you mean \"twist\"")));
    EXPECT_THAT(rejection(sceneOf({{"use", "nobody"}})), HasSubstr("nobody"));
    EXPECT_THAT(rejection(sceneOf({{"type", "volume"}, {"asset", "nothing"}})), HasSubstr("nothing"));
}

TEST_F(HostileScenes, LongAndDeepFormulasAreRefused) {
    std::string sum = "x";
    for (int n = 0; n < 500000; ++n) sum += "+x";
    for (const std::string& formula :
         {sum, "x" + repeated(" ", 1000000), repeated("(", 100000) + "x" + repeated(")", 100000),
          repeated("(", 49999) + "x" + repeated(")", 49999), repeated("-", 99999) + "x", "x" + repeated("^x", 49999),
          "x" + repeated("+x", 49999), repeated("sin(", 19000) + "x" + repeated(")", 19000),
          repeated("select(x>0,", 6000) + "x" + repeated(",1)", 6000), "x" + repeated("<x", 49999)})
        EXPECT_THAT(rejection(moved(formula)), HasSubstr("/root/by/x")) << formula.substr(0, 30);
    EXPECT_THAT(rejection(moved("x", {{"undefined", repeated("!", 99000) + "(x>1)"}})),
                HasSubstr("/root/by/undefined"));
}

TEST_F(HostileScenes, LetsThatDoubleEachOtherCostNothing) {
    json let = json::array({{"a0", "x"}});
    for (int n = 1; n <= 60; ++n)
        let.push_back({"a" + std::to_string(n), "a" + std::to_string(n - 1) + "+a" + std::to_string(n - 1)});
    const json found = sampled(moved("a60", {{"let", let}}), "1e-18,0,0");
    EXPECT_NEAR(found["path"][0]["point"][0].get<double>(), std::ldexp(1e-18, 60), 1e-9);
}

TEST_F(HostileScenes, CyclesAreRefusedWithTheirWay) {
    json objects = sceneOf({{"use", "a"}});
    objects["objects"]["a"] = {{"type", "union"}, {"of", {{{"use", "b"}}, kBall}}};
    objects["objects"]["b"] = {{"type", "place"}, {"of", {{"use", "a"}}}};
    EXPECT_THAT(rejection(objects), HasSubstr("a → b → a"));

    json attributes = sceneOf({{"use", "a"}});
    attributes["objects"]["a"] = {
        {"type", "fields"}, {"opacity", {{"attribute", "opacity"}, {"of", {{"use", "a"}}}}}, {"color", {1, 1, 1}}};
    EXPECT_THAT(rejection(attributes), HasSubstr("a → a"));

    json transfers = sceneOf({{"type", "transfer"}, {"by", {{"use", "s"}}}, {"of", kBall}});
    transfers["transfers"]["s"] = {{"type", "sequence"}, {"of", {{{"use", "t"}}}}};
    transfers["transfers"]["t"] = {{"type", "transferred"}, {"by", {{"use", "s"}}}, {"of", {{"use", "s"}}}};
    EXPECT_THAT(rejection(transfers), HasSubstr("s → t → s"));

    json displacements = sceneOf({{"type", "displace"}, {"by", {{"use", "d"}}}, {"of", kBall}});
    displacements["displacements"]["d"] = {{"type", "sum"}, {"of", {{{"use", "d"}}, {{"use", "d"}}}}};
    EXPECT_THAT(rejection(displacements), HasSubstr("d → d"));
}

TEST_F(HostileScenes, TermsTenThousandDeepAreRefused) {
    const std::string ball = kBall.dump();
    const auto nested = [&](const std::string& before, const std::string& inner) {
        return R"({"voledit":1,"root":)" + repeated(before, 10000) + inner + repeated("}", 10000) + "}";
    };
    EXPECT_THAT(rejection(nested(R"({"type":"place","of":)", ball)), HasSubstr("nested deeper"));
    EXPECT_THAT(rejection(R"({"voledit":1,"root":{"type":"fields","color":[1,1,1],"opacity":)" +
                          repeated(R"({"map":[[0,0],[1,1]],"of":)", 10000) + "1" + repeated("}", 10000) + "}}"),
                HasSubstr("nested deeper"));
    json places = sceneOf({{"use", "o10000"}}),
         maps = sceneOf({{"type", "transfer"}, {"by", {{"use", "o10000"}}}, {"of", kBall}});
    places["objects"]["o0"] = kBall;
    maps["transfers"]["o0"] = {{"type", "affine"}};
    for (int n = 1; n <= 10000; ++n) {
        const json use{{"use", "o" + std::to_string(n - 1)}};
        places["objects"]["o" + std::to_string(n)] = {{"type", "place"}, {"of", use}};
        maps["transfers"]["o" + std::to_string(n)] = {{"type", "transferred"}, {"by", use}, {"of", {{"use", "o0"}}}};
    }
    EXPECT_THAT(rejection(places), HasSubstr("deeper"));
    EXPECT_THAT(rejection(maps), HasSubstr("deeper"));
}

TEST_F(HostileScenes, TermsThatDoubleFortyTimesAreRefused) {
    json unions = sceneOf({{"use", "o40"}}),
         sums = sceneOf({{"type", "displace"}, {"by", {{"use", "o40"}}}, {"of", kBall}}),
         sequences = sceneOf({{"type", "transfer"}, {"by", {{"use", "o40"}}}, {"of", kBall}});
    unions["objects"]["o0"] = kBall;
    sequences["transfers"]["o0"] = {{"type", "affine"}, {"translate", {0, 0, 1}}};
    sums["displacements"]["o0"] = {{"type", "of"}, {"transfer", {{"type", "affine"}, {"translate", {0, 0, 1}}}}};
    for (int n = 1; n <= 40; ++n) {
        const std::string name = "o" + std::to_string(n);
        const json use{{"use", "o" + std::to_string(n - 1)}}, twice = json::array({use, use});
        unions["objects"][name] = {{"type", "union"}, {"of", twice}};
        sums["displacements"][name] = {{"type", "sum"}, {"of", twice}};
        sequences["transfers"][name] = {{"type", "sequence"}, {"of", twice}};
    }
    for (const json& scene : {unions, sums, sequences}) EXPECT_THAT(rejection(scene), HasSubstr("evaluated twice"));
}

TEST_F(HostileScenes, AUnionOfTenThousandIsRight) {
    json of = json::array();
    for (int n = 0; n < 10000; ++n) of.push_back(kBall);
    EXPECT_EQ(sampled(sceneOf({{"type", "union"}, {"of", of}}), "0.1,0.2,0.3")["opacity"], 1);
}

TEST_F(HostileScenes, WhatIsUndefinedIsEmpty) {
    const json root{{"expression", "sqrt(y)"}};
    const json half{{"type", "fields"}, {"opacity", 0.5}, {"color", {0, 1, 0}}};
    json solid = kBall;
    solid["opacity"] = "sqrt(y)";
    const std::vector<json> objects{
        {{"type", "fields"}, {"opacity", root}, {"color", {1, 1, 1}}},
        {{"type", "fields"}, {"opacity", 1}, {"color", {root, 1, 1}}},
        {{"type", "fields"}, {"opacity", {{"map", {{0, 1}, {1, 1}}}, {"of", root}}}, {"color", {1, 1, 1}}},
        {{"type", "blend"}, {"of", {half, kBall}}, {"weight", root}},
        {{"type", "transfer"},
         {"by", {{"type", "expression"}, {"x", "x + 0.1 * sqrt(y)"}, {"y", "y"}, {"z", "z"}, {"space", "world"}}},
         {"of", half}},
        solid};
    for (const json& object : objects) {
        EXPECT_GT(sampled(sceneOf(object), "0.1,0.25,0.1")["opacity"], 0) << object;
        const json empty = sampled(sceneOf(object), "0.1,-0.25,0.1");
        EXPECT_EQ(empty["opacity"], 0) << object;
        EXPECT_EQ(empty["color"], json({0, 0, 0})) << object;
    }
    // An operand that is empty leaves the other's.
    const json both = sampled(sceneOf({{"type", "union"}, {"of", {objects[0], half}}}), "0.1,-0.25,0.1");
    EXPECT_EQ(both["opacity"], 0.5);
    EXPECT_EQ(both["color"], json({0, 1, 0}));
    for (const char* formula : {"x / (y - y)", "x / 0", "0 / 0", "1 / (x - x)", "log(-1)"}) {
        const json lost = sampled(moved(formula), "0.1,0.2,0.3");
        EXPECT_EQ(lost["opacity"], 0) << formula;
    }
}

}  // namespace
}  // namespace voledit
