// Deformation fields as registration tools write them: three components a sample, LPS millimetres, on oblique grids.

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <random>

#include "tests/core/io/files.h"

namespace voledit {
namespace {

const Index3 kSize{5, 4, 3};

/// An oblique grid, LPS.
Mat4 obliqueGrid() {
    // A rotation whose entries are 25ths.
    const Mat3 turn(Vec3(9, 12, 20) / 25.0, Vec3(-20, 15, 0) / 25.0, Vec3(-12, -16, 15) / 25.0);
    return Mat4(Vec4(1.5 * turn[0], 0), Vec4(2.0 * turn[1], 0), Vec4(2.5 * turn[2], 0), Vec4(-20, 35, 7, 1));
}

Vec3 displacement(const Vec3& p) {
    return {0.1 * p.y - 2, 0.05 * p.x + 0.2 * p.z, -0.3 * p.z + 1};
}

/// The displacement at every sample, its components side by side or in planes of their own.
std::vector<float> fieldValues(bool planes) {
    std::vector<float> values;
    for (int pass = 0; pass < (planes ? 3 : 1); ++pass)
        for (int k = 0; k < kSize.z; ++k)
            for (int j = 0; j < kSize.y; ++j)
                for (int i = 0; i < kSize.x; ++i) {
                    const Vec3 u = displacement(transformPoint(obliqueGrid(), {i, j, k}));
                    for (int c = planes ? pass : 0; c < (planes ? pass + 1 : 3); ++c) values.push_back(float(u[c]));
                }
    return values;
}

std::string numbers(std::initializer_list<double> values, const char* separator) {
    std::ostringstream text;
    text.precision(17);
    for (const double v : values) text << (text.tellp() > 0 ? separator : "") << v;
    return text.str();
}

class DeformationField : public testing::Test {
protected:
    /// The file's field is the displacement, everywhere within its grid.
    void expectDisplacement(const std::filesystem::path& path) {
        const VolumeFile file = io_.readVolume(path);
        ASSERT_EQ(file.volume->grid().size, kSize);
        ASSERT_EQ(file.volume->grid().channels, 3);
        test::expectNear(file.volume->grid().worldFromIndex, obliqueGrid(), 1e-5);
        std::mt19937 random(1);
        std::uniform_real_distribution<double> unit(0.01, 0.99);
        for (int n = 0; n < 100; ++n) {
            const Vec3 index = Vec3(unit(random), unit(random), unit(random)) * Vec3(kSize - 1);
            const Vec3 p = transformPoint(obliqueGrid(), index);
            for (int c = 0; c < 3; ++c) {
                double u = 0;
                file.volume->sample({&p, 1}, {&u, 1}, c);
                EXPECT_NEAR(u, displacement(p)[c], 1e-4) << path << " component " << c;
            }
        }
    }

    const std::filesystem::path folder_ = test::scratchFolder();
    const std::string interleaved_ = test::bytesOf(fieldValues(false)), planes_ = test::bytesOf(fieldValues(true));
    IoClient io_;
};

TEST_F(DeformationField, NrrdWithItsVectorAxisFirstOrLast) {
    const Mat4 m = obliqueGrid();
    std::string axes;
    for (int a = 0; a < 3; ++a) axes += " (" + numbers({m[a].x, m[a].y, m[a].z}, ",") + ")";
    const std::string common =
        "NRRD0004\ntype: float\ndimension: 4\nspace: left-posterior-superior\nendian: little\n"
        "encoding: raw\nspace origin: (" +
        numbers({m[3].x, m[3].y, m[3].z}, ",") + ")\n";
    for (const char* kind : {"vector", "3-vector", "covariant-vector"})
        expectDisplacement(test::writeFile(folder_ / "first.nrrd", common + "sizes: 3 5 4 3\nkinds: " + kind +
                                                                       " domain domain domain\nspace directions: none" +
                                                                       axes + "\n\n" + interleaved_));
    expectDisplacement(test::writeFile(
        folder_ / "last.nrrd", common + "sizes: 5 4 3 3\nkinds: domain domain domain vector\nspace directions:" + axes +
                                   " none\n\n" + planes_));
}

/// A float NIfTI of dims with the oblique grid, its values in planes.
test::NiftiBytes niftiHeader(std::vector<std::int16_t> dims, std::int16_t intent) {
    Mat4 ras = obliqueGrid();
    for (int c = 0; c < 4; ++c) ras[c] *= Vec4(-1, -1, 1, 1);
    return test::NiftiBytes(std::move(dims), 16, 32).sform(ras).put(68, intent);
}

TEST_F(DeformationField, NiftiOfFiveDimensions) {
    // As ITK and ANTs write them: the grid in RAS, the vectors' components in LPS as they are.
    for (const std::int16_t intent : {std::int16_t(1007), std::int16_t(0)}) {
        const std::string bytes = niftiHeader({5, 5, 4, 3, 1, 3}, intent).bytes() + planes_;
        expectDisplacement(test::writeFile(folder_ / "warp.nii", bytes));
        expectDisplacement(test::writeFile(folder_ / "warp.nii.gz", test::gzipped(bytes)));
    }
    EXPECT_THAT(io_.readVolume(folder_ / "warp.nii").warnings, testing::IsEmpty());
}

TEST_F(DeformationField, NiftiOfFourDimensionsWhereItsIntentSaysSo) {
    expectDisplacement(test::writeFile(folder_ / "warp.nii", niftiHeader({4, 5, 4, 3, 3}, 1007).bytes() + planes_));
    test::writeFile(folder_ / "time.nii", niftiHeader({4, 5, 4, 3, 3}, 0).bytes() + planes_);
    EXPECT_EQ(io_.readVolume(folder_ / "time.nii").volume->grid().channels, 1);
}

TEST_F(DeformationField, NiftiOfDisplacementIntentWarnsOfItsSigns) {
    expectDisplacement(test::writeFile(folder_ / "warp.nii", niftiHeader({5, 5, 4, 3, 1, 3}, 1006).bytes() + planes_));
    EXPECT_THAT(io_.readVolume(folder_ / "warp.nii").warnings, testing::ElementsAre(testing::HasSubstr("RAS")));
}

TEST_F(DeformationField, MetaImageOfThreeChannels) {
    const Mat4 m = obliqueGrid();
    const Vec3 spacing(1.5, 2, 2.5);
    std::string direction;
    for (int a = 0; a < 3; ++a) {
        const Vec3 d = Vec3(m[a]) / spacing[a];
        direction += numbers({d.x, d.y, d.z}, " ") + " ";
    }
    expectDisplacement(test::writeFile(
        folder_ / "warp.mha",
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n"
        "TransformMatrix = " +
            direction + "\nOffset = " + numbers({m[3].x, m[3].y, m[3].z}, " ") +
            "\nElementSpacing = 1.5 2 2.5\nDimSize = 5 4 3\nElementNumberOfChannels = 3\nElementType = MET_FLOAT\n"
            "ElementDataFile = LOCAL\n" +
            interleaved_));
}

TEST_F(DeformationField, OurOwnFilesReadBackTheSame) {
    VolumeGrid grid;
    grid.size = kSize;
    grid.channels = 3;
    grid.worldFromIndex = obliqueGrid();
    const auto volume = Volume::fromValues(grid, fieldValues(false));
    for (const char* name : {"own.nrrd", "own.nhdr", "own.nii", "own.nii.gz", "own.mha", "own.mhd"}) {
        io_.writeVolume(*volume, folder_ / name);
        expectDisplacement(folder_ / name);
    }
}

}  // namespace
}  // namespace voledit
