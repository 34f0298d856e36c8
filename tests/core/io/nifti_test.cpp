#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/core/io/files.h"

namespace voledit {
namespace {

using test::bytesOf;
using test::counting;
using test::NiftiBytes;
using test::valuesOf;

class Nifti : public testing::Test {
protected:
    VolumeFile read(const NiftiBytes& header, const std::string& data) {
        const auto path = test::writeFile(folder_ / "a.nii", header.bytes() + data);
        const auto packed = test::writeFile(folder_ / "a.nii.gz", test::gzipped(header.bytes() + data));
        const VolumeFile plain = io_.readVolume(path), zipped = io_.readVolume(packed);
        EXPECT_TRUE(std::ranges::equal(plain.volume->voxels(), zipped.volume->voxels()));
        EXPECT_EQ(plain.volume->grid(), zipped.volume->grid());
        return plain;
    }

    std::filesystem::path folder_ = test::scratchFolder();
    IoClient io_;
};

/// LPS from RAS.
Mat4 lps(const Mat4& ras) {
    return glm::scale(Mat4(1), Vec3(-1, -1, 1)) * ras;
}

TEST_F(Nifti, KeepsAShearedSform) {
    const Mat4 ras{{1, 0.5, 0, 0}, {0.25, 2, 0, 0}, {0.5, -0.5, 3, 0}, {4, 5, 6, 1}};
    const auto file = read(NiftiBytes({3, 1, 1, 2}, 2, 8).sform(ras), "AB");
    EXPECT_EQ(file.volume->grid().worldFromIndex, lps(ras));
}

TEST_F(Nifti, PrefersTheSformAndConvertsItsUnits) {
    const Mat4 ras = glm::scale(Mat4(1), Vec3(2));
    auto header = NiftiBytes({3, 1, 1, 1}, 2, 8).sform(ras).put(252, std::int16_t(1));
    EXPECT_EQ(read(header, "A").volume->grid().worldFromIndex, lps(ras));
    header.put(123, char(1));
    EXPECT_EQ(read(header, "A").volume->grid().spacing(), Vec3(2000));
    header.put(123, char(3 | 8));
    EXPECT_NEAR(read(header, "A").volume->grid().spacing().x, 0.002, 1e-12);
}

TEST_F(Nifti, ReadsTheQform) {
    // A quarter turn about z: a = d = √½; qfac −1 turns the third axis round.
    auto header = NiftiBytes({3, 1, 1, 1}, 2, 8);
    header.put(252, std::int16_t(1)).put(264, float(std::sqrt(0.5)));
    header.put(80, 2.0f).put(84, 3.0f).put(88, 4.0f).put(268, 5.0f).put(272, 6.0f).put(276, 7.0f);
    const Mat4 turned{{0, 2, 0, 0}, {-3, 0, 0, 0}, {0, 0, 4, 0}, {5, 6, 7, 1}};
    test::expectNear(read(header, "A").volume->grid().worldFromIndex, lps(turned), 1e-6);
    header.put(76, -1.0f);
    Mat4 flipped = turned;
    flipped[2] = Vec4(0, 0, -4, 0);
    test::expectNear(read(header, "A").volume->grid().worldFromIndex, lps(flipped), 1e-6);
}

TEST_F(Nifti, TakesSpacingsWhereNothingElseIsSaid) {
    const auto file = read(NiftiBytes({3, 1, 1, 1}, 2, 8).put(80, 2.0f).put(84, 3.0f), "A");
    EXPECT_EQ(file.volume->grid().worldFromIndex, lps(glm::scale(Mat4(1), Vec3(2, 3, 1))));
    EXPECT_EQ(file.warnings.size(), 1u);
}

TEST_F(Nifti, RescalesToTheTypeThatHoldsTheResult) {
    const auto values = std::vector<std::uint16_t>{0, 1000, 4000, 2};
    auto header = NiftiBytes({3, 4, 1, 1}, 512, 16).sform(Mat4(1));
    header.put(112, 1.0f).put(116, -1024.0f);
    const auto whole = read(header, bytesOf(values));
    EXPECT_EQ(whole.volume->type(), VoxelType::Int16);
    EXPECT_EQ(whole.storedType, "uint16");
    EXPECT_EQ(valuesOf(*whole.volume), (std::vector<double>{-1024, -24, 2976, -1022}));
    EXPECT_EQ(whole.volume->statistics().min, -1024);
    header.put(112, 0.5f);
    const auto real = read(header, bytesOf(values));
    EXPECT_EQ(real.volume->type(), VoxelType::Float);
    EXPECT_EQ(valuesOf(*real.volume), (std::vector<double>{-1024, -524, 976, -1023}));
    header.put(112, 0.0f);  // means none
    EXPECT_EQ(read(header, bytesOf(values)).volume->type(), VoxelType::UInt16);
    header.put(112, 100.0f).put(116, 0.0f);
    EXPECT_EQ(read(header, bytesOf(values)).volume->type(), VoxelType::Int32);
}

TEST_F(Nifti, ReadsEveryDatatype) {
    const auto check = [&]<class T>(T, std::int16_t code, VoxelType type) {
        const auto file = read(NiftiBytes({3, 2, 2, 2}, code, std::int16_t(8 * sizeof(T))).sform(Mat4(1)),
                               bytesOf(counting<T>(8, T(1))));
        EXPECT_EQ(file.volume->type(), type) << code;
        EXPECT_EQ(valuesOf(*file.volume), counting<double>(8, 1)) << code;
    };
    check(std::int8_t{}, 256, VoxelType::Int8);
    check(std::uint8_t{}, 2, VoxelType::UInt8);
    check(std::int16_t{}, 4, VoxelType::Int16);
    check(std::uint16_t{}, 512, VoxelType::UInt16);
    check(std::int32_t{}, 8, VoxelType::Int32);
    check(std::uint32_t{}, 768, VoxelType::UInt32);
    check(float{}, 16, VoxelType::Float);
    check(double{}, 64, VoxelType::Double);
    check(std::int64_t{}, 1024, VoxelType::Double);
    check(std::uint64_t{}, 1280, VoxelType::Double);
}

TEST_F(Nifti, ReadsColoursAndComponents) {
    const auto rgb = read(NiftiBytes({3, 2, 1, 1}, 128, 24).sform(Mat4(1)), "abcdef");
    EXPECT_EQ(rgb.volume->grid().channels, 3);
    EXPECT_EQ(valuesOf(*rgb.volume), counting<double>(6, 97));
    // Components of the fifth dimension are planes.
    const auto vectors = read(NiftiBytes({5, 2, 1, 1, 1, 3}, 2, 8).sform(Mat4(1)), "abcdef");
    EXPECT_EQ(vectors.volume->grid().channels, 3);
    EXPECT_EQ(valuesOf(*vectors.volume), (std::vector<double>{97, 99, 101, 98, 100, 102}));
    EXPECT_THAT(vectors.warnings, testing::IsEmpty());
}

TEST_F(Nifti, ShowsTheFirstTimeStep) {
    const auto file = read(NiftiBytes({4, 2, 1, 1, 3}, 2, 8).sform(Mat4(1)), "abcdef");
    EXPECT_EQ(valuesOf(*file.volume), (std::vector<double>{97, 98}));
    EXPECT_THAT(file.warnings, testing::ElementsAre(testing::HasSubstr("3 time steps")));
}

TEST_F(Nifti, WarnsOfDataBeyondWhatIsClaimed) {
    EXPECT_EQ(read(NiftiBytes({3, 2, 1, 1}, 2, 8).sform(Mat4(1)), "abX").warnings.size(), 1u);
}

TEST_F(Nifti, ReadsAPairOfFiles) {
    auto header = NiftiBytes({3, 2, 1, 1}, 2, 8).sform(Mat4(1)).put(344, 'n').put(345, 'i').put(108, 0.0f);
    test::writeFile(folder_ / "pair.hdr", header.bytes());
    test::writeFile(folder_ / "pair.img", "ab");
    EXPECT_EQ(valuesOf(*io_.readVolume(folder_ / "pair.hdr").volume), (std::vector<double>{97, 98}));
}

}  // namespace
}  // namespace voledit
