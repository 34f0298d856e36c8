#include "core/base/picture.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace voledit {

std::vector<std::uint8_t> toRgb8(const Picture& picture) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(picture.pixels.size() * 3);
    for (const Vec4f& p : picture.pixels)
        for (int c = 0; c < 3; ++c)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(p[c], 0.0f, 1.0f) * 255.0f)));
    return bytes;
}

double psnr(const Picture& a, const Picture& b) {
    assert(a.size == b.size);
    const auto x = toRgb8(a), y = toRgb8(b);
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += (double(x[i]) - y[i]) * (double(x[i]) - y[i]);
    if (sum == 0) return kInfinity;
    return 10 * std::log10(255.0 * 255.0 * double(x.size()) / sum);
}

}  // namespace voledit
