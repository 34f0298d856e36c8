// Volumes of pictures: folders, patterns, pages.

#include <gmock/gmock.h>

#include "tests/core/io/picture_files.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using test::counting;
using test::pngBytes;
using test::tiffBytes;
using test::valuesOf;

class Stacks : public testing::Test {
protected:
    /// 2×1 slice that holds `value` twice.
    void slice(const std::string& name, std::uint8_t value) {
        test::writeFile(folder_ / name, pngBytes(2, std::vector<std::uint8_t>{value, value}));
    }
    /// First value of each slice.
    std::vector<int> slicesOf(const fs::path& path) {
        const auto volume = io_.readVolume(path).volume;
        std::vector<int> values;
        for (int k = 0; k < volume->grid().size.z; ++k) values.push_back(int(volume->at({0, 0, k})));
        return values;
    }

    fs::path folder_ = test::scratchFolder();
    IoClient io_;
};

TEST_F(Stacks, FolderGoesByTheNumbersInNames) {
    for (const int n : {10, 9, 2, 1, 100}) slice("cut" + std::to_string(n) + ".png", std::uint8_t(n));
    test::writeFile(folder_ / "notes.txt", "not a slice");
    EXPECT_EQ(slicesOf(folder_), (std::vector<int>{1, 2, 9, 10, 100}));
    EXPECT_EQ(slicesOf(folder_.string() + "/"), (std::vector<int>{1, 2, 9, 10, 100}));
}

TEST_F(Stacks, PatternsChoose) {
    for (const int n : {1, 2, 3}) slice("a_00" + std::to_string(n) + ".png", std::uint8_t(n));
    slice("b_001.png", 50);
    EXPECT_EQ(slicesOf(folder_ / "a_%03d.png"), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(slicesOf(folder_ / "a_*.png"), (std::vector<int>{1, 2, 3}));
    EXPECT_EQ(slicesOf(folder_ / "*_001.png"), (std::vector<int>{1, 50}));
    EXPECT_THAT(test::rejection(io_, folder_ / "c_*.png"), testing::HasSubstr("matches no"));
}

TEST_F(Stacks, WarnOfTheFirstNumberThatIsMissing) {
    const auto warningsOf = [&](const std::filesystem::path& path) { return io_.readVolume(path).warnings; };
    for (const int n : {8, 9, 10, 12, 15}) slice("a" + std::to_string(n) + "_v2.png", std::uint8_t(n));
    const auto gap = testing::ElementsAre(testing::HasSubstr("number 11 is missing behind a10_v2.png"));
    EXPECT_THAT(warningsOf(folder_), gap);
    EXPECT_THAT(warningsOf(folder_ / "a%d_v2.png"), gap);
    EXPECT_THAT(warningsOf(folder_ / "a*.png"), gap);
    EXPECT_EQ(slicesOf(folder_), (std::vector<int>{8, 9, 10, 12, 15}));
    EXPECT_THAT(warningsOf(folder_ / "a1*_v2.png"), testing::ElementsAre(testing::HasSubstr("number 11 ")));
    slice("b1.png", 1);
    slice("b3.png", 3);
    EXPECT_THAT(warningsOf(folder_ / "b*.png"), testing::ElementsAre(testing::HasSubstr("number 2 ")));
}

TEST_F(Stacks, DoNotWarnOfNumbersThatCountInSteps) {
    for (const int n : {0, 5, 10, 15}) slice("z_" + std::to_string(n) + ".png", std::uint8_t(n));
    EXPECT_THAT(io_.readVolume(folder_).warnings, testing::IsEmpty());
    slice("z_25.png", 25);
    EXPECT_THAT(io_.readVolume(folder_).warnings, testing::ElementsAre(testing::HasSubstr("number 20 ")));
    slice("other_9.png", 1);
    EXPECT_THAT(io_.readVolume(folder_).warnings, testing::IsEmpty()) << "names that count nothing";
}

TEST_F(Stacks, TakeTheSpacingThatIsGiven) {
    slice("a1.png", 1);
    slice("a2.png", 2);
    ReadOptions options;
    options.spacing = Vec3(0.5, 0.25, 3);
    EXPECT_EQ(io_.readVolume(folder_, options).volume->grid().spacing(), Vec3(0.5, 0.25, 3));
    EXPECT_EQ(io_.readVolume(folder_).volume->grid().spacing(), Vec3(1));
    options.spacing = Vec3(1, 0, 1);
    EXPECT_THROW(io_.readVolume(folder_, options), Error);
}

TEST_F(Stacks, RowsRunDown) {
    const auto path = test::writeFile(folder_ / "one.png", pngBytes(2, std::vector<std::uint16_t>{1, 2, 3, 40000}));
    const auto file = io_.readVolume(path);
    EXPECT_EQ(file.format, "png");
    EXPECT_EQ(file.volume->type(), VoxelType::UInt16);
    EXPECT_EQ(file.volume->grid().size, Index3(2, 2, 1));
    EXPECT_EQ(valuesOf(*file.volume), (std::vector<double>{1, 2, 3, 40000}));
}

TEST_F(Stacks, PagesOfATiffInBothByteOrders) {
    for (const bool big : {false, true}) {
        const auto check = [&]<class T>(T, VoxelType type) {
            const auto path = test::writeFile(folder_ / "pages.tif",
                                              tiffBytes<T>(2, {counting<T>(4, T(1)), counting<T>(4, T(5))}, big));
            const auto file = io_.readVolume(path);
            EXPECT_EQ(file.format, "tiff");
            EXPECT_EQ(file.volume->type(), type);
            EXPECT_EQ(file.volume->grid().size, Index3(2, 2, 2));
            EXPECT_EQ(valuesOf(*file.volume), counting<double>(8, 1));
            EXPECT_THAT(file.warnings, testing::IsEmpty());
        };
        check(std::int8_t{}, VoxelType::Int8);
        check(std::uint8_t{}, VoxelType::UInt8);
        check(std::int16_t{}, VoxelType::Int16);
        check(std::uint16_t{}, VoxelType::UInt16);
        check(std::int32_t{}, VoxelType::Int32);
        check(std::uint32_t{}, VoxelType::UInt32);
        check(float{}, VoxelType::Float);
        check(double{}, VoxelType::Double);
    }
}

TEST_F(Stacks, FolderOfTiffs) {
    for (const std::uint16_t n : {1, 2})
        test::writeFile(folder_ / ("a" + std::to_string(n) + ".tif"), tiffBytes<std::uint16_t>(2, {{n, n}}));
    EXPECT_EQ(slicesOf(folder_), (std::vector<int>{1, 2}));
    test::writeFile(folder_ / "a3.tif", tiffBytes<std::uint16_t>(2, {{3, 3}, {4, 4}}));
    EXPECT_THAT(test::rejection(io_, folder_), testing::HasSubstr("a3.tif"));
}

TEST_F(Stacks, MixedKindsAreSaid) {
    slice("a1.png", 1);
    slice("a2.png", 2);
    test::writeFile(folder_ / "b.tif", tiffBytes<std::uint8_t>(2, {{3, 3}}));
    const auto file = io_.readVolume(folder_);
    EXPECT_EQ(file.volume->grid().size.z, 2);
    EXPECT_EQ(file.warnings.size(), 1u);
}

TEST_F(Stacks, SlicesMustBeAlike) {
    slice("a1.png", 1);
    test::writeFile(folder_ / "a2.png", pngBytes(3, std::vector<std::uint8_t>{1, 2, 3}));
    EXPECT_THAT(test::rejection(io_, folder_), testing::HasSubstr("a2.png"));
    test::writeFile(folder_ / "a2.png", pngBytes(2, std::vector<std::uint16_t>{1, 2}));
    EXPECT_THAT(test::rejection(io_, folder_), testing::HasSubstr("a2.png"));
    const auto pages = test::writeFile(folder_ / "p.tif", tiffBytes<std::uint8_t>(2, {{3, 3}, {4, 4, 4, 4}}));
    EXPECT_THAT(test::rejection(io_, pages), testing::HasSubstr("page 2"));
}

TEST_F(Stacks, AnEmptyFolderIsSaid) {
    EXPECT_THAT(test::rejection(io_, folder_), testing::HasSubstr("folder"));
}

TEST(Dicom, OneFileStandsForItsSeries) {
    VOLEDIT_SHARED_OR_SKIP(folder, "data/volumes/brain_dicom");
    IoClient io;
    const auto whole = io.readVolume(folder).volume;
    const auto one = io.readVolume(folder / "36749838.dcm").volume;
    EXPECT_EQ(whole->grid(), one->grid());
    EXPECT_TRUE(std::ranges::equal(whole->voxels(), one->voxels()));
}

TEST(Dicom, SaysWhereSlicesAreMissing) {
    VOLEDIT_SHARED_OR_SKIP(folder, "data/volumes/brain_dicom");
    const fs::path copy = test::scratchFolder();
    IoClient io;
    const Mat4 before = io.readVolume(folder).volume->grid().worldFromIndex;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::ranges::sort(files);
    for (std::size_t i = 0; i < files.size(); ++i)
        if (i != 7) fs::copy_file(files[i], copy / files[i].filename());
    const auto file = io.readVolume(copy);
    EXPECT_EQ(file.volume->grid().size.z, 15);
    EXPECT_THAT(file.warnings, testing::ElementsAre(testing::HasSubstr("apart")));
    EXPECT_EQ(file.volume->grid().origin(), Vec3(before[3]));
}

TEST(Dicom, LooksBelowWhereTheFolderHasNone) {
    VOLEDIT_SHARED_OR_SKIP(folder, "data/volumes/brain_dicom");
    const fs::path copy = test::scratchFolder();
    fs::create_directories(copy / "patient" / "series");
    for (const auto& entry : fs::directory_iterator(folder))
        fs::copy_file(entry.path(), copy / "patient" / "series" / entry.path().filename());
    test::writeFile(copy / "DICOMDIR", std::string(128, '\0') + "DICM");
    IoClient io;
    EXPECT_EQ(io.readVolume(copy).volume->grid().size.z, 16);
}

}  // namespace
}  // namespace voledit
