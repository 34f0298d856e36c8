// A signal that ends the program leaves no half-written output behind.
#include "core/io/output_folder.h"

#include <csignal>
#include <fstream>

#include "tests/support/fixtures.h"

namespace voledit {
namespace {

namespace fs = std::filesystem;

TEST(OutputFolderDeathTest, ASignalWaitsUntilTheFolderIsGone) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const fs::path folder = test::scratchFolder();
        EXPECT_EXIT(
            {
                const OutputFolder output(folder / "out.bin");
                std::raise(signal);
                std::ofstream(output.file()) << "whole";
                output.publish({"out.bin"});
            },
            testing::KilledBySignal(signal), "");
        int entries = 0;
        for (const auto& entry : fs::directory_iterator(folder))
            entries += entry.path().filename() == "out.bin" ? 1 : 2;
        EXPECT_EQ(entries, 1) << signal;
    }
}

}  // namespace
}  // namespace voledit
