#pragma once
// What the parser process may use, and when it ends.

#include <cstdint>

namespace voledit {

/// Ends this process when `parent` does; takes away core dumps, inherited files, and all but `kOpenFiles` open ones.
void confineProcess(int parent);

/// Bounds the address space to `bytes` more than is in use now. Does nothing under the address sanitizer, which
/// reserves terabytes.
void limitMemory(std::uint64_t bytes);

/// Lowers the limit to what a library may need to parse files of `fileBytes` bytes, so that one which believes a lying
/// length does not take all that the user allows.
void limitParsing(std::uint64_t fileBytes);

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
