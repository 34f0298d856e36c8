#pragma once
// What tests share: where the data lies, scratch folders, running the programs.

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voledit::test {

/// A file or folder of the shared test data ("data/volumes/ct_head.mhd"), or nullopt where it is absent.
std::optional<std::filesystem::path> shared(const std::string& path);

/// A file of tests/ ("bad_inputs/truncated.nrrd").
std::filesystem::path fixture(const std::string& path);

/// A new empty folder, removed when the test program ends.
std::filesystem::path scratchFolder();

struct RunResult {
    int status;  // exit status; 128 + n for signal n
    std::string out, err;
    double seconds;
    std::size_t peakBytes;  // largest resident set of the program
};

/// Runs a program of this build ("voledit", "voledit-io") with `arguments` and waits; killed after `timeout` seconds.
RunResult run(const std::string& program, const std::vector<std::string>& arguments, double timeout = 60);

}  // namespace voledit::test

/// Binds `name` to a shared file, or skips the test with a message.
#define VOLEDIT_SHARED_OR_SKIP(name, where)                                            \
    const auto name##Found = voledit::test::shared(where);                             \
    if (!name##Found) GTEST_SKIP() << "shared test data " << where << " is not there"; \
    const std::filesystem::path name = *name##Found
