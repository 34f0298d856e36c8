#pragma once
// Pictures in memory and how far two of them differ.

#include <vector>

#include "core/base/types.h"

namespace voledit {

/// Float RGBA, row by row from the top left; colour as composited (sRGB values, premultiplied by nothing: the
/// background is already under it), alpha = 1 − transmittance. Values are in [0, 1] but not clamped.
struct Picture {
    Index2 size{0, 0};
    std::vector<Vec4f> pixels;  // size.x * size.y

    Picture() = default;
    explicit Picture(Index2 s, Vec4f fill = Vec4f(0)) : size(s), pixels(std::size_t(s.x) * std::size_t(s.y), fill) {}

    Vec4f& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(size.x) + std::size_t(x)]; }
    const Vec4f& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(size.x) + std::size_t(x)]; }
};

/// The picture as 8-bit RGB bytes, 3 · size.x · size.y, rounded to nearest and clamped.
std::vector<std::uint8_t> toRgb8(const Picture& picture);

/// Peak signal-to-noise ratio of two pictures of one size over 8-bit RGB, in decibels (peak 255); +infinity if equal.
double psnr(const Picture& a, const Picture& b);

}  // namespace voledit
