#include "core/rays/optical_table.h"

#include <algorithm>
#include <cmath>

#include "core/fields/extinction.h"

namespace voledit {

namespace {

constexpr int kMostBins = 16383;

}  // namespace

OpticalTable makeOpticalTable(const TransferFunction& look, const Interval& data, bool whole, double unit) {
    const Interval range = tabulatedRange(look, data, 1, 1e-3);
    const double width = range.high - range.low;
    OpticalTable table;
    table.low = static_cast<float>(range.low);
    // Whole values lie on bins, where the corners of most transfer functions lie, too.
    const bool onBins = whole && width <= kMostBins && double(table.low) == std::floor(range.low);
    table.scale = static_cast<float>(onBins ? std::floor(kMostBins / width) : kMostBins / width);
    table.last = std::clamp(int(std::ceil(width * double(table.scale))), 1, kMostBins);
    const auto entries = std::size_t(table.last) + 2;
    table.depth.reserve(entries);
    table.color.reserve(4 * entries);
    double depth = 0, extinctionBefore = 0;
    Vec3 color(0), glowBefore(0);
    for (std::size_t n = 0; n < entries; ++n) {
        const double value = double(table.low) + double(n) / double(table.scale);
        const double extinction = extinctionOf(look.opacity(value)) * unit;
        const Vec3 glow = extinction * look.color(value);
        if (n > 0) {
            depth += 0.5 * (extinctionBefore + extinction);
            color += 0.5 * (glowBefore + glow);
        }
        extinctionBefore = extinction;
        glowBefore = glow;
        table.depth.push_back(static_cast<float>(depth));
        for (int c = 0; c < 3; ++c) table.color.push_back(static_cast<float>(color[c]));
        table.color.push_back(0);
    }
    return table;
}

SteepnessTable makeSteepnessTable(const PiecewiseLinear& gradientOpacity) {
    SteepnessTable table;
    if (gradientOpacity.points.empty()) return table;
    table.last = 1024;
    table.scale = static_cast<float>(table.last / std::max(gradientOpacity.points.back().x, 1e-30));
    for (int n = 0; n < table.last + 2; ++n)
        table.factor.push_back(static_cast<float>(std::max(gradientOpacity(double(n) / double(table.scale)), 0.0)));
    return table;
}

bool OpticalTable::mayAbsorb(float lowest, float highest) const {
    if (!(lowest <= highest)) return false;
    const float slack = 0.01F + 4e-7F * scale * std::max(std::abs(lowest), std::abs(highest));
    const auto bin = [&](float position) { return int(std::clamp(position, 0.0F, float(last))); };
    const int first = bin((lowest - low) * scale + 0.5F - slack), end = bin((highest - low) * scale + 0.5F + slack) + 1;
    return depth[std::size_t(end)] > depth[std::size_t(first)];
}

}  // namespace voledit
