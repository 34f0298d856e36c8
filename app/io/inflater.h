#pragma once
// Streaming decompression of gzip and zlib data.

#include <zlib.h>

#include <span>
#include <vector>

#include "app/io/input_file.h"

namespace voledit {

/// Reads compressed bytes of a file from an offset on: one zlib stream, or gzip members one behind the other.
class Inflater {
public:
    Inflater(const InputFile& file, std::uint64_t offset);
    ~Inflater();
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /// Fills `out` (not empty) as far as there is data; 0 at the stream's sound end. Throws Error where the data is
    /// damaged or breaks off.
    std::size_t read(std::span<std::byte> out);
    /// After the end: true where the file goes on with something else.
    bool trailing() const { return trailing_; }

private:
    void refill();
    /// At the end of a stream: goes on with the next gzip member, if one follows.
    void endMember();

    const InputFile& file_;
    std::uint64_t offset_;
    std::vector<std::byte> input_;
    z_stream stream_{};
    bool done_ = false, trailing_ = false;
};

}  // namespace voledit
