#pragma once
// Files of strangers: opened without hanging, read by position, data files kept within their header's folder.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "core/io/channel.h"

namespace voledit {

/// A file, and what the user calls it in messages.
struct Source {
    std::filesystem::path path;
    std::string name;
};

/// An ordinary file, open for reading.
class InputFile {
public:
    /// Throws Error where `source` is missing, closed to us, or no ordinary file (a pipe or a device would hang).
    explicit InputFile(const Source& source);

    const std::string& name() const { return name_; }
    std::uint64_t size() const { return size_; }
    int descriptor() const { return file_.get(); }

    /// Reads up to out.size() bytes from `offset`; fewer only at the file's end. Throws Error.
    std::size_t readAt(std::uint64_t offset, std::span<std::byte> out) const;
    /// The first `length` bytes, or all where there are fewer, as text.
    std::string start(std::size_t length) const;

private:
    std::string name_;
    FileDescriptor file_;
    std::uint64_t size_ = 0;
};

/// The file that a header names as its data, in the header's folder or below. Throws Error where the name is absolute,
/// climbs out by "..", leads out by a symbolic link, or is not there. `line`: the header's line, for the message.
Source dataFileOf(const Source& header, const std::string& written, int line);

/// "NAME, line N".
std::string placeOf(const Source& header, int line);

}  // namespace voledit
