#include "app/cli/terminal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace voledit {
namespace {

TEST(WithProgress, ReturnsAsSoonAsTheWorkIsDone) {
    using namespace std::chrono;
    // The shortest of several, as other programs may take the processor.
    auto shortest = steady_clock::duration::max();
    for (int i = 0; i < 20; ++i) {
        const auto start = steady_clock::now();
        withProgress("Sleeping", Verbosity::Quiet, [](Progress*) { std::this_thread::sleep_for(milliseconds(5)); });
        shortest = std::min(shortest, steady_clock::now() - start);
    }
    EXPECT_LT(shortest, milliseconds(15));
}

}  // namespace
}  // namespace voledit
