#pragma once
// Files that voledit-io writes: plain, gzip or zlib.

#include <zlib.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "app/io/input_file.h"

namespace voledit {

enum class Packing : std::uint8_t { Plain, Gzip, Zlib };

/// A new file. Every failure (a full disk) is an Error; `close` must be called, or the file is not whole.
class OutputFile {
public:
    explicit OutputFile(const Source& target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// From here on what is written is packed so; ends what was packed before.
    void pack(Packing packing);
    void write(std::span<const std::byte> bytes);
    void write(const std::string& text) { write(std::as_bytes(std::span(text))); }
    /// Bytes in the file so far.
    std::uint64_t size() const { return size_; }
    void close();

private:
    void writePlain(std::span<const std::byte> bytes);
    void deflateSome(int flush);

    std::string name_;
    FileDescriptor file_;
    std::uint64_t size_ = 0;
    Packing packing_ = Packing::Plain;
    z_stream stream_{};
    std::vector<std::byte> buffer_;
};

}  // namespace voledit
