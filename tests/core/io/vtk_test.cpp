#include <gmock/gmock.h>

#include "tests/core/io/files.h"

namespace voledit {
namespace {

using test::bytesOf;
using test::counting;
using test::valuesOf;

class Vtk : public testing::Test {
protected:
    std::filesystem::path file(const std::string& encoding, const std::string& attribute, const std::string& data) {
        return test::writeFile(folder_ / "a.vtk", "# vtk DataFile Version 3.0\na title\n" + encoding +
                                                      "\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
                                                      "ORIGIN 1 2 3\nSPACING 0.5 1 2\nPOINT_DATA 8\n" +
                                                      attribute + data);
    }

    std::filesystem::path folder_ = test::scratchFolder();
    IoClient io_;
};

TEST_F(Vtk, ReadsTextAndBigEndianBinary) {
    const auto check = [&]<class T>(T, const char* name, VoxelType type) {
        const std::string scalars = std::string("SCALARS density ") + name + " 1\nLOOKUP_TABLE default\n";
        const auto binary = io_.readVolume(file("BINARY", scalars, bytesOf(counting<T>(8, T(1)), true) + "\n"));
        EXPECT_EQ(binary.volume->type(), type) << name;
        EXPECT_EQ(valuesOf(*binary.volume), counting<double>(8, 1)) << name;
        const auto text = io_.readVolume(file("ASCII", scalars, "1 2 3 4\n5 6 7 8\n"));
        EXPECT_EQ(text.volume->type(), type) << name;
        EXPECT_EQ(valuesOf(*text.volume), counting<double>(8, 1)) << name;
    };
    check(std::int8_t{}, "char", VoxelType::Int8);
    check(std::uint8_t{}, "unsigned_char", VoxelType::UInt8);
    check(std::int16_t{}, "short", VoxelType::Int16);
    check(std::uint16_t{}, "unsigned_short", VoxelType::UInt16);
    check(std::int32_t{}, "int", VoxelType::Int32);
    check(std::uint32_t{}, "unsigned_int", VoxelType::UInt32);
    check(std::int64_t{}, "long", VoxelType::Double);
    check(float{}, "float", VoxelType::Float);
    check(double{}, "double", VoxelType::Double);
}

TEST_F(Vtk, LiesWhereItSays) {
    const auto grid = io_.readVolume(file("ASCII", "SCALARS s float\n", "1 2 3 4 5 6 7 8")).volume->grid();
    EXPECT_EQ(grid.worldFromIndex, (Mat4{{0.5, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 2, 0}, {1, 2, 3, 1}}));
}

TEST_F(Vtk, ReadsVectorsFieldsAndWhatFollows) {
    const std::string many = bytesOf(counting<float>(24), true);
    EXPECT_EQ(io_.readVolume(file("BINARY", "VECTORS v float\n", many)).volume->grid().channels, 3);
    EXPECT_EQ(io_.readVolume(file("BINARY", "FIELD FieldData 1\nv 3 8 float\n", many)).volume->grid().channels, 3);
    const auto followed = io_.readVolume(file("ASCII", "SCALARS s int\nLOOKUP_TABLE default\n",
                                              "1 2 3 4 5 6 7 8\nSCALARS other int\n1 2 3 4 5 6 7 8\n"));
    EXPECT_EQ(valuesOf(*followed.volume), counting<double>(8, 1));
    EXPECT_THAT(followed.warnings, testing::IsEmpty());
}

TEST_F(Vtk, TakesTheFirstScalarsWhereverTheyStand) {
    const auto path = test::writeFile(
        folder_ / "order.vtk",
        "# vtk DataFile Version 5.1\nx\nASCII\nDATASET STRUCTURED_POINTS\nFIELD FieldData 1\nnote 1 2 string\n"
        "first line\nsecond line\nDIMENSIONS 2 1 1\nCELL_DATA 1\nSCALARS c int\nLOOKUP_TABLE default\n9\n"
        "POINT_DATA 2\nVECTORS v float\n1 2 3 4 5 6\nMETADATA\nINFORMATION 0\n\nLOOKUP_TABLE table 1\n0 0 0 1\n"
        "SCALARS s int 1\nLOOKUP_TABLE table\n7 8\nSCALARS t int 1\nLOOKUP_TABLE default\n5 6\n");
    EXPECT_EQ(valuesOf(*io_.readVolume(path).volume), (std::vector<double>{7, 8}));
}

TEST_F(Vtk, RefusesWhatFillsNoVolume) {
    for (const char* kind : {"POLYDATA", "FIELD", "NONSENSE"}) {
        const auto path = test::writeFile(folder_ / "surface.vtk",
                                          std::string("# vtk DataFile Version 3.0\nx\nASCII\nDATASET ") + kind + "\n");
        EXPECT_THAT(test::rejection(io_, path), testing::HasSubstr("fills no volume")) << kind;
    }
}

TEST_F(Vtk, RefusesWhatIsCutOff) {
    const std::string scalars = "SCALARS s short\nLOOKUP_TABLE default\n";
    test::rejection(io_, file("BINARY", scalars, bytesOf(counting<std::int16_t>(7), true)));
    test::rejection(io_, file("ASCII", scalars, "1 2 3 4 5 6 7"));
    test::rejection(io_, file("ASCII", scalars, "1 2 3 4 5 6 7 eight"));
    test::rejection(io_, file("ASCII", scalars, "1 2 3 4 5 6 7 99999"));
}

}  // namespace
}  // namespace voledit
