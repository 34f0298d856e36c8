#include "app/editor/formula_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string ripple(const std::string& formula) {
    return "title: Ripple\ndescription: Waves.\nparameter height number = 0.1 slider [0, 1] \"How high\"\n\n[map]\nz "
           "= " +
           formula + "\n";
}

struct FormulaFilesTest : testing::Test {
    fs::path folder = test::scratchFolder();
    FormulaFiles files;
    LoadedAssets assets;
    Scene scene;
    int writes = 0;

    FormulaFilesTest() {
        Transfer transfer;
        transfer.kind = LibraryTransfer{"ripple.stf", true, {}};
        scene.transfers["ripple"] = transfer;
    }
    /// Writes the file so that its time surely differs from the last one's.
    void write(const std::string& formula) {
        std::ofstream(folder / "ripple.stf") << ripple(formula);
        fs::last_write_time(folder / "ripple.stf", fs::file_time_type::clock::now() + std::chrono::seconds(++writes));
    }
    std::vector<FormulaFiles::News> refresh(bool always = false) {
        return files.refresh(scene, folder, assets, always);
    }
};

TEST_F(FormulaFilesTest, WhatTheSceneNamesIsReadOnce) {
    write("z + height * x");
    EXPECT_THAT(refresh(), IsEmpty());
    ASSERT_TRUE(assets.transfers.contains("ripple.stf"));
    const TransferDefinitionPtr read = assets.transfers.at("ripple.stf");
    EXPECT_EQ(read->title(), "Ripple");
    EXPECT_THAT(refresh(), IsEmpty());
    EXPECT_EQ(assets.transfers.at("ripple.stf"), read);
}

TEST_F(FormulaFilesTest, AChangedFileIsReadAgainAndTold) {
    write("z");
    refresh();
    const TransferDefinitionPtr before = assets.transfers.at("ripple.stf");
    write("z + 1");
    const auto news = refresh();
    ASSERT_EQ(news.size(), 1u);
    EXPECT_FALSE(news[0].problem);
    EXPECT_NE(assets.transfers.at("ripple.stf"), before);
}

TEST_F(FormulaFilesTest, AMistakeIsToldOnceWithItsCaretAndTheLastGoodVersionStays) {
    write("z");
    refresh();
    const TransferDefinitionPtr good = assets.transfers.at("ripple.stf");
    write("z + * 2");
    const auto news = refresh();
    ASSERT_EQ(news.size(), 1u);
    EXPECT_TRUE(news[0].problem);
    EXPECT_THAT(news[0].text, HasSubstr("z + * 2\n        ^"));
    EXPECT_EQ(assets.transfers.at("ripple.stf"), good);
    EXPECT_THAT(files.problem("ripple.stf"), HasSubstr("^"));
    EXPECT_THAT(refresh(), IsEmpty());
    write("z + 2");
    EXPECT_EQ(refresh().size(), 1u);
    EXPECT_EQ(files.problem("ripple.stf"), "");
}

TEST_F(FormulaFilesTest, AFileThatGoesAwayIsAProblemButNotALoss) {
    write("z");
    refresh();
    fs::remove(folder / "ripple.stf");
    const auto news = refresh();
    ASSERT_EQ(news.size(), 1u);
    EXPECT_TRUE(news[0].problem);
    EXPECT_TRUE(assets.transfers.contains("ripple.stf"));
}

TEST_F(FormulaFilesTest, ReloadingReadsWhatDidNotChangeToo) {
    write("z");
    refresh();
    const TransferDefinitionPtr before = assets.transfers.at("ripple.stf");
    EXPECT_EQ(refresh(true).size(), 1u);
    EXPECT_NE(assets.transfers.at("ripple.stf"), before);
}

TEST_F(FormulaFilesTest, AFileThatWasNeverRightIsNotThere) {
    write("z +");
    EXPECT_EQ(refresh().size(), 1u);
    EXPECT_FALSE(assets.transfers.contains("ripple.stf"));
    EXPECT_THROW(files.read("ripple.stf", folder, assets), Error);
    EXPECT_FALSE(assets.transfers.contains("ripple.stf"));
}

TEST_F(FormulaFilesTest, TheFoldersFilesAndTheRecentOnesAreListed) {
    for (const char* name : {"b.stf", "a.stf", "c.txt"}) std::ofstream(folder / name) << "x";
    EXPECT_THAT(formulaFilesIn(folder), ElementsAre(folder / "a.stf", folder / "b.stf"));
    EXPECT_THAT(formulaFilesIn(folder / "nowhere"), IsEmpty());
    files.remember("/x/one.stf");
    files.remember("/x/two.stf");
    files.remember("/x/one.stf");
    EXPECT_THAT(files.recent(), ElementsAre("/x/one.stf", "/x/two.stf"));
    for (int n = 0; n < 20; ++n) files.remember("/x/" + std::to_string(n));
    EXPECT_EQ(files.recent().size(), 10u);
}

TEST_F(FormulaFilesTest, PathsAreWrittenRelativeToTheScene) {
    EXPECT_EQ(writtenPath("/a/b/c.stf", "/a/b"), "c.stf");
    EXPECT_EQ(writtenPath("/a/b/d/c.stf", "/a/b"), "d/c.stf");
    EXPECT_EQ(writtenPath("/a/c.stf", "/a/b"), "/a/c.stf");
}

}  // namespace
}  // namespace voledit
