#pragma once
// Loops over all cores, without the thread library's headers.

#include <cstddef>
#include <functional>

namespace voledit {

/// Calls body(begin, end) on disjoint ranges that cover [0, count), from several threads, each range at most `grain`
/// long (> 0) and cut the same way for every number of threads; returns when all are done. An exception of one is
/// rethrown here. May be nested and called under a lock: while it waits, this thread works for this loop only.
void parallelFor(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

/// Bounds the threads of `parallelFor` for the rest of the process; 0 means one for each core.
void setThreadCount(int threads);
/// Threads that `parallelFor` may use, ≥ 1.
int threadCount();

}  // namespace voledit
