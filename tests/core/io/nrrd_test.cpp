#include <gmock/gmock.h>

#include "tests/core/io/files.h"

namespace voledit {
namespace {

using test::bytesOf;
using test::counting;
using test::valuesOf;

class Nrrd : public testing::Test {
protected:
    /// Reads a header's lines, a blank one, and data.
    VolumeFile read(const std::string& header, const std::string& data) {
        return io_.readVolume(test::writeFile(folder_ / "a.nrrd", "NRRD0005\n" + header + "\n" + data));
    }
    std::string refuse(const std::string& header, const std::string& data) {
        return test::rejection(io_, test::writeFile(folder_ / "a.nrrd", "NRRD0005\n" + header + "\n" + data));
    }

    std::filesystem::path folder_ = test::scratchFolder();
    IoClient io_;
};

std::vector<double> asDoubles(std::size_t count, double first = 0) {
    return counting<double>(count, first);
}

TEST_F(Nrrd, ReadsEveryTypeInBothByteOrders) {
    const auto check = [&]<class T>(T, const char* names, VoxelType type) {
        const auto values = counting<T>(8, T(1));
        std::istringstream all(names);
        for (std::string name; std::getline(all, name, '|');)
            for (const bool big : {false, true}) {
                const auto file = read("type: " + name + "\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: " +
                                           (big ? "big\n" : "little\n"),
                                       bytesOf(values, big));
                EXPECT_EQ(file.volume->type(), type) << name;
                EXPECT_EQ(valuesOf(*file.volume), asDoubles(8, 1)) << name << (big ? " big" : " little");
            }
    };
    check(std::int8_t{}, "signed char|int8|int8_t", VoxelType::Int8);
    check(std::uint8_t{}, "uchar|unsigned char|uint8|uint8_t", VoxelType::UInt8);
    check(std::int16_t{}, "short|short int|signed short|signed short int|int16|int16_t", VoxelType::Int16);
    check(std::uint16_t{}, "ushort|unsigned short|unsigned short int|uint16|uint16_t", VoxelType::UInt16);
    check(std::int32_t{}, "int|signed int|int32|int32_t", VoxelType::Int32);
    check(std::uint32_t{}, "uint|unsigned int|uint32|uint32_t", VoxelType::UInt32);
    check(float{}, "float", VoxelType::Float);
    check(double{}, "double", VoxelType::Double);
    check(std::int64_t{}, "longlong|long long|long long int|int64|int64_t", VoxelType::Double);
    check(std::uint64_t{}, "ulonglong|unsigned long long|uint64|uint64_t", VoxelType::Double);
}

TEST_F(Nrrd, WarnsOf64BitIntegers) {
    const auto file = read("type: int64\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: little\n",
                           bytesOf(std::vector<std::int64_t>{-3, 4}));
    EXPECT_EQ(file.storedType, "int64");
    EXPECT_THAT(file.warnings, testing::ElementsAre(testing::HasSubstr("64-bit")));
    EXPECT_EQ(file.volume->at({0, 0, 0}), -3);
}

TEST_F(Nrrd, ReadsEveryEncoding) {
    const auto values = counting<std::int16_t>(8, -3);
    const std::string header = "type: short\ndimension: 3\nsizes: 2 2 2\nendian: big\nencoding: ";
    const std::string raw = bytesOf(values, true);
    std::string hex, text;
    for (const char c : raw) {
        constexpr char digits[] = "0123456789abcdef";
        hex += digits[static_cast<unsigned char>(c) >> 4];
        hex += digits[c & 15];
        if (hex.size() % 10 == 0) hex += "\n";
    }
    for (const auto v : values) text += std::to_string(v) + (v % 2 ? " " : "\n");
    for (const auto& [name, data] :
         {std::pair("raw", raw), std::pair("gzip", test::gzipped(raw)), std::pair("gz", test::gzipped(raw)),
          std::pair("hex", hex), std::pair("ascii", text), std::pair("txt", text)}) {
        const auto file = read(header + name + "\n", data);
        EXPECT_EQ(valuesOf(*file.volume), asDoubles(8, -3)) << name;
        EXPECT_THAT(file.warnings, testing::IsEmpty()) << name;
    }
    EXPECT_THAT(refuse(header + "bzip2\n", raw), testing::HasSubstr("bzip2"));
}

TEST_F(Nrrd, LiesInLps) {
    const std::string head =
        "type: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n"
        "space directions: (1,2,3) (0,5,0) (0,0,7)\nspace origin: (10, 20, 30)\nspace: ";
    const auto placement = [&](const char* space) {
        return read(head + space + "\n", "x").volume->grid().worldFromIndex;
    };
    const Mat4 lps{{1, 2, 3, 0}, {0, 5, 0, 0}, {0, 0, 7, 0}, {10, 20, 30, 1}};
    const Mat4 ras{{-1, -2, 3, 0}, {0, -5, 0, 0}, {0, 0, 7, 0}, {-10, -20, 30, 1}};
    const Mat4 las{{1, -2, 3, 0}, {0, -5, 0, 0}, {0, 0, 7, 0}, {10, -20, 30, 1}};
    for (const char* space : {"left-posterior-superior", "LPS", "scanner-xyz", "3D-right-handed"})
        EXPECT_EQ(placement(space), lps) << space;
    for (const char* space : {"right-anterior-superior", "RAS", "right-anterior-superior-time"})
        EXPECT_EQ(placement(space), ras) << space;
    for (const char* space : {"left-anterior-superior", "LAS"}) EXPECT_EQ(placement(space), las) << space;
}

TEST_F(Nrrd, TakesSpacingsAndNoOriginForLps) {
    const auto file = read("type: uchar\ndimension: 3\nsizes: 1 2 1\nspacings: 0.5 2 3\nencoding: raw\n", "xy");
    EXPECT_EQ(file.volume->grid().spacing(), Vec3(0.5, 2, 3));
    EXPECT_EQ(file.volume->grid().origin(), Vec3(0));
}

TEST_F(Nrrd, PutsChannelsLast) {
    const std::string common = "type: uchar\nencoding: raw\nspace: LPS\n";
    // Channels fastest, and slowest.
    const auto first = read(common + "dimension: 4\nsizes: 3 2 1 1\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n",
                            bytesOf(counting<std::uint8_t>(6)));
    EXPECT_EQ(first.volume->grid().channels, 3);
    EXPECT_EQ(valuesOf(*first.volume), (std::vector<double>{0, 1, 2, 3, 4, 5}));
    const auto last = read(common + "dimension: 4\nsizes: 2 1 1 3\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\n",
                           bytesOf(counting<std::uint8_t>(6)));
    EXPECT_EQ(last.volume->grid().channels, 3);
    EXPECT_EQ(valuesOf(*last.volume), (std::vector<double>{0, 2, 4, 1, 3, 5}));
    const auto kinds = read(
        "type: uchar\nencoding: raw\ndimension: 4\nsizes: 3 2 1 1\n"
        "kinds: RGB-color domain domain domain\n",
        bytesOf(counting<std::uint8_t>(6)));
    EXPECT_EQ(kinds.volume->grid().channels, 3);
}

TEST_F(Nrrd, ShowsTheFirstTimeStep) {
    const auto file =
        read("type: uchar\nencoding: raw\ndimension: 4\nsizes: 2 1 1 3\nkinds: domain domain domain time\n",
             bytesOf(counting<std::uint8_t>(6)));
    EXPECT_EQ(file.volume->grid().channels, 1);
    EXPECT_EQ(valuesOf(*file.volume), (std::vector<double>{0, 1}));
    EXPECT_EQ(file.warnings.size(), 1u);
}

TEST_F(Nrrd, ReadsFewerDimensions) {
    EXPECT_EQ(read("type: uchar\nencoding: raw\ndimension: 2\nsizes: 2 3\n", "abcdef").volume->grid().size,
              Index3(2, 3, 1));
    EXPECT_EQ(read("type: uchar\nencoding: raw\ndimension: 1\nsizes: 6\n", "abcdef").volume->grid().size,
              Index3(6, 1, 1));
}

TEST_F(Nrrd, SkipsLinesAndBytes) {
    const std::string head = "type: uchar\nencoding: raw\ndimension: 3\nsizes: 2 1 1\n";
    EXPECT_EQ(valuesOf(*read(head + "line skip: 2\n", "one\ntwo\nAB").volume), (std::vector<double>{65, 66}));
    EXPECT_EQ(valuesOf(*read(head + "byte skip: 3\n", "xyzAB").volume), (std::vector<double>{65, 66}));
    EXPECT_EQ(valuesOf(*read(head + "line skip: 1\nbyte skip: 1\n", "one\nxAB").volume), (std::vector<double>{65, 66}));
    EXPECT_EQ(valuesOf(*read(head + "byte skip: -1\n", "something before AB").volume), (std::vector<double>{65, 66}));
}

TEST_F(Nrrd, FindsDetachedData) {
    test::writeFile(folder_ / "one.raw", "AB");
    test::writeFile(folder_ / "two.raw", "CD");
    test::writeFile(folder_ / "s01.raw", "EF");
    test::writeFile(folder_ / "s03.raw", "GH");
    std::filesystem::create_directory(folder_ / "below");
    test::writeFile(folder_ / "below" / "in.raw", "IJKL");
    const std::string head = "type: uchar\nencoding: raw\ndimension: 3\nsizes: 2 1 2\ndata file: ";
    EXPECT_EQ(valuesOf(*read(head + "LIST\none.raw\ntwo.raw", "").volume), asDoubles(4, 65));
    EXPECT_EQ(valuesOf(*read(head + "s%02d.raw 1 3 2\n", "").volume), asDoubles(4, 69));
    EXPECT_EQ(valuesOf(*read(head + "s%02d.raw 3 1 -2\n", "").volume), (std::vector<double>{71, 72, 69, 70}));
    EXPECT_EQ(valuesOf(*read(head + "below/in.raw\n", "").volume), asDoubles(4, 73));
    EXPECT_EQ(valuesOf(*read(head + "./below/in.raw\n", "").volume), asDoubles(4, 73));
}

TEST_F(Nrrd, ReadsCarriageReturnsCommentsAndKeys) {
    const auto file = read(
        "# a comment\r\ntype: uchar\r\nkey:=value: with colon\r\ndimension: 3\r\nsizes: 2 1 1\r\n"
        "encoding: raw\r\nsome new field: 1\r\n\r",
        "AB");
    EXPECT_EQ(valuesOf(*file.volume), asDoubles(2, 65));
}

TEST_F(Nrrd, SaysWhereItIsWrong) {
    EXPECT_THAT(refuse("type: uchar\ndimension: three\n", ""), testing::HasSubstr("line 3"));
    EXPECT_THAT(refuse("type: uchar\ndimension: 3\nsizes: 1 1\n", ""), testing::HasSubstr("line 4"));
    EXPECT_THAT(refuse("dimension: 3\nsizes: 1 1 1\nencoding: raw\n", "x"), testing::HasSubstr("\"type\""));
    EXPECT_THAT(refuse("type: uchar\ntype: uchar\n", "x"), testing::HasSubstr("line 3"));
}

}  // namespace
}  // namespace voledit
