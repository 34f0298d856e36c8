#include "app/editor/folder_listing.h"

#include <fstream>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

fs::path exampleFolder() {
    const fs::path folder = test::scratchFolder();
    fs::create_directory(folder / "Scans");
    for (const char* name : {"b.nrrd", "A.nii.gz", "notes.txt", ".hidden.nrrd", "scan.voledit"})
        std::ofstream(folder / name) << "x";
    return folder;
}

TEST(FolderListing, FoldersFirstThenWhatCanBeOpened) {
    const fs::path folder = exampleFolder();
    std::string problem;
    const auto entries = listFolder(folder, FileKinds::Openable, problem);
    EXPECT_TRUE(problem.empty());
    ASSERT_EQ(entries.size(), 4u);
    EXPECT_EQ(entries[0], (BrowserEntry{"Scans", true, 0}));
    EXPECT_EQ(entries[1], (BrowserEntry{"A.nii.gz", false, 1}));
    EXPECT_EQ(entries[2].name, "b.nrrd");
    EXPECT_EQ(listFolder(folder, FileKinds::All, problem).size(), 5u);
}

TEST(FolderListing, AFolderThatIsNotThereSaysSo) {
    std::string problem;
    EXPECT_TRUE(listFolder("/nowhere/at/all", FileKinds::Openable, problem).empty());
    EXPECT_NE(problem.find("/nowhere/at/all"), std::string::npos);
}

TEST(FolderListing, TypedPaths) {
    EXPECT_EQ(pathFromText("/a/b/../c", "/x"), "/a/c");
    EXPECT_EQ(pathFromText("b.nrrd", "/x/y"), "/x/y/b.nrrd");
    EXPECT_EQ(pathFromText("/a/b/", "/x"), "/a/b");
    EXPECT_EQ(pathFromText("/", "/x"), "/");
    EXPECT_EQ(pathFromText("..", "/x/y"), "/x");
}

TEST(FolderListing, CompletionStopsWhereNamesPart) {
    const fs::path folder = exampleFolder();
    const std::string base = folder.string() + "/";
    EXPECT_EQ(completed(base + "Sc", folder, FileKinds::Openable), base + "Scans/");
    EXPECT_EQ(completed(base + "b", folder, FileKinds::Openable), base + "b.nrrd");
    EXPECT_EQ(completed("sc", folder, FileKinds::Openable), "scan.voledit");
    EXPECT_EQ(completed(base + "z", folder, FileKinds::Openable), base + "z");
}

TEST(FolderListing, Sizes) {
    EXPECT_EQ(sizeText(0), "0 B");
    EXPECT_EQ(sizeText(1500), "1.5 KB");
    EXPECT_EQ(sizeText(24'000'000), "24 MB");
}

}  // namespace
}  // namespace voledit
