#include "app/animation/fingerprint.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

std::string of(const std::vector<std::string>& pieces) {
    Fingerprint print;
    for (const std::string& piece : pieces) print.add(piece);
    return print.text();
}

TEST(Fingerprint, TellsPiecesAndTheirBordersApart) {
    EXPECT_EQ(of({"abc"}), of({"abc"}));
    EXPECT_EQ(of({"abc"}).size(), 32u);
    std::set<std::string> prints;
    const std::vector<std::vector<std::string>> all{{},
                                                    {""},
                                                    {"", ""},
                                                    {"abc"},
                                                    {"ab", "c"},
                                                    {"a", "bc"},
                                                    {"abd"},
                                                    {"abc\n"},
                                                    {"acb"},
                                                    {"12345678"},
                                                    {"12345679"},
                                                    {"123456780"},
                                                    {std::string(8, '\0')},
                                                    {std::string(9, '\0')}};
    for (const auto& pieces : all) prints.insert(of(pieces));
    EXPECT_EQ(prints.size(), all.size());
}

TEST(Fingerprint, EveryBitOfAFileCounts) {
    const fs::path file = test::scratchFolder() / "file";
    std::string bytes(1000, 'x');
    std::set<std::string> prints;
    for (std::size_t i = 0; i < bytes.size(); i += 7)
        for (int bit = 0; bit < 8; ++bit) {
            std::string changed = bytes;
            changed[i] = char(changed[i] ^ (1 << bit));
            std::ofstream(file, std::ios::binary) << changed;
            Fingerprint print;
            ASSERT_TRUE(print.addFile(file));
            prints.insert(print.text());
        }
    EXPECT_EQ(prints.size(), (1000 + 6) / 7 * 8u);
    Fingerprint none;
    EXPECT_FALSE(none.addFile(file.parent_path() / "absent"));
}

/// A scene with a volume of which the header points to another file.
struct SceneFiles {
    fs::path folder = test::scratchFolder();
    SceneFiles() { write(); }
    void write(char voxel = 'a', const std::string& angle = "30") const {
        std::ofstream(folder / "v.mhd") << "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n"
                                           "ElementDataFile = v.raw\n";
        std::ofstream(folder / "v.raw") << std::string(7, 'a') << voxel;
        std::ofstream(folder / "s.voledit") << R"({"voledit":1,"assets":{"v":{"kind":"volume","path":"v.mhd"}},
            "root":{"type":"transfer","by":[{"type":"twist","axis":"z","angle":)"
                                            << angle << R"(}],"of":{"type":"volume","asset":"v"}}})";
    }
    std::string print() const {
        IoClient io;
        return fingerprintOf(openFile(io, folder / "s.voledit", {}));
    }
};

TEST(SceneFingerprint, FollowsValuesAndVoxelsNotPlaces) {
    const SceneFiles one, other;
    const std::string print = one.print();
    EXPECT_EQ(other.print(), print) << "the same in another folder";
    one.write('b');
    EXPECT_NE(one.print(), print) << "a voxel in the file that the header names";
    one.write('a', "31");
    EXPECT_NE(one.print(), print) << "a parameter";
    one.write();
    EXPECT_EQ(one.print(), print);
}

}  // namespace
}  // namespace voledit
