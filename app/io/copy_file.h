#pragma once
// From a file into shared memory, by the kernel alone.

#include <cstdint>
#include <functional>

#include "app/io/input_file.h"

namespace voledit {

/// Copies `count` bytes of `file` from `offset` on into the memory file `memory` from byte `at` on, over all cores;
/// progress(fraction) is called from any of them. False, with any part of it copied, where it cannot be done so (the
/// file system maps no files); then it must be read. Throws Error where the file ends early or memory does.
bool copyToMemory(const InputFile& file, std::uint64_t offset, std::uint64_t count, int memory, std::uint64_t at,
                  const std::function<void(double)>& progress);

}  // namespace voledit
