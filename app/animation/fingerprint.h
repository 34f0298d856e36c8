#pragma once
// Whether something is what it was: short hashes of scenes, files and settings.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "app/opening/open_file.h"

namespace voledit {

/// A 128-bit hash built up piece by piece, the same on every machine of one byte order. Tells accidental changes
/// apart; it is no protection against somebody who looks for a collision.
class Fingerprint {
public:
    /// The bytes and their number, so that pieces cannot run into each other.
    void add(std::span<const std::byte> bytes);
    void add(const std::string& text) { add(std::as_bytes(std::span(text))); }
    /// The bytes of a file; of a folder, the names and bytes of the files in it. False where it cannot be read.
    bool addFile(const std::filesystem::path& path);
    /// 32 hexadecimal digits.
    std::string text() const;

private:
    void mix(std::uint64_t word);
    std::uint64_t a_ = 0x243f6a8885a308d3, b_ = 0x13198a2e03707344;
};

/// What a scene shows: its values and what its files hold, not where they lie; so a copy of the scene elsewhere has the
/// same fingerprint.
std::string fingerprintOf(const OpenedScene& opened);

}  // namespace voledit
