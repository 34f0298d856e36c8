// Volumes beyond the memory limit, read at reduced resolution.

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "core/io/reduced_volumes.h"
#include "tests/core/io/files.h"

namespace voledit {
namespace {

// More than a header takes while it is read, less than the volumes.
constexpr std::size_t kLimit = 4 << 20;

template <class T>
std::vector<T> noise(std::size_t count) {
    std::mt19937 random(1);
    std::vector<T> values(count);
    for (T& v : values) v = T(std::uniform_real_distribution<double>(-100, 100)(random));
    return values;
}

/// The mean of a box of values, rounded where they are whole.
template <class T>
double meanOf(const std::vector<T>& values, Index3 size, int channels, Index3 at, Index3 box, int c) {
    double sum = 0;
    for (int z = at.z * box.z; z < (at.z + 1) * box.z; ++z)
        for (int y = at.y * box.y; y < (at.y + 1) * box.y; ++y)
            for (int x = at.x * box.x; x < (at.x + 1) * box.x; ++x)
                sum += double(values[std::size_t(((z * size.y + y) * size.x + x) * channels + c)]);
    const double mean = sum / (box.x * box.y * box.z);
    return std::is_integral_v<T> ? std::round(mean) : double(T(mean));
}

class Reduced : public testing::Test {
protected:
    VolumeFile read(const std::string& header, const std::string& data) {
        ReadOptions options;
        options.memoryLimit = kLimit;
        setMayReduceVolumes(true);
        auto file = io_.readVolume(test::writeFile(folder_ / "a.nrrd", "NRRD0005\n" + header + "\n" + data), options);
        setMayReduceVolumes(false);
        return file;
    }

    template <class T>
    void expectMeans(const Volume& volume, const std::vector<T>& values, Index3 size, Index3 box) {
        const VolumeGrid& grid = volume.grid();
        ASSERT_EQ(grid.size, size / box);
        ASSERT_LE(volume.voxels().size(), kLimit);
        for (int k = 0; k < grid.size.z; ++k)
            for (int j = 0; j < grid.size.y; ++j)
                for (int i = 0; i < grid.size.x; ++i)
                    for (int c = 0; c < grid.channels; ++c)
                        ASSERT_EQ(volume.at({i, j, k}, c), meanOf(values, size, grid.channels, {i, j, k}, box, c));
    }

    std::filesystem::path folder_ = test::scratchFolder();
    IoClient io_;
};

TEST_F(Reduced, GivesMeansOfBoxesWithAWarning) {
    const Index3 size(165, 120, 141);
    const auto values = noise<std::int16_t>(165 * 120 * 141);
    for (const bool big : {false, true}) {
        const auto file = read(std::string("type: int16\ndimension: 3\nsizes: 165 120 141\nencoding: raw\nendian: ") +
                                   (big ? "big" : "little") + "\nspacings: 1 2 3\n",
                               test::bytesOf(values, big));
        expectMeans(*file.volume, values, size, Index3(2));
        EXPECT_EQ(file.volume->grid().spacing(), Vec3(2, 4, 6));
        EXPECT_EQ(file.volume->grid().origin(), Vec3(0.5, 1, 1.5)) << "the middle of the first box";
        ASSERT_EQ(file.warnings.size(), 1u);
        EXPECT_THAT(file.warnings[0], testing::HasSubstr("reduced resolution, 82x60x70"));
        EXPECT_THAT(file.warnings[0], testing::HasSubstr("--memory-limit"));
    }
}

TEST_F(Reduced, TakesCompressedAndRealAndInterleavedValues) {
    const Index3 size(80, 133, 72);
    const auto values = noise<float>(80 * 133 * 72 * 2);
    for (const bool gzip : {false, true}) {
        std::string header =
            "type: float\ndimension: 4\nkinds: vector domain domain domain\nsizes: 2 80 133 72\nendian: little\n";
        header += gzip ? "encoding: gzip\n" : "encoding: raw\n";
        const auto file = read(header, gzip ? test::gzipped(test::bytesOf(values)) : test::bytesOf(values));
        ASSERT_EQ(file.volume->grid().channels, 2);
        expectMeans(*file.volume, values, size, Index3(2));
    }
}

TEST_F(Reduced, HalvesUntilItFitsAndLeavesFlatAxesAlone) {
    const auto values = noise<std::uint8_t>(6400 * 4800 * 2);
    const auto file = read("type: uint8\ndimension: 3\nsizes: 6400 4800 2\nencoding: raw\n", test::bytesOf(values));
    expectMeans(*file.volume, values, {6400, 4800, 2}, {4, 4, 2});
}

TEST_F(Reduced, ReadsWholeWhatFits) {
    const auto values = noise<std::uint8_t>(20 * 20 * 20);
    const auto file = read("type: uint8\ndimension: 3\nsizes: 20 20 20\nencoding: raw\n", test::bytesOf(values));
    EXPECT_EQ(file.volume->grid().size, Index3(20));
    EXPECT_TRUE(file.warnings.empty());
}

TEST_F(Reduced, AppliesSlopeAndInterceptToTheMeans) {
    const auto values = noise<std::int16_t>(160 * 120 * 120);
    setMayReduceVolumes(true);
    const auto file =
        io_.readVolume(test::writeFile(folder_ / "a.mha",
                                       "ObjectType = Image\nNDims = 3\nDimSize = 160 120 120\nElementType = MET_SHORT\n"
                                       "ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -5\n"
                                       "ElementDataFile = LOCAL\n" +
                                           test::bytesOf(values)),
                       {.raw = {}, .spacing = {}, .memoryLimit = kLimit});
    setMayReduceVolumes(false);
    const int factor = 160 / file.volume->grid().size.x;
    EXPECT_GE(factor, 2);
    EXPECT_EQ(file.volume->at({1, 2, 3}), 2 * meanOf(values, {160, 120, 120}, 1, {1, 2, 3}, Index3(factor), 0) - 5);
}

TEST_F(Reduced, RefusesWhatIsCutOff) {
    const auto path = test::writeFile(folder_ / "a.nrrd",
                                      "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 180 180 180\nencoding: raw\n\n" +
                                          std::string(180 * 180 * 179, 'x'));
    ReadOptions options;
    options.memoryLimit = kLimit;
    setMayReduceVolumes(true);
    EXPECT_THAT(test::rejection(io_, path, options), testing::HasSubstr("cut off"));
    setMayReduceVolumes(false);
}

TEST_F(Reduced, IsAnErrorWhereItWasNotAskedFor) {
    const auto path = test::writeFile(folder_ / "a.nrrd",
                                      "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 180 180 180\nencoding: raw\n\n" +
                                          std::string(180 * 180 * 180, 'x'));
    ReadOptions options;
    options.memoryLimit = kLimit;
    EXPECT_THAT(test::rejection(io_, path, options), testing::HasSubstr("--memory-limit"));
}

TEST_F(Reduced, ReadsLargeFilesBytePerByteInParallel) {
    // Several chunks, an odd offset, a length that no page divides.
    std::mt19937 random(2);
    std::string data(9'000'011, '\0');
    for (char& c : data) c = char(random());
    const auto file = io_.readVolume(test::writeFile(
        folder_ / "b.nrrd", "NRRD0005\ntype: uint8\ndimension: 3\nsizes: 9000011 1 1\nencoding: raw\n\n" + data));
    const auto voxels = file.volume->voxels();
    ASSERT_EQ(voxels.size(), data.size());
    EXPECT_EQ(std::memcmp(voxels.data(), data.data(), data.size()), 0);
}

}  // namespace
}  // namespace voledit
