#include "app/io/checks.h"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/base/error.h"

namespace voledit {

std::uint64_t checkProduct(const std::string& where, std::initializer_list<std::uint64_t> factors) {
    std::uint64_t product = 1;
    for (const std::uint64_t n : factors)
        if (__builtin_mul_overflow(product, n, &product) || product >> 62)
            throw Error(where, "claims more voxels than any computer can address",
                        "the header is damaged: correct its sizes");
    return product;
}

void checkSizes(const std::string& where, const std::array<std::uint64_t, 3>& size, std::uint64_t channels) {
    for (const std::uint64_t n : size)
        if (n < 1 || n > std::uint64_t(std::numeric_limits<int>::max()))
            throw Error(where, "has a size of " + std::to_string(n), "each size must be at least 1 and below 2^31");
    if (channels < 1 || channels > 4096)
        throw Error(where, "has " + std::to_string(channels) + " values a voxel", "there must be 1 to 4096");
    checkProduct(where, {size[0], size[1], size[2], channels, 8});
}

void checkSpacing(const std::string& where, const Vec3& spacing) {
    for (int a = 0; a < 3; ++a)
        if (!(std::isfinite(spacing[a]) && spacing[a] > 0))
            throw Error(where, "has a spacing of " + std::to_string(spacing[a]),
                        "spacings must be positive, finite numbers of millimetres");
}

bool isUsable(const Mat4& m) {
    double lengths = 1;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 3; ++r)
            if (!std::isfinite(m[c][r])) return false;
        if (c < 3) lengths *= glm::length(Vec3(m[c]));
    }
    return std::isnormal(lengths) && std::abs(glm::determinant(Mat3(m))) > 1e-9 * lengths;
}

void checkAffine(const std::string& where, const Mat4& m) {
    if (!isUsable(m))
        throw Error(where, "its axes do not span space, or are no finite numbers",
                    "correct the directions, spacings and origin in the header");
}

std::string inQuotes(std::string_view text) {
    std::string result = "\"";
    for (const char c : text.substr(0, 40)) result += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    result += '"';
    return result;
}

std::string readableBytes(std::uint64_t bytes) {
    const char* units[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB"};
    double value = double(bytes);
    int unit = 0;
    for (; value >= 1024 && unit < 5; ++unit) value /= 1024;
    char text[48];
    std::snprintf(text, sizeof text, unit == 0 ? "%.0f %s" : "%.1f %s", value, units[unit]);
    return text;
}

}  // namespace voledit
