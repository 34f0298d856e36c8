#pragma once
// Checks that every format shares, before any memory is taken or a library sees the file.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

#include "core/base/types.h"

namespace voledit {

/// What deflate can at most make of a byte (its longest match, 258 bytes, costs two bits).
inline constexpr std::uint64_t kDeflateRatio = 1032;

/// The product; throws Error that names `where` where it does not fit 62 bits.
std::uint64_t checkProduct(const std::string& where, std::initializer_list<std::uint64_t> factors);

/// Throws Error unless each size is 1 … 2³¹ − 1 and channels 1 … 4096.
void checkSizes(const std::string& where, const std::array<std::uint64_t, 3>& size, std::uint64_t channels);

/// Throws Error unless each spacing is finite and positive.
void checkSpacing(const std::string& where, const Vec3& spacing);

/// Throws Error unless the matrix is finite and its axes span space.
void checkAffine(const std::string& where, const Mat4& worldFromIndex);

/// True where `checkAffine` would pass.
bool isUsable(const Mat4& worldFromIndex);

/// A stranger's text for messages: in quotation marks, at most 40 characters, control characters replaced.
std::string inQuotes(std::string_view text);

/// "1.5 GiB", for messages.
std::string readableBytes(std::uint64_t bytes);

}  // namespace voledit
