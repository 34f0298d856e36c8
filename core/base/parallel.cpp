#include "core/base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace voledit {

namespace {
std::unique_ptr<tbb::global_control>& threadLimit() {
    static std::unique_ptr<tbb::global_control> limit;
    return limit;
}
}  // namespace

void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
    if (count <= grain) {
        if (count) body(0, count);
        return;
    }
    // Isolated: while this thread waits it must not take up other work, which might want a lock that it holds.
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, count, grain),
            [&](const tbb::blocked_range<std::size_t>& r) { body(r.begin(), r.end()); }, tbb::simple_partitioner());
    });
}

void setThreadCount(int threads) {
    threadLimit().reset();
    if (threads > 0)
        threadLimit() = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
}

int threadCount() {
    return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace voledit
