#include "core/stf/transfer_definition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/core/stf/analytic_maps.h"
#include "tests/core/stf/library_maps.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string messageOf(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

const char* const kRipple = R"(# A user's own.
title: Ripple
description: Waves along one axis, running over time.
parameter axis   axis    suggested x                                   "Axis along which the waves run"
parameter height number  suggested 0.05  slider [0, 0.2]  strength     "Height of the waves"
parameter waves  number  = 4  allowed [0, 40]                          "How many"

let lift = mod(axis + 2, 3)

[map]
let s = height * sin(2 * pi * (waves * u[axis] - t))
q = replace(u, lift, u[lift] - s)   # a comment

[image]
min = replace(low, lift, low[lift] - abs(height))
max = replace(high, lift, high[lift] + abs(height))
)";

TransferDefinitionPtr ripple() {
    return TransferDefinition::parse(kRipple, "ripple", "ripple.stf");
}

TEST(TransferDefinition, AUsersFileIsReadMappedAndBounded) {
    const auto definition = ripple();
    EXPECT_EQ(definition->title(), "Ripple");
    EXPECT_EQ(definition->parameters().size(), 3u);
    EXPECT_EQ(definition->find("waves")->allowed, (Interval{0, 40}));
    EXPECT_EQ(definition->find("waves")->slider, (Interval{0, 40}));  // as nothing else is said
    EXPECT_EQ(definition->find("wave"), nullptr);
    const Box3 box{Vec3(0), Vec3(10, 20, 40)};
    const auto map = definition->make({{{"axis", Axes{0}}, {"height", Numbers{0.1}}}, frameOf(box), {}, 1, 0.25});
    const Vec3 p(3, 5, 7), q = mappedBy(*map, {p})[0];
    const double s = 0.1 * std::sin(2 * kPi * (4 * 0.3 - 0.25));
    EXPECT_LT(glm::length(q - (p - Vec3(0, 0, 40 * s))), 1e-13);
    EXPECT_LT(glm::length(map->imageOf(box).min - Vec3(0, 0, -4)), 1e-13);
    EXPECT_LT(glm::length(map->imageOf(box).max - Vec3(10, 20, 44)), 1e-13);
    EXPECT_LT(jacobianError(*map, randomPoints(box, 200)), 1e-6);
}

TEST(TransferDefinition, NumbersShareAGraphAndAxesHaveTheirOwn) {
    const auto definition = libraryTransfer("twist");
    const auto made = [&](int axis, double angle, double amount = 1) {
        auto map =
            definition->make({{{"axis", Axes{axis}}, {"angle", Numbers{angle}}}, frameOf(testBox()), {}, amount, 0});
        return std::dynamic_pointer_cast<const FormulaMap>(map);
    };
    // Equal graphs are equal programs: a drag compiles nothing.
    EXPECT_TRUE(made(2, 30)->formula() == made(2, 31)->formula());
    EXPECT_TRUE(made(2, 30)->withDerivatives() == made(2, 30, 0.5)->withDerivatives());
    EXPECT_EQ(made(2, 30)->formula().glsl("f").text, made(2, -99)->formula().glsl("f").text);
    EXPECT_NE(made(2, 30)->formula().glslUniforms(made(2, 30)->parameters()),
              made(2, 31)->formula().glslUniforms(made(2, 31)->parameters()));
    EXPECT_FALSE(made(2, 30)->formula() == made(1, 30)->formula());
}

TEST(TransferDefinition, ArgumentsAreChecked) {
    const auto make = [](const std::string& name, const Arguments& arguments) {
        return messageOf([&] { library(name, arguments); });
    };
    const Arguments z{{"axis", Axes{2}}};
    EXPECT_THAT(make("twist", z), AllOf(HasSubstr("twist"), HasSubstr("\"angle\""), HasSubstr("is missing")));
    EXPECT_THAT(make("twist", {{"axis", Axes{2}}, {"angle", Numbers{1}}, {"angel", Numbers{1}}}),
                AllOf(HasSubstr("\"angel\""), HasSubstr("axis, angle, at")));
    EXPECT_THAT(make("twist", {{"axis", Numbers{2}}, {"angle", Numbers{1}}}), HasSubstr("give an axis"));
    EXPECT_THAT(make("twist", {{"axis", Axes{3}}, {"angle", Numbers{1}}}), HasSubstr("give an axis"));
    EXPECT_THAT(make("twist", {{"axis", Axes{0, 1}}, {"angle", Numbers{1}}}), HasSubstr("give an axis"));
    EXPECT_THAT(make("twist", {{"axis", Axes{2}}, {"angle", Numbers{1, 2}}}), HasSubstr("give a number"));
    EXPECT_THAT(make("twist", {{"axis", Axes{2}}, {"angle", Numbers{kNaN}}}), HasSubstr("finite"));
    EXPECT_THAT(make("twist", {{"axis", Axes{2}}, {"angle", Numbers{kInfinity}}}), HasSubstr("finite"));
    EXPECT_THAT(make("squeeze", {{"axis", Axes{2}}, {"strength", Numbers{1}}}), HasSubstr("below 1"));
    EXPECT_THAT(make("squeeze", {{"axis", Axes{2}}, {"strength", Numbers{0.5}}, {"sigma", Numbers{0}}}),
                HasSubstr("above 0"));
    EXPECT_THAT(make("taper", {{"axis", Axes{2}}, {"scale", Numbers{1, 0}}}), HasSubstr("above 0"));
    EXPECT_THAT(make("dissect", {{"axes", Axes{0}}, {"gap", Numbers{1}}}), HasSubstr("at least 0 and below 1"));
    EXPECT_THAT(make("bend", {{"axis", Axes{2}}, {"toward", Axes{2}}, {"angle", Numbers{1}}}), HasSubstr("same"));
    EXPECT_THAT(make("bend", {{"axis", Axes{2}}, {"toward", Axes{1}}, {"angle", Numbers{1}}, {"range", Numbers{1, 0}}}),
                HasSubstr("range"));
    const LineValue line{Vec3(0), {0, 0, 2}};
    EXPECT_THAT(make("insideOut", {{"line", LineValue{Vec3(0), Vec3(0)}}, {"radius", Numbers{1}}}),
                HasSubstr("direction"));
    EXPECT_THAT(make("insideOut", {{"line", LineValue{Vec3(kNaN), {0, 0, 1}}}, {"radius", Numbers{1}}}),
                HasSubstr("line"));
    EXPECT_THAT(make("insideOut", {{"line", line}, {"radius", Numbers{0}}}), HasSubstr("above 0"));
    const auto sweep = [&](Numbers start, double from, double to) {
        return make("rotationalSweep",
                    {{"line", line}, {"start", std::move(start)}, {"from", Numbers{from}}, {"to", Numbers{to}}});
    };
    EXPECT_THAT(sweep({0, 0, -7}, 0, 90), HasSubstr("along the line"));
    EXPECT_THAT(sweep({0, 0, 0}, 0, 90), HasSubstr("along the line"));
    EXPECT_THAT(sweep({1, 0, 0}, 90, 0), HasSubstr("before its beginning"));
    EXPECT_THAT(make("affine", {{"scale", Numbers{1, 0, 1}}}), HasSubstr("scale of 0"));
}

TEST(TransferDefinition, DirectionsOfAnyLengthAreDirections) {
    for (const double length : {1e-200, 1.0, 1e200}) {
        const auto map = library("insideOut", {{"line", LineValue{Vec3(0), {0, 0, length}}}, {"radius", Numbers{2}}});
        EXPECT_LT(glm::length(mappedBy(*map, {{1.5, 0, 9}})[0] - Vec3(0.5, 0, 9)), 1e-14);
    }
}

TEST(TransferDefinition, FramesWithoutVolumeShowNothing) {
    for (const Box3& flat : {Box3{{0, 0, 0}, {1, 0, 1}}, Box3{Vec3(3), Vec3(3)}, Box3{}})
        for (const LibraryCase& c : libraryCases()) {
            if (!libraryTransfer(c.name)->usesFrame()) continue;
            const auto map = library(c.name, c.arguments, 0.5, Outside::Hide, flat);
            // Coordinates of a flat frame are no numbers; what a formula says of them may be anything but a crash.
            const auto points = randomPoints(testBox(), 300);
            std::vector<Mat3> j(points.size());
            map->jacobian(points, j);
            for (const Vec3& q : mappedBy(*map, points)) EXPECT_FALSE(isDefined(q)) << c.name;
            EXPECT_TRUE(map->imageOf(Box3{}).empty());
            map->imageOf(flat);
            int boxes = 0;
            map->anySourceBox(testBox(), [&](const Box3&) { return ++boxes, false; });
            EXPECT_LE(boxes, 8);
        }
}

TEST(TransferDefinition, SuggestionsAreOfTheOperandsSize) {
    const Box3 box = testBox();
    const auto suggested = [&](const char* transfer, const char* parameter) {
        return suggestedFor(*libraryTransfer(transfer)->find(parameter), box);
    };
    EXPECT_EQ(suggested("insideOut", "radius"), TransferArgument(Numbers{60}));
    EXPECT_EQ(suggested("insideOut", "line"), TransferArgument(LineValue{box.center(), {0, 0, 1}}));
    EXPECT_EQ(suggested("deflect", "center"), TransferArgument(Numbers{10, 10, 70}));
    EXPECT_EQ(suggested("deflect", "translate"), TransferArgument(Numbers{20, 0, 0}));
    EXPECT_EQ(suggested("twist", "angle"), TransferArgument(Numbers{90}));
    EXPECT_EQ(suggested("open", "width"), TransferArgument(Numbers{0.2}));
    EXPECT_EQ(sliderFor(*libraryTransfer("insideOut")->find("radius"), box).high, 120);
    EXPECT_EQ(sliderFor(*libraryTransfer("twist")->find("angle"), box), (Interval{-360, 360}));
    // What the editor starts with can be made, and lies within its sliders.
    for (const auto& definition : transferLibrary()) {
        Arguments arguments;
        for (const TransferParameter& parameter : definition->parameters()) {
            arguments[parameter.name] = suggestedFor(parameter, box);
            const auto* numbers = std::get_if<Numbers>(&arguments[parameter.name]);
            for (const double v : numbers ? *numbers : Numbers())
                EXPECT_TRUE(sliderFor(parameter, box).contains(v)) << definition->name() << " " << parameter.name;
        }
        std::string warning;
        const auto map = definition->make({arguments, frameOf(box), {}, 1, 0}, &warning);
        EXPECT_EQ(warning, "") << definition->name();
        EXPECT_FALSE(map->imageOf(box).empty());
    }
}

TEST(TransferDefinition, MistakesInFormulasShowFileLineColumnAndCaret) {
    const auto mistake = [](std::string from, const std::string& to) {
        std::string text = kRipple;
        text.replace(text.find(from), from.size(), to);
        return messageOf([&] { TransferDefinition::parse(text, "ripple", "my/ripple.stf"); });
    };
    EXPECT_THAT(mistake("sin(2", "sinn(2"), AllOf(HasSubstr("my/ripple.stf, line 11, column 18"), HasSubstr("sin"),
                                                  HasSubstr("\n"), HasSubstr("^")));
    EXPECT_THAT(mistake("- s)   #", "- wavess) #"), AllOf(HasSubstr("line 12"), HasSubstr("wavess")));
    EXPECT_THAT(mistake("q = replace(u, lift, u[lift] - s)", "q = s"),
                AllOf(HasSubstr("line 12"), HasSubstr("vector")));
    EXPECT_THAT(mistake("low[lift] -", "u[lift] -"), AllOf(HasSubstr("line 15"), HasSubstr("'u'")));
    EXPECT_THAT(mistake("mod(axis + 2, 3)", "u[0]"), AllOf(HasSubstr("line 8"), HasSubstr("'u'")));
}

TEST(TransferDefinition, FilesAreLoadedByNameAndHostileOnesRefused) {
    const auto folder = test::scratchFolder();
    const auto write = [&](const std::string& name, const std::string& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    };
    EXPECT_EQ(TransferDefinition::load(write("ripple.stf", kRipple))->name(), "ripple");
    EXPECT_THAT(messageOf([&] { TransferDefinition::load(folder / "none.stf"); }), HasSubstr("none.stf"));
    EXPECT_THAT(messageOf([&] { TransferDefinition::load(folder); }), HasSubstr("no such formula file"));
    const auto load = [&](const std::string& text) {
        return messageOf([&] { TransferDefinition::load(write("hostile.stf", text)); });
    };
    EXPECT_THAT(load(std::string(2'000'000, 'x')), HasSubstr("1 MiB"));
    EXPECT_THAT(load(""), HasSubstr("formulas are missing"));
    EXPECT_THAT(load(std::string(5000, '\0')), HasSubstr("line 1"));
    const std::string start = "[map]\nq = u * (";
    EXPECT_THAT(load(start + std::string(900'000, '1') + ")"), HasSubstr("characters long"));
    EXPECT_THAT(load(start + std::string(90'000, '(') + "1"), HasSubstr("levels deep"));
    EXPECT_THAT(load("[map]\nx = " + std::string(90'000, '-') + "x"), HasSubstr("levels deep"));
    std::string lets = "[map]\nlet a0 = u\n";
    for (int i = 1; i < 500; ++i)
        lets += "let a" + std::to_string(i) + " = sin(a" + std::to_string(i - 1) + ") * cos(a" + std::to_string(i - 1) +
                ") + noise(a" + std::to_string(i - 1) + ")\n";
    // Long chains work; they are bounded by the number of operations.
    EXPECT_EQ(load(lets + "q = a499\n"), "no error");
    std::string statements;
    for (int i = 0; i < 2000; ++i) statements += "let a" + std::to_string(i) + " = 1\n";
    EXPECT_THAT(load(statements), HasSubstr("more than 1000"));
}

// ---- expression

TransferPtr expression(const std::string& x, const std::string& y, const std::string& z, bool world = true,
                       std::optional<std::string> undefined = std::nullopt) {
    ExpressionUse use;
    use.x = {x, "", 1, 1};
    use.y = {y, "", 1, 1};
    use.z = {z, "", 1, 1};
    if (undefined) use.undefined = FormulaText{*undefined, "", 1, 1};
    use.world = world;
    use.frame = frameOf(testBox());
    use.time = 0.5;
    return makeExpressionMap(use);
}

TEST(ExpressionMap, WorldIdentityIsExactAndNormalisedNearlySo) {
    const auto points = randomPoints(testBox(), 1000);
    EXPECT_EQ(mappedBy(*expression("x", "y", "z"), points), points);
    const auto q = mappedBy(*expression("x", "y", "z", false), points);
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT(glm::length(q[i] - points[i]), 1e-12);
}

TEST(ExpressionMap, KnowsTimeLetsConditionAndImage) {
    ExpressionUse use;
    use.lets = {{"s", {"0.1 * sin(y + t)", "", 1, 1}}, {"r", {"s * 2", "", 1, 1}}};
    use.x = {"x + r", "", 1, 1};
    use.y = {"y", "", 1, 1};
    use.z = {"z", "", 1, 1};
    use.undefined = FormulaText{"x > 40", "", 1, 1};
    use.world = true;
    use.image = frameOf({Vec3(1), Vec3(2)});
    use.time = 0.5;
    const auto map = makeExpressionMap(use);
    const Vec3 q = mappedBy(*map, {{1, 2, 3}})[0];
    EXPECT_NEAR(q.x, 1 + 0.2 * std::sin(2.5), 1e-15);
    EXPECT_FALSE(isDefined(mappedBy(*map, {{41, 2, 3}})[0]));
    EXPECT_EQ(map->imageOf(testBox()), (Box3{Vec3(1), Vec3(2)}));
    EXPECT_EQ(expression("x", "y", "z")->imageOf(testBox()), testBox());
}

TEST(ExpressionMap, EqualsTheLibrarysSplitInNormalisedCoordinates) {
    const auto map = expression("select(x < 0.35, x + 0.15, x - 0.15)", "y", "z", false, "!(x < 0.35 || x > 0.65)");
    const auto points = randomPoints(testBox(), 5000);
    const auto q = mappedBy(*map, points),
               expected = mappedBy(*library("split", {{"axis", Axes{0}}, {"gap", Numbers{0.3}}}), points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(isDefined(q[i]), isDefined(expected[i]));
        EXPECT_FALSE(glm::length(q[i] - expected[i]) > 1e-12);  // also where both are NaN
    }
}

TEST(ExpressionMap, MistakesShowACaretAndDivisionsByZeroAreEmpty) {
    EXPECT_THAT(messageOf([] { expression("x +", "y", "z"); }), AllOf(HasSubstr("column 4"), HasSubstr("^")));
    EXPECT_THAT(messageOf([] { expression("x", "yy", "z"); }), AllOf(HasSubstr("'yy'"), HasSubstr("'y'")));
    EXPECT_THAT(messageOf([] { expression("x", "y", "sin(1, 2)"); }), HasSubstr("1 argument"));
    EXPECT_THAT(messageOf([] { expression("x", "y", "z", true, "[1, 2, 3]"); }), HasSubstr("condition"));
    const auto q = mappedBy(*expression("x / (y - y)", "log(0 * x)", "z"), randomPoints(testBox(), 10));
    for (const Vec3& v : q) EXPECT_FALSE(isDefined(v));
}

}  // namespace
}  // namespace voledit
