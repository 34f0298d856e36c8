#pragma once
// Voxels written as text.

#include "app/io/decode.h"

namespace voledit {

/// Fills `out` with the first numbers of the part's text, in the machine's byte order. Throws Error where a word is no
/// number of the type, or the text ends early.
void decodeNumbers(const PartTask& task, const InputFile& file, std::span<std::byte> out);

/// Fills `out` with the first bytes written as two hexadecimal digits each. Throws Error.
void decodeHex(const PartTask& task, const InputFile& file, std::span<std::byte> out);

}  // namespace voledit
