#include "app/io/limits.h"

#include <malloc.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "core/base/parallel.h"

namespace voledit {

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

volatile pid_t parentProcess = 0;
std::uint64_t lastLimit = 0;

// The signal also comes when only the thread that started us has ended.
void onParentDeath(int) {
    if (getppid() != parentProcess) _exit(0);
}

std::uint64_t addressSpaceInUse() {
    unsigned long pages = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return std::uint64_t(pages) * std::uint64_t(sysconf(_SC_PAGESIZE));
}

void setLimit(int resource, rlim_t value) {
    rlimit limit{};
    getrlimit(__rlimit_resource_t(resource), &limit);
    limit.rlim_cur = limit.rlim_max == RLIM_INFINITY || value < limit.rlim_max ? value : limit.rlim_max;
    setrlimit(__rlimit_resource_t(resource), &limit);
}

}  // namespace

void confineProcess(int parent) {
    parentProcess = parent;
    std::signal(SIGUSR1, onParentDeath);
    prctl(PR_SET_PDEATHSIG, SIGUSR1);
    if (getppid() != parent) _exit(0);
    std::signal(SIGPIPE, SIG_IGN);
    close_range(4, ~0u, 0);
    setLimit(RLIMIT_CORE, 0);
    mallopt(M_ARENA_MAX, 4);  // each reserves 64 MiB of the address space that `limitMemory` bounds
    setLimit(RLIMIT_NOFILE, kOpenFiles);
}

void limitMemory(std::uint64_t bytes) {
    lastLimit = bytes;
    // What is mapped already, libraries above all, is mostly not used: it does not count.
    if (!kSanitized) setLimit(RLIMIT_AS, rlim_t(addressSpaceInUse() + bytes));
}

void limitParsing(std::uint64_t fileBytes) {
    constexpr std::uint64_t base = 256 << 20, thread = 16 << 20, times = 64;
    limitMemory(std::min(lastLimit, base + thread * std::uint64_t(threadCount()) + times * fileBytes));
}

MemoryLimitLifted::MemoryLimitLifted() {
    setLimit(RLIMIT_AS, RLIM_INFINITY);
}

MemoryLimitLifted::~MemoryLimitLifted() {
    limitMemory(lastLimit);
}

}  // namespace voledit
