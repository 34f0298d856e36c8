// Headers with bytes changed at random: whatever comes of it, the client lives and answers.

#include <gtest/gtest.h>

#include <random>

#include "tests/core/io/picture_files.h"
#include "tests/core/io/vtk_files.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

/// `bytes` with one to four of the first `reach` replaced, dropped or doubled.
std::string mutated(std::string bytes, std::size_t reach, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
    for (std::size_t n = 1 + below(4); n > 0 && !bytes.empty(); --n) {
        const std::size_t at = below(std::min(reach, bytes.size()));
        const char interesting[] = {'\0', '\xff', '\x7f', '\x80', '0', '9', '-', ' ', '\n', '('};
        switch (below(4)) {
            case 0:
                bytes[at] = char(below(256));
                break;
            case 1:
                bytes[at] = interesting[below(sizeof interesting)];
                break;
            case 2:
                bytes.erase(at, 1 + below(8));
                break;
            default:
                bytes.insert(at, bytes.substr(at, 1 + below(8)));
        }
    }
    return bytes;
}

class Mutations : public testing::TestWithParam<const char*> {
protected:
    /// A sound small file of the kind.
    std::string sound() {
        const fs::path folder = test::scratchFolder();
        const std::string name = GetParam();
        if (name == "png") return test::pngBytes(8, test::counting<std::uint8_t>(64));
        if (name == "tif")
            return test::tiffBytes<std::uint16_t>(
                4, {test::counting<std::uint16_t>(16), test::counting<std::uint16_t>(16)});
        if (name == "vtk")
            return "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nORIGIN 0 0 0\n"
                   "SPACING 1 1 1\nPOINT_DATA 8\nSCALARS s int 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n";
        if (name == "text.vtk" || name == "bytes.vtk") {
            const test::VtkStyle style{name == "text.vtk", name == "text.vtk" ? 3 : 5};
            return test::vtkStart("UNSTRUCTURED_GRID", style) +
                   test::vtkPoints({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, style) +
                   test::vtkCells({{10, {0, 1, 2, 3}}, {10, {4, 1, 2, 3}}}, style) +
                   test::vtkScalars({1, 2, 3, 4, 5}, style);
        }
        if (name == "dcm") {
            const auto path = test::shared("data/volumes/brain_dicom/36749712.dcm");
            return path ? test::readFile(*path) : "";
        }
        VolumeGrid grid;
        grid.size = {5, 4, 3};
        const fs::path path = folder / ("sound." + name);
        io_.writeVolume(*Volume::fromValues(grid, test::counting<float>(grid.valueCount())), path);
        return test::readFile(path);
    }

    IoClient io_{{}, {.processorSeconds = 2, .wallSeconds = 60}};
};

TEST_P(Mutations, NeverHarmTheClient) {
    const std::string bytes = sound();
    if (bytes.empty()) GTEST_SKIP() << "shared test data is not there";
    const fs::path path = test::scratchFolder() / (std::string("mutated.") + GetParam());
    std::mt19937 random(20);
    ReadOptions options;
    options.memoryLimit = std::size_t(1) << 30;
    int read = 0, refused = 0;
    for (int n = 0; n < 200; ++n) {
        test::writeFile(path, mutated(bytes, std::max<std::size_t>(400, bytes.size() / 8), random));
        try {
            const auto file = io_.readVolumeOrMesh(path, options);
            if (const auto* mesh = std::get_if<MeshFile>(&file)) {
                EXPECT_EQ(mesh->mesh.values.size(), mesh->mesh.points.size() * std::size_t(mesh->mesh.channels));
                EXPECT_FALSE(mesh->mesh.tetrahedra.empty());
            } else {
                const auto& volume = std::get<VolumeFile>(file).volume;
                EXPECT_EQ(volume->voxels().size(), volume->grid().valueCount() * byteSize(volume->type()));
            }
            ++read;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("mutated"), std::string::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_EQ(read + refused, 200);
    EXPECT_GT(refused, 0);
    test::writeFile(path, bytes);
    EXPECT_NO_THROW(io_.readVolumeOrMesh(path));
}

INSTANTIATE_TEST_SUITE_P(, Mutations,
                         testing::Values("nrrd", "nii", "nii.gz", "mha", "vtk", "text.vtk", "bytes.vtk", "vdb", "png",
                                         "tif", "dcm"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::ranges::replace(name, '.', '_');
                             return name;
                         });

}  // namespace
}  // namespace voledit
