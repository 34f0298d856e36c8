// Meshes and deformation fields on the command line, as a script uses them.

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/core/io/vtk_files.h"
#include "tests/support/meshes.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::run;
using testing::HasSubstr;

double linear(const Vec3& p) {
    return 100 + 20 * p.x - 30 * p.y + 10 * p.z;
}

std::string text(const Vec3& p) {
    std::ostringstream out;
    out.precision(17);
    out << p.x << "," << p.y << "," << p.z;
    return out.str();
}

/// A folder with a tetrahedral mesh and a curvilinear grid that hold a linear field.
struct MeshFiles {
    fs::path folder = test::scratchFolder();
    IoClient io;

    MeshFiles() {
        const test::VtkStyle binary{false, 5};
        const MeshData ball = test::tetrahedralBall(6), grid = test::warpedGrid({5, 6, 7});
        std::vector<test::VtkCell> cells;
        for (const auto& t : ball.tetrahedra) cells.push_back({10, {int(t[0]), int(t[1]), int(t[2]), int(t[3])}});
        test::writeFile(folder / "ball.vtk", test::vtkStart("UNSTRUCTURED_GRID", binary) +
                                                 test::vtkPoints(ball.points, binary) + test::vtkCells(cells, binary) +
                                                 test::vtkScalars(valuesOf(ball), binary));
        test::writeFile(folder / "grid.vtk", test::vtkStart("STRUCTURED_GRID", {}) + "DIMENSIONS 6 7 8\n" +
                                                 test::vtkPoints(grid.points, {}) +
                                                 test::vtkScalars(valuesOf(grid), {}));
    }
    static std::vector<float> valuesOf(const MeshData& mesh) {
        std::vector<float> values;
        for (const Vec3& p : mesh.points) values.push_back(float(linear(p)));
        return values;
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    std::string write(const std::string& name, const std::string& bytes) const {
        return test::writeFile(folder / name, bytes).string();
    }
};

json parsed(const test::RunResult& result) {
    EXPECT_EQ(result.status, 0) << result.err;
    return json::parse(result.out, nullptr, false);
}

TEST(MeshCommands, InfoDescribesMeshes) {
    const MeshFiles files;
    const json ball = parsed(run("voledit", {"info", files.at("ball.vtk"), "--json"}));
    EXPECT_EQ(ball["kind"], "mesh");
    EXPECT_EQ(ball["format"], "vtk");
    EXPECT_EQ(ball["cell"], "tetrahedron");
    EXPECT_EQ(ball["cells"], 6 * 6 * 6 * 6);
    EXPECT_EQ(ball["points"], 343);
    EXPECT_EQ(ball["component"], "float");
    EXPECT_EQ(ball["channels"], 1);
    EXPECT_LT(ball["min"], ball["mean"]);
    EXPECT_LT(ball["mean"], ball["max"]);
    EXPECT_EQ(ball["histogram"].size(), 256u);
    EXPECT_NEAR(ball["bounds"]["min"][0].get<double>(), -0.9, 0.2);
    const json grid = parsed(run("voledit", {"info", files.at("grid.vtk"), "--json"}));
    EXPECT_EQ(grid["cell"], "hexahedron");
    EXPECT_EQ(grid["cells"], 5 * 6 * 7);
}

TEST(MeshCommands, SampleInterpolatesWithinCellsAndIsNullOutside) {
    const MeshFiles files;
    const std::vector<Vec3> points{{0.1, 0.2, -0.3}, {-0.4, 0.4, 0.1}, {0, 0, 0}};
    for (const std::string name : {"ball.vtk", "grid.vtk"}) {
        std::vector<std::string> arguments{"sample", files.at(name), "--json", "--at", "3,0,0"};
        for (const Vec3& p : points) arguments.insert(arguments.end(), {"--at", text(p)});
        const json samples = parsed(run("voledit", arguments))["samples"];
        ASSERT_EQ(samples.size(), 4u);
        EXPECT_TRUE(samples[0]["value"].is_null());
        for (std::size_t i = 0; i < points.size(); ++i)
            EXPECT_NEAR(samples[i + 1]["value"].get<double>(), linear(points[i]), 1e-4) << name;
    }
}

TEST(MeshCommands, WhatNeedsVoxelsSaysSo) {
    const MeshFiles files;
    const auto convert = run("voledit", {"convert", files.at("ball.vtk"), files.at("out.nrrd")});
    EXPECT_EQ(convert.status, 1);
    EXPECT_THAT(convert.err, HasSubstr("holds a mesh"));
    EXPECT_THAT(convert.err, HasSubstr("ball.vtk"));
    EXPECT_FALSE(fs::exists(files.at("out.nrrd")));
    const auto like =
        run("voledit", {"voxelize", files.at("ball.vtk"), "-o", files.at("out.nrrd"), "--like", files.at("grid.vtk")});
    EXPECT_EQ(like.status, 1);
    EXPECT_THAT(like.err, HasSubstr("holds a mesh"));
}

TEST(MeshCommands, MeshesAreVolumesOfScenes) {
    MeshFiles files;
    const std::string scene = files.write("scene.voledit", R"({"voledit":1,
        "assets":{"mesh":{"kind":"volume","path":"ball.vtk"}},
        "objects":{"lump":{"type":"volume","asset":"mesh","appearance":{"color":[[0,1,0,0],[200,0,0,1]],
                                                                        "opacity":[[0,0.5]]}}},
        "root":{"type":"transfer","by":{"type":"affine","translate":[5,0,0]},"of":{"use":"lump"}}})");
    const auto voxelized = run("voledit", {"voxelize", scene, "-o", files.at("out.nrrd"), "--what", "scalar", "--fill",
                                           "-7", "--bounds", "3.9,-1.1,-1.1,6.1,1.1,1.1", "--size", "22x22x22"});
    ASSERT_EQ(voxelized.status, 0) << voxelized.err;
    const auto volume = files.io.readVolume(files.at("out.nrrd")).volume;
    EXPECT_EQ(volume->at({0, 0, 0}), -7);
    int inside = 0;
    for (int n = 0; n < 22 * 22 * 22; ++n) {
        const Index3 index(n % 22, n / 22 % 22, n / 484);
        if (volume->at(index) == -7) continue;
        ++inside;
        const Vec3 p = transformPoint(volume->grid().worldFromIndex, Vec3(index));
        ASSERT_NEAR(volume->at(index), linear(p - Vec3(5, 0, 0)), 1e-3);
    }
    EXPECT_GT(inside, 1500);
    const json sample =
        parsed(run("voledit", {"sample", scene, "--json", "--at", "5.2,0.1,0.1", "--at", "0,0,0"}))["samples"];
    EXPECT_NEAR(sample[0]["opacity"].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(sample[0]["color"][2].get<double>(), linear({0.2, 0.1, 0.1}) / 200, 1e-6);
    EXPECT_EQ(sample[1]["opacity"], 0);
}

TEST(MeshCommands, BareMeshesAreDrawn) {
    MeshFiles files;
    for (const std::string renderer : {"rays", "slices"}) {
        const auto result = run("voledit", {"render", files.at("grid.vtk"), "-o", files.at(renderer + ".png"), "--size",
                                            "80x60", "--renderer", renderer, "--step", "0.25"});
        ASSERT_EQ(result.status, 0) << result.err;
    }
    const Picture slices = files.io.readPicture(files.at("slices.png")),
                  rays = files.io.readPicture(files.at("rays.png"));
    EXPECT_GT(psnr(slices, rays), 40);
    EXPECT_GT(std::ranges::max(rays.pixels, {}, [](const Vec4f& p) { return p.r; }).r, 0.1f) << "empty or dark";
}

/// The points of a scene's outermost STF at `points`.
std::vector<Vec3> pathPoints(const std::string& scene, const std::vector<Vec3>& points) {
    std::vector<std::string> arguments{"sample", scene, "--json"};
    for (const Vec3& p : points) arguments.insert(arguments.end(), {"--at", text(p)});
    std::vector<Vec3> found;
    const json answer = parsed(run("voledit", arguments));
    for (const json& sample : answer["samples"]) {
        const json& q = sample["path"][0]["point"];
        found.push_back(q.is_null() ? kUndefined : Vec3(q[0], q[1], q[2]));
    }
    return found;
}

TEST(DeformationFields, VoxelizedDisplacementsAreTheSameMapAgain) {
    MeshFiles files;
    const auto scene = [&](const std::string& name, const std::string& assets, const std::string& by) {
        return files.write(name, R"({"voledit":1,"assets":{)" + assets + R"(},"root":{"type":"transfer","by":)" + by +
                                     R"(,"of":{"type":"solid","shape":{"sphere":{"center":[0,0,0],"radius":2}},
                                         "color":[1,1,1],"opacity":1}}})");
    };
    const std::string twisted = scene("twist.voledit", "", R"({"type":"twist","axis":"z","angle":60,
        "frame":{"min":[-2,-2,-2],"max":[2,2,2]}})");
    std::vector<Vec3> points;  // centres of voxels: 20 over 4 units
    for (int n = 0; n < 20; ++n) points.push_back(Vec3(-1.9) + 0.2 * Vec3(n, (7 * n + 3) % 20, (11 * n + 5) % 20));
    const auto expected = pathPoints(twisted, points);
    for (const std::string name : {"d.nrrd", "d.nii.gz", "d.mha"}) {
        const auto voxelized = run("voledit", {"voxelize", twisted, "-o", files.at(name), "--what", "displacement",
                                               "--bounds", "-2,-2,-2,2,2,2", "--size", "20x20x20"});
        ASSERT_EQ(voxelized.status, 0) << voxelized.err;
        const json info = parsed(run("voledit", {"info", files.at(name), "--json"}));
        EXPECT_EQ(info["channels"], 3);
        const std::string again = scene("again.voledit", R"("warp":{"kind":"volume","path":")" + name + R"("})",
                                        R"({"type":"fields","asset":"warp","displacement":true})");
        const auto found = pathPoints(again, points);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int a = 0; a < 3; ++a)
                EXPECT_NEAR(found[i][a], expected[i][a], 2e-6) << name << " at " << text(points[i]);
        EXPECT_EQ(pathPoints(again, {{9, 9, 9}})[0], Vec3(9)) << "outside a displacement keeps what is there";
    }
}

TEST(DeformationFields, NeedThreeComponents) {
    MeshFiles files;
    const std::string scene = files.write("scene.voledit", R"({"voledit":1,
        "assets":{"mesh":{"kind":"volume","path":"ball.vtk"}},
        "root":{"type":"transfer","by":{"type":"fields","asset":"mesh","displacement":true},
                "of":{"type":"solid","shape":{"sphere":{"center":[0,0,0],"radius":2}},"color":[1,1,1],"opacity":1}}})");
    const auto result = run("voledit", {"sample", scene, "--at", "0,0,0"});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("3"));
}

}  // namespace
}  // namespace voledit
