#include "core/scene/tones.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr std::size_t kGrain = 1 << 14;  // pixels at once in a thread

// IEC 61966-2-1.
double linearOf(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
double srgbOf(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double filmic(double linear) {
    const double x = 0.72317 * linear;  // the curve has its 0.18 there
    return std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

}  // namespace

Tones::Tones(const RenderSettings& settings)
    : none_(settings.toneMapping == ToneMapping::None && settings.exposure == 0) {
    if (none_) return;
    const double gain = std::exp2(settings.exposure);
    for (int n = 0; n <= kEntries; ++n) {
        const double light = gain * linearOf(double(n) * kLargest / kEntries);
        table_[std::size_t(n)] = float(srgbOf(settings.toneMapping == ToneMapping::Filmic ? filmic(light) : light));
    }
}

float Tones::operator()(float color) const {
    if (none_) return color;
    const float at = std::clamp(color, 0.0f, kLargest) * (kEntries / kLargest);
    const int n = std::min(int(at), kEntries - 1);
    const float f = at - float(n);
    return (1 - f) * table_[std::size_t(n)] + f * table_[std::size_t(n) + 1];
}

Vec4f Tones::operator()(const Vec4f& p) const {
    if (none_ || !(p.a > 0)) return p;
    const auto toned = [&](float c) { return p.a * (*this)(c / p.a); };
    return {toned(p.r), toned(p.g), toned(p.b), p.a};
}

Picture finishedPicture(Picture drawn, const RenderSettings& settings) {
    const Tones tones(settings);
    if (tones.none() && !settings.transparent) return drawn;
    const Vec3f background = settings.background;
    parallelFor(drawn.pixels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            Vec4f& p = drawn.pixels[n];
            const Vec3f under = (1 - p.a) * background;
            // Rounding must not leave colour where nothing is.
            const Vec4f object = tones(Vec4f(glm::max(Vec3f(p) - under, Vec3f(0)), p.a));
            p = settings.transparent ? object : Vec4f(Vec3f(object) + under, p.a);
        }
    });
    return drawn;
}

Picture reduced(Picture picture, int factor) {
    assert(factor > 0 && picture.size.x % factor == 0 && picture.size.y % factor == 0);
    if (factor == 1) return picture;
    Picture result(picture.size / factor);
    const auto width = std::size_t(result.size.x);
    parallelFor(std::size_t(result.size.y), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                Vec4f sum(0);
                for (int j = 0; j < factor; ++j)
                    for (int i = 0; i < factor; ++i) sum += picture.at(int(x) * factor + i, int(y) * factor + j);
                result.at(int(x), int(y)) = sum / float(factor * factor);
            }
    });
    return result;
}

}  // namespace voledit
