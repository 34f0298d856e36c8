#pragma once
// Reading a file that mixes lines of text, words and stretches of bytes.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/io/input_file.h"

namespace voledit {

/// A place in a file that moves on as things are read. Buffered.
class VtkCursor {
public:
    /// `file` must outlive it.
    explicit VtkCursor(const InputFile& file, std::uint64_t position = 0);

    /// Byte of the file that comes next.
    std::uint64_t position() const { return offset_ + at_; }
    void moveTo(std::uint64_t position);
    /// Bytes from here to the file's end.
    std::uint64_t left() const { return position() < file_.size() ? file_.size() - position() : 0; }
    /// Ends of lines passed by `line` and `word` since the start.
    std::uint64_t linesPassed() const { return lines_; }

    /// The next line without its end (LF or CR LF); nullopt at the end of the file. Throws Error past 64 KiB.
    std::optional<std::string> line();
    /// The next word between white space or commas; empty at the end of the file. Valid until the next call. One that
    /// is too long for any number comes in pieces.
    std::string_view word();
    /// True if the next bytes are `text` (lower case), in any case.
    bool ahead(std::string_view text);
    /// Fills `out` as far as the file reaches; gives how far.
    std::size_t read(std::span<std::byte> out);

private:
    /// Makes at least `wanted` bytes available in the buffer, fewer only at the end of the file; gives how many are.
    std::size_t need(std::size_t wanted);

    const InputFile& file_;
    std::uint64_t offset_;  // of buffer_[0] in the file
    std::string buffer_;
    std::size_t at_ = 0, end_ = 0;  // what of the buffer is still to come
    std::uint64_t lines_ = 0;
};

}  // namespace voledit
