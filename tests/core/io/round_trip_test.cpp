// What is written reads back the same: every format, type, number of channels and placement.

#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "core/fields/statistics.h"
#include "tests/core/io/files.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using test::expectNear;
using test::valuesOf;

/// Oblique, flipped and sheared, all in numbers that float holds exactly, as NIfTI must.
Mat4 oblique() {
    Mat4 m(1);
    m[0] = Vec4(0.75, 0.25, -0.125, 0);
    m[1] = Vec4(0.25, -1.5, 0.0625, 0);
    m[2] = Vec4(0.5, 0.125, 2, 0);
    m[3] = Vec4(-10.5, 20.25, 3, 1);
    return m;
}

VolumeGrid gridOf(int channels) {
    VolumeGrid grid;
    grid.size = {7, 5, 3};
    grid.channels = channels;
    grid.worldFromIndex = oblique();
    return grid;
}

/// Random values over the type's whole range, its ends among them.
template <class T>
std::shared_ptr<const Volume> randomVolume(int channels) {
    const VolumeGrid grid = gridOf(channels);
    std::mt19937 random(7);
    std::vector<T> values(grid.valueCount());
    if constexpr (std::is_integral_v<T>) {
        std::uniform_int_distribution<std::int64_t> all(std::numeric_limits<T>::min(), std::numeric_limits<T>::max());
        for (T& v : values) v = T(all(random));
        values[0] = std::numeric_limits<T>::min();
        values[1] = std::numeric_limits<T>::max();
    } else {
        std::uniform_real_distribution<T> all(T(-1e6), T(1e6));
        for (T& v : values) v = all(random);
    }
    return Volume::fromValues(grid, std::move(values));
}

std::shared_ptr<const Volume> randomVolume(VoxelType type, int channels) {
    switch (type) {
        case VoxelType::Int8:
            return randomVolume<std::int8_t>(channels);
        case VoxelType::UInt8:
            return randomVolume<std::uint8_t>(channels);
        case VoxelType::Int16:
            return randomVolume<std::int16_t>(channels);
        case VoxelType::UInt16:
            return randomVolume<std::uint16_t>(channels);
        case VoxelType::Int32:
            return randomVolume<std::int32_t>(channels);
        case VoxelType::UInt32:
            return randomVolume<std::uint32_t>(channels);
        case VoxelType::Float:
            return randomVolume<float>(channels);
        case VoxelType::Double:
            break;
    }
    return randomVolume<double>(channels);
}

class RoundTrip : public testing::TestWithParam<std::tuple<const char*, VoxelType, int>> {};

TEST_P(RoundTrip, GivesTheSameVolume) {
    const auto [ending, type, channels] = GetParam();
    const auto volume = randomVolume(type, channels);
    const fs::path folder = test::scratchFolder(), path = folder / (std::string("volume") + ending);
    IoClient io;
    io.writeVolume(*volume, path);
    const VolumeFile back = io.readVolume(path);

    const bool vdb = std::string(ending) == ".vdb";
    EXPECT_EQ(back.volume->type(), vdb ? VoxelType::Float : type);
    EXPECT_EQ(back.volume->grid().size, volume->grid().size);
    EXPECT_EQ(back.volume->grid().channels, channels);
    expectNear(back.volume->grid().worldFromIndex, oblique(), 1e-12);
    auto expected = valuesOf(*volume);
    if (vdb)
        for (double& v : expected) v = double(float(v));
    EXPECT_EQ(valuesOf(*back.volume), expected);
    EXPECT_THAT(back.warnings, testing::IsEmpty());
    if (!vdb) {
        EXPECT_EQ(back.volume->statistics().min, volume->statistics().min);
        EXPECT_EQ(countedStatistics(*back.volume).mean, volume->statistics().mean);
    }
    // Nothing but the files themselves.
    const auto files = std::distance(fs::directory_iterator(folder), fs::directory_iterator());
    const bool two = std::string(ending) == ".nhdr" || std::string(ending) == ".mhd";
    EXPECT_EQ(files, two ? 2 : 1);
}

INSTANTIATE_TEST_SUITE_P(, RoundTrip,
                         testing::Combine(testing::Values(".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd", ".vdb"),
                                          testing::Values(VoxelType::Int8, VoxelType::UInt8, VoxelType::Int16,
                                                          VoxelType::UInt16, VoxelType::Int32, VoxelType::UInt32,
                                                          VoxelType::Float, VoxelType::Double),
                                          testing::Values(1, 3)),
                         [](const auto& test) {
                             std::string name = std::string(std::get<0>(test.param)).substr(1);
                             std::ranges::replace(name, '.', '_');
                             return name + "_" + std::string(nameOf(std::get<1>(test.param))) + "_" +
                                    std::to_string(std::get<2>(test.param));
                         });

TEST(RoundTrips, KeepEveryBitOfThePlacementWhereTheFormatCan) {
    VolumeGrid grid = gridOf(1);
    grid.worldFromIndex = glm::rotate(Mat4(1), 0.3, Vec3(1, 2, 3)) * glm::scale(Mat4(1), Vec3(0.1, 0.7, 1.3));
    const auto volume = Volume::fromValues(grid, test::counting<std::uint8_t>(grid.valueCount()));
    const fs::path folder = test::scratchFolder();
    IoClient io;
    for (const char* name : {"a.nrrd", "a.nhdr", "a.vdb"}) {
        io.writeVolume(*volume, folder / name);
        EXPECT_EQ(io.readVolume(folder / name).volume->grid(), grid) << name;
    }
    io.writeVolume(*volume, folder / "a.mhd");  // direction and spacing apart: a rounding error
    expectNear(io.readVolume(folder / "a.mhd").volume->grid().worldFromIndex, grid.worldFromIndex, 1e-15);
    io.writeVolume(*volume, folder / "a.nii");  // float by its definition
    expectNear(io.readVolume(folder / "a.nii").volume->grid().worldFromIndex, grid.worldFromIndex, 1e-6);
}

TEST(RoundTrips, KeepWhatIsNotANumber) {
    const VolumeGrid grid = gridOf(1);
    std::vector<float> values(grid.valueCount(), 1.0f);
    values[3] = std::numeric_limits<float>::quiet_NaN();
    values[4] = std::numeric_limits<float>::infinity();
    const auto volume = Volume::fromValues(grid, values);
    const fs::path folder = test::scratchFolder();
    IoClient io;
    for (const char* name : {"a.nrrd", "a.nii.gz", "a.mha", "a.vdb"}) {
        io.writeVolume(*volume, folder / name);
        const auto back = valuesOf(*io.readVolume(folder / name).volume);
        EXPECT_TRUE(std::isnan(back[3])) << name;
        EXPECT_EQ(back[4], kInfinity) << name;
        EXPECT_EQ(back[5], 1) << name;
    }
}

TEST(RoundTrips, AnEmptyBorderOfAVdbIsKept) {
    VolumeGrid grid;
    grid.size = {20, 30, 40};
    std::vector<float> values(grid.valueCount(), 0.0f);
    values[10 + 20 * (10 + 30 * 10)] = 5;
    const fs::path path = test::scratchFolder() / "a.vdb";
    IoClient io;
    io.writeVolume(*Volume::fromValues(grid, values), path);
    const auto back = io.readVolume(path).volume;
    EXPECT_EQ(back->grid().size, grid.size);
    EXPECT_EQ(back->at({10, 10, 10}), 5);
}

TEST(Writing, ReplacesWhatIsThere) {
    const fs::path path = test::scratchFolder() / "a.nrrd";
    test::writeFile(path, "old");
    IoClient io;
    io.writeVolume(*randomVolume<float>(1), path);
    EXPECT_EQ(io.readVolume(path).format, "nrrd");
}

TEST(Writing, ThroughALinkReplacesWhatItLeadsTo) {
    const fs::path folder = test::scratchFolder();
    test::writeFile(folder / "real.nrrd", "old");
    fs::create_symlink("real.nrrd", folder / "link.nrrd");
    IoClient io;
    io.writeVolume(*randomVolume<float>(1), folder / "link.nrrd");
    EXPECT_TRUE(fs::is_symlink(folder / "link.nrrd"));
    EXPECT_EQ(io.readVolume(folder / "real.nrrd").format, "nrrd");
}

TEST(Writing, RefusesWhatItCannotDo) {
    const fs::path folder = test::scratchFolder();
    const auto volume = randomVolume<float>(1);
    IoClient io;
    const auto message = [&](const fs::path& path) -> std::string {
        try {
            io.writeVolume(*volume, path);
        } catch (const Error& error) {
            return error.what();
        }
        return "written";
    };
    EXPECT_THAT(message(folder / "a.xyz"), testing::HasSubstr(".nii.gz"));
    EXPECT_THAT(message(folder / "none" / "a.nrrd"), testing::HasSubstr("a.nrrd"));
    EXPECT_THAT(message(folder), testing::HasSubstr(folder.string()));
    EXPECT_THAT(message("/dev/null"), testing::HasSubstr("/dev/null"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Writing, RefusesAxesThatNiftiCannotCount) {
    VolumeGrid grid;
    grid.size = {40000, 1, 1};
    const fs::path folder = test::scratchFolder();
    IoClient io;
    EXPECT_THROW(io.writeVolume(*Volume::fromValues(grid, std::vector<std::uint8_t>(40000)), folder / "a.nii"), Error);
    EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace voledit
