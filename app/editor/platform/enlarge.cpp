#include "app/editor/platform/enlarge.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/parallel.h"

namespace voledit {

namespace {

constexpr std::size_t kRows = 16;  // at once in a thread

// Four pixels of a line, and how much each counts.
struct Taps {
    std::array<int, 4> at;
    std::array<float, 4> weight;
};

Taps tapsAt(double x, int count) {
    const double first = std::floor(x);
    const auto f = float(x - first);
    Taps taps{};
    for (int n = 0; n < 4; ++n) taps.at[std::size_t(n)] = std::clamp(int(first) - 1 + n, 0, count - 1);
    taps.weight = {f * (-0.5f + f * (1 - 0.5f * f)), 1 + f * f * (-2.5f + 1.5f * f), f * (0.5f + f * (2 - 1.5f * f)),
                   f * f * (-0.5f + 0.5f * f)};
    return taps;
}

// Written so that it becomes vector instructions.
std::uint8_t byteOf(float value) {
    const float scaled = value * 255 + 0.5f, low = scaled > 0 ? scaled : 0;
    return std::uint8_t(int(low < 255 ? low : 255));
}

// For every column of the view.
std::vector<Taps> columnsOf(Index2 from, Index2 size) {
    const double wide = double(size.x) / size.y * from.y / from.x;
    std::vector<Taps> columns(std::size_t(size.x));
    for (int x = 0; x < size.x; ++x)
        columns[std::size_t(x)] = tapsAt((0.5 + ((x + 0.5) / size.x - 0.5) * wide) * from.x - 0.5, from.x);
    return columns;
}

void stretch(const Vec4f* line, const std::vector<Taps>& columns, float* out) {
    for (const Taps& taps : columns) {
        const Vec4f c = taps.weight[0] * line[taps.at[0]] + taps.weight[1] * line[taps.at[1]] +
                        taps.weight[2] * line[taps.at[2]] + taps.weight[3] * line[taps.at[3]];
        for (int n = 0; n < 4; ++n) *out++ = c[n];
    }
}

void blend(const std::array<const float*, 4>& lines, const std::array<float, 4>& w, std::size_t count,
           std::uint8_t* out) {
    const float *a = lines[0], *b = lines[1], *c = lines[2], *d = lines[3];
    for (std::size_t n = 0; n < count; ++n) out[n] = byteOf(w[0] * a[n] + w[1] * b[n] + w[2] * c[n] + w[3] * d[n]);
}

void toBytes(const float* line, std::size_t count, std::uint8_t* out) {
    for (std::size_t n = 0; n < count; ++n) out[n] = byteOf(line[n]);
    for (std::size_t n = 3; n < count; n += 4) out[n] = 255;
}

}  // namespace

void enlarge(const Picture& picture, Index2 size, std::vector<std::uint8_t>& bytes) {
    const auto width = std::size_t(size.x) * 4, height = std::size_t(size.y);
    bytes.resize(width * height);
    const auto rowOf = [&](std::size_t y) { return &bytes[width * (height - 1 - y)]; };
    const auto lineOf = [&](std::size_t y) { return &picture.pixels[y * std::size_t(picture.size.x)]; };
    if (picture.size == size) {
        parallelFor(height, kRows, [&](std::size_t begin, std::size_t end) {
            for (std::size_t y = begin; y < end; ++y) toBytes(&lineOf(y)->x, width, rowOf(y));
        });
        return;
    }
    const std::vector<Taps> columns = columnsOf(picture.size, size);
    std::vector<float> wide(width * std::size_t(picture.size.y));
    parallelFor(std::size_t(picture.size.y), kRows, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) stretch(lineOf(y), columns, &wide[y * width]);
    });
    parallelFor(height, kRows, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            const Taps taps = tapsAt((double(y) + 0.5) / size.y * picture.size.y - 0.5, picture.size.y);
            std::array<const float*, 4> lines{};
            for (std::size_t n = 0; n < 4; ++n) lines[n] = &wide[std::size_t(taps.at[n]) * width];
            blend(lines, taps.weight, width, rowOf(y));
            for (std::size_t x = 3; x < width; x += 4) rowOf(y)[x] = 255;
        }
    });
}

}  // namespace voledit
