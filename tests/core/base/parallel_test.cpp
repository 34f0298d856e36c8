#include "core/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <vector>

namespace voledit {
namespace {

TEST(Parallel, CoversEveryIndexOnceInRangesOfTheGrain) {
    std::vector<std::atomic<int>> seen(10007);
    parallelFor(seen.size(), 100, [&](std::size_t begin, std::size_t end) {
        EXPECT_LE(end - begin, 100u);
        for (std::size_t i = begin; i < end; ++i) ++seen[i];
    });
    for (const auto& count : seen) EXPECT_EQ(count, 1);
}

TEST(Parallel, CutsTheSameForEveryNumberOfThreads) {
    const auto ranges = [] {
        std::set<std::pair<std::size_t, std::size_t>> found;
        std::mutex mutex;
        parallelFor(1000, 7, [&](std::size_t begin, std::size_t end) {
            const std::lock_guard lock(mutex);
            found.insert({begin, end});
        });
        return found;
    };
    setThreadCount(1);
    EXPECT_EQ(threadCount(), 1);
    const auto one = ranges();
    setThreadCount(4);
    EXPECT_EQ(threadCount(), 4);
    EXPECT_EQ(ranges(), one);
    setThreadCount(0);
}

TEST(Parallel, RethrowsWhatABodyThrows) {
    EXPECT_THROW(parallelFor(100, 1,
                             [](std::size_t begin, std::size_t) {
                                 if (begin == 50) throw std::runtime_error("fifty");
                             }),
                 std::runtime_error);
    parallelFor(0, 1, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(Parallel, ALoopWithinALockTakesUpNoOtherWork) {
    // Every outer task builds the same thing once, with a loop inside: were the waiting builder to take up another
    // outer task, it would wait for itself.
    for (int round = 0; round < 50; ++round) {
        std::once_flag once;
        std::atomic<int> built{0};
        parallelFor(64, 1, [&](std::size_t, std::size_t) {
            std::call_once(once, [&] { parallelFor(64, 1, [&](std::size_t, std::size_t) { ++built; }); });
        });
        EXPECT_EQ(built, 64);
    }
}

}  // namespace
}  // namespace voledit
