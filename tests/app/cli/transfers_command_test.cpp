// `voledit transfers`: the library, one of it, a user's file; and the docs made of it.

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using test::run;
using testing::HasSubstr;

std::string textOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

TEST(TransfersCommand, TheDocsAreWhatItPrints) {
    const auto printed = run("voledit", {"transfers", "--markdown"});
    EXPECT_EQ(printed.status, 0) << printed.err;
    EXPECT_EQ(textOf(test::fixture("../docs/transfers.md")), printed.out) << "run docs/transfers.sh";
}

TEST(TransfersCommand, ListsTheLibraryAndOneOfIt) {
    const auto all = nlohmann::json::parse(run("voledit", {"transfers", "--json"}).out);
    EXPECT_GE(all.size(), 11u);
    const auto twist = nlohmann::json::parse(run("voledit", {"transfers", "twist", "--json"}).out);
    EXPECT_EQ(twist["parameters"][1]["name"], "angle");
    EXPECT_EQ(twist["parameters"][1]["unit"], "degrees");
    EXPECT_FALSE(twist["parameters"][1].contains("default"));
    EXPECT_EQ(twist["parameters"][2]["default"], 0.5);
    EXPECT_THAT(run("voledit", {"transfers"}).out, HasSubstr("\ntwist: "));
    EXPECT_THAT(run("voledit", {"transfers", "bend"}).out, HasSubstr("range (pair; [0, 1])"));
    const auto unknown = run("voledit", {"transfers", "twirl"});
    EXPECT_EQ(unknown.status, 1);
    EXPECT_THAT(unknown.err, HasSubstr("twirl"));
    EXPECT_EQ(run("voledit", {"transfers", "--json", "--markdown"}).status, 2);
}

TEST(TransfersCommand, ChecksAUsersFile) {
    const auto file = test::scratchFolder() / "mine.stf";
    const auto check = [&](const std::string& text) {
        std::ofstream(file) << text;
        return run("voledit", {"transfers", file.string()});
    };
    EXPECT_THAT(check("title: Mine\n[map]\nx = x + sin(y)\n").out, HasSubstr("mine: Mine"));
    const auto wrong = check("title: Mine\n[map]\nx = x + sinn(y)\n");
    EXPECT_EQ(wrong.status, 1);
    EXPECT_THAT(wrong.err, testing::AllOf(HasSubstr("mine.stf, line 3, column 9"), HasSubstr("^")));
}

}  // namespace
}  // namespace voledit
