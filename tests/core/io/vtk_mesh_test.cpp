#include <gmock/gmock.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <random>

#include "tests/core/io/vtk_files.h"

namespace voledit {
namespace {

using test::VtkCell;
using test::VtkStyle;
using testing::ElementsAre;
using testing::HasSubstr;

using Tetrahedron = std::array<std::uint32_t, 4>;

/// Points of an n-grid, i fastest, bent so that it is no regular one.
std::vector<Vec3> bentGrid(const Index3& n) {
    std::vector<Vec3> points;
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i) points.push_back({i + 0.1 * k * j, j - 0.05 * i * k, 1.5 * k + 0.1 * i});
    return points;
}

std::vector<float> valuesAt(const std::vector<Vec3>& points) {
    std::vector<float> values;
    for (const Vec3& p : points) values.push_back(float(p.x + 10 * p.y - p.z));
    return values;
}

double volumeOf(const MeshData& mesh) {
    double volume = 0;
    for (const Tetrahedron& t : mesh.tetrahedra) {
        const Vec3 origin = mesh.points[t[0]];
        volume += std::abs(glm::determinant(
                      Mat3(mesh.points[t[1]] - origin, mesh.points[t[2]] - origin, mesh.points[t[3]] - origin))) /
                  6;
    }
    return volume;
}

/// How many tetrahedra's faces lie where no other's does; -1 if three share one.
int outerFaces(const MeshData& mesh) {
    std::map<std::array<std::uint32_t, 3>, int> faces;
    for (const Tetrahedron& t : mesh.tetrahedra)
        for (std::size_t left = 0; left < 4; ++left) {
            std::array<std::uint32_t, 3> face{};
            for (std::size_t v = 0, n = 0; v < 4; ++v)
                if (v != left) face[n++] = t[v];
            std::ranges::sort(face);
            ++faces[face];
        }
    int outer = 0;
    for (const auto& [face, count] : faces) {
        if (count > 2) return -1;
        outer += count == 1;
    }
    return outer;
}

class VtkMesh : public testing::Test {
protected:
    MeshFile read(const std::string& bytes) {
        return std::get<MeshFile>(io_.readVolumeOrMesh(test::writeFile(folder_ / "mesh.vtk", bytes)));
    }
    std::string rejection(const std::string& bytes) {
        return test::rejection(io_, test::writeFile(folder_ / "bad.vtk", bytes));
    }

    const std::filesystem::path folder_ = test::scratchFolder();
    IoClient io_;
};

TEST_F(VtkMesh, ReadsCurvilinearGridsAsHexahedra) {
    const auto points = bentGrid({3, 4, 2});
    for (const VtkStyle style : test::vtkStyles()) {
        const MeshFile file = read(test::vtkStart("STRUCTURED_GRID", style) + "DIMENSIONS 3 4 2\n" +
                                   test::vtkPoints(points, style) + test::vtkScalars(valuesAt(points), style));
        EXPECT_EQ(file.mesh.points, points);
        EXPECT_EQ(file.mesh.values, valuesAt(points));
        EXPECT_EQ(file.mesh.channels, 1);
        EXPECT_TRUE(file.mesh.tetrahedra.empty());
        ASSERT_EQ(file.mesh.hexahedra.size(), 2u * 3 * 1);
        EXPECT_THAT(file.mesh.hexahedra[0], ElementsAre(0, 1, 3, 4, 12, 13, 15, 16));
        EXPECT_THAT(file.mesh.hexahedra[5], ElementsAre(7, 8, 10, 11, 19, 20, 22, 23));
        EXPECT_EQ(file.format, "vtk");
        EXPECT_EQ(file.storedType, "float");
        EXPECT_THAT(file.warnings, testing::IsEmpty());
        EXPECT_EQ(file.statistics.min, *std::ranges::min_element(file.mesh.values));
        EXPECT_EQ(file.statistics.max, *std::ranges::max_element(file.mesh.values));
        EXPECT_EQ(std::accumulate(file.statistics.histogram.begin(), file.statistics.histogram.end(), 0u), 24u);
    }
}

TEST_F(VtkMesh, ReadsTetrahedraAsTheyAre) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    const std::vector<VtkCell> cells{{10, {0, 1, 2, 3}}, {10, {4, 1, 2, 3}}};
    for (const VtkStyle style : test::vtkStyles()) {
        const MeshFile file = read(test::vtkStart("UNSTRUCTURED_GRID", style) + test::vtkPoints(points, style) +
                                   test::vtkCells(cells, style) + test::vtkScalars({1, 2, 3, 4, 5}, style));
        EXPECT_EQ(file.mesh.points, points);
        EXPECT_THAT(file.mesh.values, ElementsAre(1, 2, 3, 4, 5));
        ASSERT_EQ(file.mesh.tetrahedra.size(), 2u);
        EXPECT_TRUE(file.mesh.hexahedra.empty());
        EXPECT_NEAR(volumeOf(file.mesh), 0.5, 1e-15) << "1/6 and 1/3";
    }
}

TEST_F(VtkMesh, ReadsRectilinearGrids) {
    for (const VtkStyle style : test::vtkStyles()) {
        const MeshFile file =
            read(test::vtkStart("RECTILINEAR_GRID", style) + "DIMENSIONS 2 3 2\nX_COORDINATES 2 float\n" +
                 test::vtkNumbers<float>({0, 1}, style) + "Y_COORDINATES 3 int\n" +
                 test::vtkNumbers<int>({0, 2, 5}, style) + "Z_COORDINATES 2 double\n" +
                 test::vtkNumbers<double>({-1, 0.25}, style) + test::vtkScalars(test::counting<float>(12), style));
        ASSERT_EQ(file.mesh.points.size(), 12u);
        EXPECT_EQ(file.mesh.points[5], Vec3(1, 5, -1));
        EXPECT_EQ(file.mesh.points[8], Vec3(0, 2, 0.25));
        EXPECT_EQ(file.mesh.hexahedra.size(), 2u);
    }
}

/// A block of n³ hexahedra and voxels, their points numbered by `order`, each cell's list turned at random.
std::vector<VtkCell> mixedBlock(int n, const std::vector<int>& order, std::mt19937& random) {
    const auto vertex = [&](int i, int j, int k) { return order[std::size_t(i + (n + 1) * (j + (n + 1) * k))]; };
    std::vector<VtkCell> cells;
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                // Around the bottom, then around the top, starting anywhere.
                std::vector<int> v;
                for (const int up : {0, 1})
                    for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
                        v.push_back(vertex(i + a, j + b, k + up));
                const auto turn = std::ptrdiff_t(random() % 4);
                std::rotate(v.begin(), v.begin() + turn, v.begin() + 4);
                std::rotate(v.begin() + 4, v.begin() + 4 + turn, v.end());
                if (random() % 3 == 0) {
                    cells.push_back({11, {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]}});
                } else {
                    cells.push_back({12, v});
                }
            }
    return cells;
}

TEST_F(VtkMesh, SplitsHexahedraSoThatNeighboursShareFaces) {
    std::mt19937 random(11);
    const int n = 4;
    const auto grid = bentGrid(Index3(n + 1));
    for (int round = 0; round < 5; ++round) {
        std::vector<int> order = test::counting<int>(grid.size());
        if (round > 0) std::ranges::shuffle(order, random);
        std::vector<Vec3> points(grid.size());
        for (std::size_t v = 0; v < grid.size(); ++v) points[std::size_t(order[v])] = grid[v];
        const auto cells = mixedBlock(n, order, random);
        const MeshFile file = read(test::vtkStart("UNSTRUCTURED_GRID", {}) + test::vtkPoints(points, {}) +
                                   test::vtkCells(cells, {}) + test::vtkScalars(valuesAt(points), {}));
        EXPECT_EQ(outerFaces(file.mesh), 6 * n * n * 2) << "no face within lies open";
        EXPECT_EQ(file.mesh.tetrahedra.size(), cells.size() * 6);
    }
}

TEST_F(VtkMesh, SplitsWedgesAndPyramidsWithTheirNeighbours) {
    std::mt19937 random(3);
    // Two cubes side by side, a pyramid upon the second, two wedges one behind the other at its side.
    const std::vector<VtkCell> shape{{12, {0, 1, 4, 3, 6, 7, 10, 9}},
                                     {12, {1, 2, 5, 4, 7, 8, 11, 10}},
                                     {14, {7, 8, 11, 10, 16}},
                                     {13, {2, 5, 12, 8, 11, 13}},
                                     {13, {5, 12, 14, 11, 13, 15}}};
    std::vector<Vec3> place;
    for (const int z : {0, 1})
        for (const int y : {0, 1})
            for (const int x : {0, 1, 2}) place.push_back({x, y, z});
    for (const double y : {0.5, 1.5})
        for (const int z : {0, 1}) place.push_back({3, y, z});
    place.push_back({1.6, 0.5, 1.9});
    for (int round = 0; round < 50; ++round) {
        std::vector<int> order = test::counting<int>(place.size());
        std::ranges::shuffle(order, random);
        std::vector<Vec3> points(place.size());
        for (std::size_t v = 0; v < place.size(); ++v) points[std::size_t(order[v])] = place[v];
        std::vector<VtkCell> cells = shape;
        for (VtkCell& cell : cells)
            for (int& v : cell.points) v = order[std::size_t(v)];
        const MeshFile file = read(test::vtkStart("UNSTRUCTURED_GRID", {}) + test::vtkPoints(points, {}) +
                                   test::vtkCells(cells, {}) + test::vtkScalars(valuesAt(points), {}));
        EXPECT_EQ(file.mesh.tetrahedra.size(), 6u + 6 + 2 + 3 + 3);
        EXPECT_NEAR(volumeOf(file.mesh), 2 + 0.9 / 3 + 2 * 0.5, 1e-12);
        EXPECT_EQ(outerFaces(file.mesh), 2 * 5 + 2 * 3 + 4 + (2 + 2 * 1) + (2 + 2 * 2)) << round;
    }
}

TEST_F(VtkMesh, AHexahedronNumberedLikeAGridIsSplitAlongItsDiagonal) {
    const auto points = bentGrid({2, 2, 2});
    for (const VtkCell& cell : {VtkCell{12, {0, 1, 3, 2, 4, 5, 7, 6}}, VtkCell{11, {0, 1, 2, 3, 4, 5, 6, 7}}}) {
        const MeshFile file = read(test::vtkStart("UNSTRUCTURED_GRID", {}) + test::vtkPoints(points, {}) +
                                   test::vtkCells({cell}, {}) + test::vtkScalars(valuesAt(points), {}));
        ASSERT_EQ(file.mesh.tetrahedra.size(), 6u);
        for (const Tetrahedron& t : file.mesh.tetrahedra) {
            EXPECT_THAT(t, testing::Contains(0u));
            EXPECT_THAT(t, testing::Contains(7u));
        }
    }
}

const std::vector<Vec3> kFourPoints{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::string oneTetrahedron(VtkStyle style = {}) {
    return test::vtkStart("UNSTRUCTURED_GRID", style) + test::vtkPoints(kFourPoints, style) +
           test::vtkCells({{10, {0, 1, 2, 3}}}, style);
}

TEST_F(VtkMesh, TakesTheFirstScalarsElseTheFirstArray) {
    const std::string normals = "NORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\n", ids = "GLOBAL_IDS g vtkIdType\n1 2 3 4\n";
    const std::string vectors = "VECTORS v double\n1 2 3 4 5 6 7 8 9 10 11 12\n";
    const std::string scalars = "SCALARS s int\nLOOKUP_TABLE default\n1 2 3 4\n";
    const std::string field =
        "FIELD FieldData 2\nvtkOriginalPointIds 1 4 int\n0 1 2 3\nf%20g 2 4 short\n1 2 3 4 5 6 7 8\n";
    const auto readWith = [&](const std::string& data) { return read(oneTetrahedron() + "POINT_DATA 4\n" + data); };
    EXPECT_THAT(readWith(normals + vectors + field + scalars).mesh.values, ElementsAre(1, 2, 3, 4));
    EXPECT_EQ(readWith(scalars).storedType, "int32");
    EXPECT_EQ(readWith(normals + vectors + field).mesh.channels, 3);
    EXPECT_EQ(readWith(vectors).mesh.values[11], 12);
    EXPECT_EQ(readWith(vectors).storedType, "double");
    const MeshFile two = readWith(ids + normals + field);
    EXPECT_EQ(two.mesh.channels, 2);
    EXPECT_EQ(two.storedType, "int16");
    EXPECT_THAT(two.mesh.values, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
    EXPECT_EQ(readWith("COLOR_SCALARS c 4\n" + std::string("0 0 0 1 ") + "0 0 0 1 0 0 0 1 0.5 0 0 1\n").mesh.values[12],
              0.5f);
    EXPECT_EQ(readWith("SCALARS s vtktypeint64 1\n9 8 7 6\n").storedType, "int64") << "without LOOKUP_TABLE";
}

TEST_F(VtkMesh, PassesOverWhatItDoesNotShow) {
    const VtkStyle binary{false, 5};
    const std::string strings = std::string("FIELD FieldData 3\nnames 1 2 string\n") + '\xc3' + "abc" + '\x80' +
                                '\x43' + std::string(67, 'x') + "\nbits 1 10 bit\n" + std::string(2, '\x7f') +
                                "\nMETADATA\nINFORMATION 0\n\nTIME 1 1 double\n" +
                                test::vtkNumbers<double>({1.5}, binary);
    const MeshFile file =
        read(test::vtkStart("UNSTRUCTURED_GRID", binary) + strings + test::vtkPoints(kFourPoints, binary) +
             "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1 \n\n" +
             test::vtkCells({{10, {0, 1, 2, 3}}}, binary) + test::vtkScalars({7}, binary, "CELL_DATA") +
             "LOOKUP_TABLE t 2\n" + std::string(8, '\n') + "\n" + test::vtkScalars({1, 2, 3, 4}, binary));
    EXPECT_THAT(file.mesh.values, ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(file.warnings, testing::IsEmpty());
}

TEST_F(VtkMesh, ValuesOfCellsBecomeTheirPointsMeans) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {9, 9, 9}};
    const std::vector<VtkCell> cells{{10, {0, 1, 2, 3}}, {5, {0, 1, 2}}, {10, {4, 1, 2, 3}}};
    const MeshFile file = read(test::vtkStart("UNSTRUCTURED_GRID", {}) + test::vtkPoints(points, {}) +
                               test::vtkCells(cells, {}) + test::vtkScalars({10, 999, 30}, {}, "CELL_DATA"));
    EXPECT_THAT(file.mesh.values, ElementsAre(10, 20, 20, 20, 30, testing::IsNan()));
    ASSERT_EQ(file.warnings.size(), 2u);
    EXPECT_THAT(file.warnings[0], HasSubstr("1 of type 5 (triangle)"));
    EXPECT_THAT(file.warnings[1], HasSubstr("values of cells"));
    EXPECT_EQ(file.statistics.max, 30);
}

TEST_F(VtkMesh, LeavesOutWhatIsHidden) {
    const auto points = bentGrid({4, 2, 2});
    const std::string start =
        test::vtkStart("STRUCTURED_GRID", {}) + "DIMENSIONS 4 2 2\n" + test::vtkPoints(points, {});
    const std::string data = test::vtkScalars(valuesAt(points), {});
    std::vector<int> flags(16, 0);
    flags[4] = 2;
    EXPECT_EQ(read(start + data).mesh.hexahedra.size(), 3u);
    EXPECT_EQ(read(start + data + "FIELD FieldData 1\nvtkGhostType 1 16 unsigned_char\n" + test::vtkNumbers(flags, {}))
                  .mesh.hexahedra.size(),
              2u);
    EXPECT_EQ(read(start + "CELL_DATA 3\nFIELD FieldData 1\nvtkGhostType 1 3 unsigned_char\n32 0 32\n" + data)
                  .mesh.hexahedra.size(),
              1u);
    std::vector<int> visible(16, 1);
    visible[1] = 0;
    EXPECT_EQ(read(start + "BLANKING 16 unsigned_char\n" + test::vtkNumbers(visible, {}) + data).mesh.hexahedra.size(),
              1u);
    EXPECT_THAT(rejection(start + "CELL_DATA 3\nFIELD FieldData 1\nvtkGhostType 1 3 unsigned_char\n32 32 32\n" + data),
                HasSubstr("hidden"));
}

TEST_F(VtkMesh, ReadsWindowsLineEndsAndOddSpacing) {
    std::string text = oneTetrahedron() + "POINT_DATA 4\nSCALARS s float 1\nLOOKUP_TABLE default\n+1 -2e0\t3.\n\n\n 4";
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    EXPECT_THAT(read(text).mesh.values, ElementsAre(1, -2, 3, 4));
}

TEST_F(VtkMesh, SaysWhatAVolumeWouldNeed) {
    const std::string whole = oneTetrahedron() + test::vtkScalars({1, 2, 3, 4}, {});
    EXPECT_THAT(rejection(whole), HasSubstr("holds a mesh"));
}

TEST_F(VtkMesh, RefusesWhatIsNoMesh) {
    const std::string scalars = test::vtkScalars({1, 2, 3, 4}, {});
    const auto unstructured = [&](const std::string& cells) {
        return test::vtkStart("UNSTRUCTURED_GRID", {}) + test::vtkPoints(kFourPoints, {}) + cells + scalars;
    };
    const auto grid = [&](const std::string& size, const std::string& points) {
        return test::vtkStart("STRUCTURED_GRID", {}) + "DIMENSIONS " + size + "\nPOINTS " + points;
    };
    const std::vector<std::pair<std::string, const char*>> bad{
        {unstructured("CELLS 1 5\n4 0 1 2 4\nCELL_TYPES 1\n10\n"), "cell 0 names point 4 of 4"},
        {unstructured("CELLS 1 5\n4 0 1 2 -1\nCELL_TYPES 1\n10\n"), "-1, which can be no index"},
        {unstructured("CELLS 1 5\n4 0 1 2 1.5\nCELL_TYPES 1\n10\n"), "no whole number"},
        {unstructured("CELLS 1 5\n4 0 1 2 99999999999\nCELL_TYPES 1\n10\n"), "no index"},
        {unstructured("CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n"), "has 3 points, not 4"},
        {unstructured("CELLS 1 5\n9 0 1 2 3\nCELL_TYPES 1\n10\n"), "ends within cell 0"},
        {unstructured("CELLS 2 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n"), "2 CELLS, but CELL_TYPES of 1"},
        {unstructured("CELLS 2 5\n4 0 1 2 3\nCELL_TYPES 2\n10 10\n"), "ends within cell 1"},
        {unstructured("CELLS 1 5\n4 0 1 2 3\n"), "no CELL_TYPES"},
        {unstructured("CELL_TYPES 1\n10\n"), "no CELLS"},
        {unstructured("CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n"), "fill a volume: 1 of type 5 (triangle)"},
        {unstructured("CELLS 1 5\n4 0 1 2 2\nCELL_TYPES 1\n10\n"), "fill a volume"},
        {unstructured("CELLS 0 0\nCELL_TYPES 0\n"), "fill a volume"},
        {unstructured("CELLS 2 4\nOFFSETS vtktypeint64\n0 5\nCONNECTIVITY vtktypeint64\n0 1 2 3\nCELL_TYPES 1\n10\n"),
         "not where OFFSETS says"},
        {unstructured(
             "CELLS 3 4\nOFFSETS vtktypeint64\n0 4 2\nCONNECTIVITY vtktypeint64\n0 1 2 3\nCELL_TYPES 2\n10 10\n"),
         "not where OFFSETS says"},
        {unstructured("CELLS 2 4\nOFFSETS float\n0 4\nCONNECTIVITY vtktypeint64\n0 1 2 3\nCELL_TYPES 2\n10 10\n"), "2"},
        {unstructured("CELLS 2 4\nOFFSETS vtktypeint64\n0 4\nNONSENSE vtktypeint64\n0 1 2 3\n"),
         "CONNECTIVITY is expected"},
        {unstructured("CELLS 1000000000000 5000000000000\n4 0 1 2 3\n"), "more values than there are"},
        {unstructured("CELLS 1 18446744073709551615\n4 0 1 2 3\n"), "address"},
        {test::vtkStart("UNSTRUCTURED_GRID", {}) + "POINTS 4 double\n0 0 0 1 0 nan 0 1 0 0 0 1\n" +
             test::vtkCells({{10, {0, 1, 2, 3}}}, {}) + scalars,
         "point 1 is not finite"},
        {test::vtkStart("UNSTRUCTURED_GRID", {}) + "POINTS 4 double\n0 0 0 1 0 0 0 1e999 0 0 0 1\n" +
             test::vtkCells({{10, {0, 1, 2, 3}}}, {}) + scalars,
         "point 2 is not finite"},
        {test::vtkStart("UNSTRUCTURED_GRID", {}) + test::vtkCells({{10, {0, 1, 2, 3}}}, {}) + scalars, "no POINTS"},
        {test::vtkStart("UNSTRUCTURED_GRID", {}) + "POINTS 4 complex\n", "type \"complex\" is not read"},
        {oneTetrahedron(), "no values"},
        {oneTetrahedron() + "POINT_DATA 4\nSCALARS s bit\nLOOKUP_TABLE default\n0 1 0 1\n", "no values"},
        {oneTetrahedron() + test::vtkScalars({1, 2, 3}, {}), "3 values for 4 points"},
        {oneTetrahedron() + "POINT_DATA 4\nSCALARS s float 1\nLOOKUP_TABLE default\n1 2 3\n",
         "more values than there are"},
        {oneTetrahedron() + "POINT_DATA 4\nSCALARS s float 1\nLOOKUP_TABLE default\n1 2 x 4\n", "\"x\""},
        {oneTetrahedron() + "POINT_DATA 4\nSCALARS s float 99999\n", "4096"},
        {oneTetrahedron() + "POINT_DATA 4\nFIELD f 99999999999\n", "ends where an array"},
        {oneTetrahedron() + test::vtkScalars({1, 2}, {}, "CELL_DATA"), "2 values for 1 cells"},
        {oneTetrahedron() + "1 2 3 4\n", "not understood"},
        {grid("2 2 2", "7 float\n" + test::vtkNumbers(test::counting<float>(21), {})), "do not fit its DIMENSIONS"},
        {grid("2 2 1", "4 float\n" + test::vtkNumbers(test::counting<float>(12), {}) + scalars), "one layer"},
        {grid("0 2 2", "0 float\n" + scalars), "size of 0"},
        {grid("2147483647 2147483647 2147483647", "1 float\n0 0 0\n" + scalars), "address"},
        {grid("2000000 2000000 2000000", "8 float\n" + test::vtkNumbers(test::counting<float>(24), {})), "address"},
        {test::vtkStart("RECTILINEAR_GRID", {}) + "DIMENSIONS 1000 1000 1000\nX_COORDINATES 1000 float\n" +
             test::vtkNumbers(test::counting<float>(1000), {}) + "Y_COORDINATES 1000 float\n" +
             test::vtkNumbers(test::counting<float>(1000), {}) + "Z_COORDINATES 1000 float\n" +
             test::vtkNumbers(test::counting<float>(1000), {}) + scalars,
         "values do not fit"},
    };
    for (const auto& [bytes, says] : bad) EXPECT_THAT(rejection(bytes), HasSubstr(says)) << bytes.substr(0, 300);
    EXPECT_THAT(rejection(std::string(oneTetrahedron()) + "POINT_DATA 4\n" + std::string(100000, 'x')),
                HasSubstr("64 KiB"));
}

TEST_F(VtkMesh, RefusesBinaryFilesThatAreCutOffAnywhere) {
    for (const int version : {3, 5}) {
        const VtkStyle style{false, version};
        const std::string whole = oneTetrahedron(style) + test::vtkScalars({1, 2, 3, 4}, style);
        read(whole);
        for (std::size_t length = 0; length + 2 < whole.size(); ++length) rejection(whole.substr(0, length));
    }
}

}  // namespace
}  // namespace voledit
