// core/scene/json_text.h: parsing with care, printing for people.
#include "core/scene/json_text.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>

#include "core/base/error.h"

namespace voledit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

auto failsWith(const std::string& a, const std::string& b) {
    return ThrowsMessage<Error>(AllOf(HasSubstr(a), HasSubstr(b)));
}

std::string nested(std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
}

TEST(ParseJson, ReadsWhatNlohmannReads) {
    for (const std::string text :
         {R"({"a": [1, -2.5e3, "x", null, true], "b": {}, "c": [[], [{}]]})", "3", "\"é\"", R"([{"a": 1}, {"a": 2}])"})
        EXPECT_EQ(parseJson(text, "f"), json::parse(text)) << text;
}

TEST(ParseJson, NamesLineAndColumnOfASyntaxError) {
    EXPECT_THAT([] { parseJson("{\n  \"a\": 1,\n  }", "dir/f.voledit"); }, failsWith("dir/f.voledit:3:3:", "not JSON"));
    EXPECT_THAT([] { parseJson("[1, 2] x", "f"); }, failsWith("f:1:8:", "not JSON"));
    EXPECT_THAT([] { parseJson("[1, NaN]", "f"); }, failsWith("f:1:", "not JSON"));
}

TEST(ParseJson, SaysThatAFileIsEmpty) {
    EXPECT_THAT([] { parseJson(" \n\t", "f"); }, failsWith("f:", "the file is empty"));
    EXPECT_THAT([] { parseJson("", "f"); }, failsWith("f:", "the file is empty"));
}

TEST(ParseJson, RefusesWhatIsNotUtf8) {
    EXPECT_THAT([] { parseJson("{\"a\": \"\xff\"}", "f"); }, failsWith("f:1:", "not UTF-8"));
    EXPECT_THAT([] { parseJson(std::string("\0\1\2", 3), "f"); }, failsWith("f:1:1:", "not JSON"));
}

TEST(ParseJson, RefusesAMemberThatStandsTwice) {
    EXPECT_THAT([] { parseJson(R"({"a": 1, "a": 1})", "f"); }, failsWith("f: /a:", "twice"));
    EXPECT_THAT([] { parseJson(R"({"x": [0, {"y~/": {"a": 1, "b": 2, "a": 3}}]})", "f"); },
                failsWith("f: /x/1/y~0~1/a:", "twice"));
}

TEST(ParseJson, RefusesNumbersBeyondADouble) {
    EXPECT_THAT([] { parseJson(R"({"a": [0, 1e999]})", "f"); }, failsWith("f:1:", "beyond"));
    EXPECT_EQ(parseJson("1e308", "f"), 1e308);
    EXPECT_EQ(parseJson("1e-999", "f"), 0.0);
}

TEST(ParseJson, BoundsTheNesting) {
    EXPECT_NO_THROW(parseJson(nested(500), "f"));
    EXPECT_THAT([] { parseJson(nested(501), "f"); }, failsWith("f: /0/0", "nested deeper than 500"));
    EXPECT_THAT([] { parseJson(std::string(100'000, '['), "f"); }, failsWith("f: /0/0", "deeper"));
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"of\":";
    EXPECT_THAT([&] { parseJson(objects, "f"); }, failsWith("f: /of/of", "deeper"));
}

TEST(ParseJson, BoundsTheNumberOfValues) {
    std::string text = "[0";
    for (int i = 0; i < 8'000'000; ++i) text += ",0";
    text += "]";
    EXPECT_THAT([&] { parseJson(text, "f"); }, failsWith("f:", "more than 8000000 values"));
}

TEST(ParseJson, CutsLongQuotationsOutOfMessages) {
    try {
        parseJson("[\"" + std::string(1'000'000, 'x') + "\n\"]", "f");
        FAIL();
    } catch (const Error& error) {
        EXPECT_LT(std::string(error.what()).size(), 500u);
    }
}

TEST(ParseJson, CutsLongNamesOutOfMessages) {
    const std::string name(1'000'000, 'n');
    try {
        parseJson("{\"" + name + "\": [{\"a\": 1, \"a\": 2}]}", "f");
        FAIL();
    } catch (const Error& error) {
        EXPECT_LT(std::string(error.what()).size(), 500u);
        EXPECT_THAT(error.what(), HasSubstr("…/0/a: this member stands twice"));
    }
}

TEST(Abridged, CutsBetweenCharacters) {
    EXPECT_EQ(abridged("short"), "short");
    std::string text(59, 'a');
    for (int i = 0; i < 10; ++i) text += "é";
    EXPECT_EQ(abridged(text), std::string(59, 'a') + "…");
}

TEST(JsonPlace, WritesPointers) {
    const JsonPlace root, a = root.at("a/b"), first = a.at(std::size_t(0)), m = first.at("m~n");
    EXPECT_EQ(root.pointer(), "/");
    EXPECT_EQ(m.pointer(), "/a~1b/0/m~0n");
    EXPECT_EQ(memberOf("/x", "a/b"), "/x/a~1b");
    EXPECT_EQ(elementOf("/x", 3), "/x/3");
}

TEST(PrintJson, PutsShortThingsOnOneLineAndKeepsOrder) {
    const ordered_json value{{"z", 1}, {"a", {1.5, 2, 3}}, {"o", {{"p", ordered_json::array()}}}};
    EXPECT_EQ(printJson(value), "{\n  \"z\": 1,\n  \"a\": [1.5, 2, 3],\n  \"o\": { \"p\": [] }\n}\n");
}

TEST(PrintJson, BreaksLongThings) {
    ordered_json rows;
    for (int i = 0; i < 40; ++i) rows["rows"].push_back({i, i + 0.5});
    const std::string text = printJson(rows);
    EXPECT_THAT(text, HasSubstr("    [3, 3.5],\n"));
    EXPECT_EQ(ordered_json::parse(text), rows);
}

TEST(PrintJson, NumbersReadBackAsTheSameDouble) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20'000; ++i) {
        const std::uint64_t bits = random();
        double value;
        std::memcpy(&value, &bits, sizeof value);
        if (!std::isfinite(value)) continue;
        EXPECT_EQ(parseJson(printJson(value), "f").get<double>(), value);
    }
    EXPECT_EQ(printJson(20.0), "20\n");
    EXPECT_EQ(printJson(0.1), "0.1\n");
    EXPECT_EQ(parseJson(printJson(1e22), "f").get<double>(), 1e22);
}

TEST(PrintJson, RefusesWhatJsonCannotHold) {
    EXPECT_THROW(printJson(std::numeric_limits<double>::quiet_NaN()), Error);
    EXPECT_THROW(printJson(ordered_json{{"a", {1.0, std::numeric_limits<double>::infinity()}}}), Error);
    EXPECT_THROW(printJson("\xff"), Error);
}

}  // namespace
}  // namespace voledit
