// Hostile, broken and absurd files: each is an Error that names the file and a remedy; the client lives on, and nothing
// is written.

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/core/io/picture_files.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;
using test::NiftiBytes;

const std::string kNrrd = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n";
const std::string kMeta = "ObjectType = Image\nNDims = 3\nDimSize = 4 4 4\nElementType = MET_UCHAR\n";
const std::string k64(64, 'x');

struct BadFile {
    std::string name, bytes;
};

std::string nrrd(const std::string& lines) {
    return "NRRD0004\n" + lines + "\n" + k64;
}
std::string meta(const std::string& lines) {
    return kMeta + lines + "ElementDataFile = LOCAL\n" + k64;
}
std::string nifti(const NiftiBytes& header) {
    return header.bytes() + k64;
}
NiftiBytes small() {
    return NiftiBytes({3, 4, 4, 4}, 2, 8).sform(Mat4(1));
}
Mat4 scaled(double x) {
    Mat4 m(1);
    m[0][0] = x;
    return m;
}

std::vector<BadFile> badFiles() {
    const std::string nan = "nan";
    return {
        {"empty.nrrd", ""},
        {"empty.nii", ""},
        {"empty.nii.gz", ""},
        {"empty.mha", ""},
        {"empty.vtk", ""},
        {"empty.vdb", ""},
        {"empty.dcm", ""},
        {"empty.tif", ""},
        {"empty.png", ""},
        {"garbage.nrrd", k64 + k64},
        {"garbage.nii", k64 + k64},
        {"garbage.nii.gz", k64 + k64},
        {"garbage.mha", k64 + k64},
        {"garbage.vtk", k64 + k64},
        {"garbage.vdb", k64 + k64},
        {"garbage.dcm", k64 + k64 + k64},
        {"garbage.tif", k64 + k64},
        {"garbage.png", k64 + k64},
        {"garbage.unknown", k64 + k64},
        {"marked.vdb", std::string(" BDV\0\0\0\0", 8) + k64 + k64},
        {"marked.dcm", std::string(128, '\0') + "DICM" + k64 + k64},
        {"marked.tif", std::string("II*\0", 4) + k64},
        {"marked.png", "\x89PNG\r\n\x1a\n" + k64},
        {"marked.nii.gz", "\x1f\x8b" + k64},
        {"zeros.nii", std::string(400, '\0')},

        {"short.nrrd", kNrrd + "\n" + k64.substr(1)},
        {"nodata.nrrd", kNrrd + "\n"},
        {"noblank.nrrd", kNrrd},
        {"short.mha", kMeta + "ElementDataFile = LOCAL\n" + k64.substr(1)},
        {"short.nii", small().bytes() + k64.substr(1)},
        {"header.nii", small().bytes().substr(0, 300)},
        {"short.nii.gz", test::gzipped(small().bytes() + k64.substr(1))},
        {"cut.nii.gz", test::gzipped(nifti(small())).substr(0, 40)},
        {"nocrc.nii.gz", test::gzipped(nifti(small())).substr(0, test::gzipped(nifti(small())).size() - 8)},
        {"badcrc.nii.gz",
         [] {
             std::string bytes = test::gzipped(nifti(small()));
             bytes[bytes.size() - 6] ^= 1;
             return bytes;
         }()},
        {"short_gz.nrrd",
         "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: gzip\n\n" + test::gzipped(k64.substr(1))},
        {"notgz.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: gzip\n\n" + k64},
        {"short_text.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 1\nencoding: text\n\n1 2 3"},
        {"letters.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: text\n\n1 b"},
        {"overflow.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 1 1\nencoding: text\n\n1 256"},

        {"tendims.nrrd", nrrd("type: uchar\ndimension: 10\nsizes: 2 2 2 2 2 2 2 2 2 2\nencoding: raw\n")},
        {"sixteen.nrrd", nrrd("type: uchar\ndimension: 16\nsizes: 2 2 2 2 2 2 2 2 2 2 2 2 2 2 2 2\nencoding: raw\n")},
        {"manydims.nrrd", nrrd("type: uchar\ndimension: 4000000000\nsizes: 2 2 2\nencoding: raw\n")},
        {"nodims.nrrd", nrrd("type: uchar\ndimension: 0\nsizes: 2\nencoding: raw\n")},
        {"negdims.nrrd", nrrd("type: uchar\ndimension: -3\nsizes: 2 2 2\nencoding: raw\n")},
        {"huge.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 1000000000 1000000000 1000000000\nencoding: raw\n")},
        {"wrap.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4294967296 4294967296 1\nencoding: raw\n")},
        {"wrap64.nrrd", nrrd("type: double\ndimension: 3\nsizes: 2305843009213693952 2 1\nencoding: raw\n")},
        {"toolong.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 99999999999999999999999 2 1\nencoding: raw\n")},
        {"hugegz.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 1000 1000 1000\nencoding: gzip\n")},
        {"zero.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 0 4 4\nencoding: raw\n")},
        {"negative.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: -4 4 4\nencoding: raw\n")},
        {"fewsizes.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4\nencoding: raw\n")},
        {"manysizes.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4 4\nencoding: raw\n")},
        {"type.nrrd", nrrd("type: quaternion\ndimension: 3\nsizes: 4 4 4\nencoding: raw\n")},
        {"block.nrrd", nrrd("type: block\ndimension: 3\nsizes: 4 4 4\nencoding: raw\nblocksize: 8\n")},
        {"encoding.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: lossy\n")},
        {"nanspacing.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nspacings: nan 1 1\nencoding: raw\n")},
        {"infspacing.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nspacings: inf 1 1\nencoding: raw\n")},
        {"zerospacing.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nspacings: 0 1 1\nencoding: raw\n")},
        {"negspacing.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nspacings: -1 1 1\nencoding: raw\n")},
        {"flat.nrrd", nrrd("type: uchar\ndimension: 3\nspace: LPS\nsizes: 4 4 4\nencoding: raw\n"
                           "space directions: (1,0,0) (2,0,0) (0,0,1)\n")},
        {"nandirection.nrrd", nrrd("type: uchar\ndimension: 3\nspace: LPS\nsizes: 4 4 4\nencoding: raw\n"
                                   "space directions: (nan,0,0) (0,1,0) (0,0,1)\n")},
        {"broken_vector.nrrd", nrrd("type: uchar\ndimension: 3\nspace: LPS\nsizes: 4 4 4\nencoding: raw\n"
                                    "space directions: (1,0,0 (0,1,0) (0,0,1)\n")},
        {"nanorigin.nrrd", nrrd("type: uchar\ndimension: 3\nspace: LPS\nsizes: 4 4 4\nencoding: raw\n"
                                "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (nan,0,0)\n")},
        {"skip.nrrd",
         nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\nbyte skip: 18446744073709551615\n")},
        {"lines.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\nline skip: 1000\n")},
        {"endless.nrrd", "NRRD0004\n" + std::string(2 << 20, '#')},
        {"parts.nrrd",
         nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\ndata file: p%03d 0 1000000000 1\n")},
        {"nopart.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 4 4 4\nencoding: raw\ndata file: p%03d 0 3 0\n")},

        {"dims.mha", meta("NDims = 12\n")},
        {"nandims.mha", meta("NDims = x\n")},
        {"sizes.mha", meta("DimSize = 1000000000 1000000000 1000000000\n")},
        {"wrap.mha", meta("DimSize = 4294967296 4294967296 4\n")},
        {"negative.mha", meta("DimSize = -4 4 4\n")},
        {"zero.mha", meta("DimSize = 0 4 4\n")},
        {"channels.mha", meta("ElementNumberOfChannels = 1000000000\n")},
        {"nochannel.mha", meta("ElementNumberOfChannels = 0\n")},
        {"nanspacing.mha", meta("ElementSpacing = nan 1 1\n")},
        {"zerospacing.mha", meta("ElementSpacing = 0 1 1\n")},
        {"negspacing.mha", meta("ElementSpacing = 1 -1 1\n")},
        {"flat.mha", meta("TransformMatrix = 1 0 0 1 0 0 0 0 1\n")},
        {"nanoffset.mha", meta("Offset = nan 0 0\n")},
        {"fewnumbers.mha", meta("Offset = 1 2\n")},
        {"type.mha", meta("ElementType = MET_STRING\n")},
        {"object.mha", meta("ObjectType = Mesh\n")},
        {"nodata.mha", kMeta},
        {"slope.mha", meta("ElementToIntensityFunctionSlope = nan\n")},

        {"dim0.nii", nifti(small().put(40, std::int16_t(0)))},
        {"dim9.nii", nifti(small().put(40, std::int16_t(9)))},
        {"negative.nii", nifti(small().put(42, std::int16_t(-4)))},
        {"zero.nii", nifti(small().put(42, std::int16_t(0)))},
        {"huge.nii", nifti(NiftiBytes({7, 32767, 32767, 32767, 32767, 32767, 32767, 32767}, 64, 64).sform(Mat4(1)))},
        {"large.nii", nifti(NiftiBytes({3, 32767, 32767, 32767}, 2, 8).sform(Mat4(1)))},
        {"large.nii.gz", test::gzipped(nifti(NiftiBytes({3, 32767, 32767, 32767}, 2, 8).sform(Mat4(1))))},
        {"datatype.nii", nifti(small().put(70, std::int16_t(1)))},
        {"nansform.nii", nifti(small().sform(scaled(kNaN)))},
        {"infsform.nii", nifti(small().sform(scaled(kInfinity)))},
        {"flatsform.nii", nifti(small().sform(scaled(0)))},
        {"nanpixdim.nii", nifti(small().put(254, std::int16_t(0)).put(80, std::numeric_limits<float>::quiet_NaN()))},
        {"zeropixdim.nii", nifti(small().put(254, std::int16_t(0)).put(80, 0.0f))},
        {"negpixdim.nii", nifti(small().put(254, std::int16_t(0)).put(252, std::int16_t(1)).put(80, -1.0f))},
        {"offset.nii", nifti(small().put(108, 1e30f))},
        {"nanoffset.nii", nifti(small().put(108, std::numeric_limits<float>::quiet_NaN()))},
        {"negoffset.nii", nifti(small().put(108, -352.0f))},
        {"magic.nii", nifti(small().put(344, 'x'))},
        {"nifti2.nii", nifti(small().put(0, std::int32_t(540)).put(344, 'x'))},

        {"head.vtk", "# vtk DataFile Version 3.0\n"},
        {"sizes.vtk",
         "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\n"
         "DIMENSIONS 1000000000 1000000000 1000000000\nPOINT_DATA 1\nSCALARS s float\n1"},
        {"nosizes.vtk",
         "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nPOINT_DATA 1\nSCALARS s float\n1"},
        {"spacing.vtk",
         "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 1 1 1\n"
         "SPACING 0 1 1\nPOINT_DATA 1\nSCALARS s float\n1"},
        {"cells.vtk",
         "# vtk DataFile Version 3.0\nx\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n"
         "CELL_DATA 1\nSCALARS s float\n1"},

        {"cut.png", test::pngBytes(4, test::counting<std::uint8_t>(16)).substr(0, 60)},
        {"noend.png", test::pngBytes(4, test::counting<std::uint8_t>(16)).substr(0, 50)},
        {"bits.png",
         [] {
             std::string bytes = test::pngBytes(4, test::counting<std::uint8_t>(16));
             bytes[45] ^= 0x55;
             return bytes;
         }()},
        {"wide.png", test::pngBytes(1, test::counting<std::uint8_t>(16)).replace(16, 4, "\x7f\xff\xff\xff")},
        {"cut.tif", test::tiffBytes<std::uint8_t>(4, {test::counting<std::uint8_t>(16)}).substr(0, 130)},
        {"chain.tif",
         [] {  // the directory names itself as the next
             std::string bytes = test::tiffBytes<std::uint8_t>(4, {test::counting<std::uint8_t>(16)});
             return bytes.replace(8 + 2 + 9 * 12, 4, std::string("\x08\0\0\0", 4));
         }()},
        {"entries.tif", std::string("II*\0\x08\0\0\0\xff\xff", 10) + k64},
    };
}

class BadFiles : public testing::TestWithParam<BadFile> {};

TEST_P(BadFiles, AreRefused) {
    const fs::path folder = test::scratchFolder();
    const fs::path path = test::writeFile(folder / GetParam().name, GetParam().bytes);
    IoClient io;
    const std::string message = test::rejection(io, path);
    EXPECT_THAT(message, testing::Not(testing::HasSubstr("died"))) << "voledit-io's own checks let it through";
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1) << "something was written";
    EXPECT_EQ(test::readFile(path), GetParam().bytes);
}

INSTANTIATE_TEST_SUITE_P(, BadFiles, testing::ValuesIn(badFiles()), [](const auto& test) {
    std::string name = test.param.name;
    std::ranges::replace(name, '.', '_');
    return name;
});

TEST(BadInput, AnyTruncationIsRefused) {
    VolumeGrid grid;
    grid.size = {9, 8, 7};
    const auto volume = Volume::fromValues(grid, test::counting<std::int16_t>(grid.valueCount(), -100));
    const fs::path folder = test::scratchFolder();
    IoClient io;
    for (const char* ending : {".nrrd", ".nii", ".nii.gz", ".mha", ".vdb"}) {
        const fs::path whole = folder / (std::string("whole") + ending), cut = folder / (std::string("cut") + ending);
        io.writeVolume(*volume, whole);
        const std::string bytes = test::readFile(whole);
        for (std::size_t n = 0; n < bytes.size(); n += 1 + bytes.size() / 40) {
            SCOPED_TRACE(std::to_string(n) + " bytes");
            test::rejection(io, test::writeFile(cut, bytes.substr(0, n)));
        }
        test::rejection(io, test::writeFile(cut, bytes.substr(0, bytes.size() - 1)));
    }
}

TEST(BadInput, DataFilesStayInTheirFolder) {
    const fs::path outer = test::scratchFolder(), folder = outer / "inner";
    fs::create_directory(folder);
    test::writeFile(outer / "secret.raw", k64);
    test::writeFile(outer / "secret1.raw", k64);
    fs::create_symlink("../secret.raw", folder / "link.raw");
    fs::create_directory_symlink("..", folder / "up");
    IoClient io;
    const std::string absolute = (outer / "secret.raw").string();
    for (const std::string& name :
         {absolute, std::string("../secret.raw"), std::string("./../secret.raw"), std::string("x/../../secret.raw"),
          std::string("link.raw"), std::string("up/secret.raw"), std::string("/etc/passwd"), std::string("/dev/zero"),
          std::string("missing.raw"), std::string("."), std::string("")}) {
        SCOPED_TRACE(name);
        test::rejection(io, test::writeFile(folder / "a.nhdr", kNrrd + "data file: " + name + "\n"));
        test::rejection(io, test::writeFile(folder / "l.nhdr", kNrrd + "data file: LIST\n" + name + "\n"));
        test::rejection(io, test::writeFile(folder / "a.mhd", kMeta + "ElementDataFile = " + name + "\n"));
        test::rejection(io, test::writeFile(folder / "l.mhd", kMeta + "ElementDataFile = LIST\n" + name + "\n"));
    }
    test::rejection(io, test::writeFile(folder / "p.nhdr", kNrrd + "data file: ../secret%d.raw 1 1 1\n"));
    test::rejection(io, test::writeFile(folder / "p.mhd", kMeta + "ElementDataFile = ../secret%d.raw 1 1 1\n"));
    // A link within the folder is fine.
    test::writeFile(folder / "real.raw", k64);
    fs::create_symlink("real.raw", folder / "within.raw");
    EXPECT_EQ(io.readVolume(test::writeFile(folder / "ok.nhdr", kNrrd + "data file: within.raw\n")).format, "nrrd");
}

TEST(BadInput, PipesAndDevicesDoNotHang) {
    const fs::path folder = test::scratchFolder();
    ASSERT_EQ(mkfifo((folder / "pipe.nrrd").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo((folder / "data.raw").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo((folder / "pipe.dcm").c_str(), 0600), 0);
    IoClient io;
    test::rejection(io, folder / "pipe.nrrd");
    test::rejection(io, folder);
    test::rejection(io, test::writeFile(folder / "a.nhdr", kNrrd + "data file: data.raw\n"));
    for (const char* device : {"/dev/zero", "/dev/null", "/dev/full"}) test::rejection(io, device);
    ReadOptions raw;
    raw.raw = parseRawFormat("4x4x4,uint8");
    test::rejection(io, "/dev/zero", raw);
    test::rejection(io, folder, raw);
    EXPECT_THROW(io.readPicture("/dev/zero"), Error);
    EXPECT_THROW(io.readPicture(folder / "pipe.nrrd"), Error);
}

TEST(BadInput, AMissingFileIsSaid) {
    IoClient io;
    EXPECT_THAT(test::rejection(io, "/nowhere/a.nrrd"), testing::HasSubstr("no such file"));
    EXPECT_THROW(io.readVolume(""), Error);
}

TEST(BadInput, DamagedDicomFilesAreRefused) {
    VOLEDIT_SHARED_OR_SKIP(original, "data/volumes/brain_dicom/36749712.dcm");
    const std::string bytes = test::readFile(original);
    const fs::path folder = test::scratchFolder();
    IoClient io;
    for (const std::size_t n : {140ul, 400ul, 2000ul, 20000ul, 80000ul, 120000ul, 154000ul}) {
        SCOPED_TRACE(n);
        test::rejection(io, test::writeFile(folder / "cut.dcm", bytes.substr(0, n)));
    }
}

}  // namespace
}  // namespace voledit
