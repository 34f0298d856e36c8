#pragma once
// What the parser process may use, and when it ends.

#include <cstdint>

namespace voledit {

/// Ends this process when `parent` does; takes away core dumps, inherited files, and all but `kOpenFiles` open ones.
void confineProcess(int parent);

/// Bounds the address space to `bytes` more than is in use now. Does nothing under the address sanitizer, which
/// reserves terabytes.
void limitMemory(std::uint64_t bytes);

/// While it lives there is no limit; afterwards the last one holds again, counted from what is in use then.
class MemoryLimitLifted {
public:
    MemoryLimitLifted();
    ~MemoryLimitLifted();
    MemoryLimitLifted(const MemoryLimitLifted&) = delete;
    MemoryLimitLifted& operator=(const MemoryLimitLifted&) = delete;
};

inline constexpr int kOpenFiles = 256;

}  // namespace voledit
