#pragma once
// Memory that two processes share through a descriptor: how voxels cross without a copy.

#include <cstddef>
#include <memory>
#include <span>

#include "core/io/channel.h"

namespace voledit {

/// Bytes of a mapping that is released with `owner`.
struct MappedBytes {
    std::span<std::byte> bytes;
    std::shared_ptr<void> owner;
};

/// A new memory file of `size` zero bytes (> 0), not yet using memory. Throws Error.
FileDescriptor makeMemoryFile(std::size_t size);

/// The file's bytes, writable, shared with whoever holds the file. Throws Error where address space ends.
MappedBytes mapForWriting(int file, std::size_t size);

/// Forbids every further change of the file, for all who hold it. All writable mappings must be gone. Throws Error.
void seal(int file);

/// The bytes of a sealed file of at least `size` bytes, read-only: nobody can change or shrink it under the reader.
/// Throws Error where it is not so.
std::pair<std::span<const std::byte>, std::shared_ptr<const void>> mapSealed(int file, std::size_t size);

}  // namespace voledit
