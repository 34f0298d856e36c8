#include "render/march_table.h"

#include <algorithm>
#include <cmath>

#include "core/fields/extinction.h"

namespace voledit {

namespace {

/// 64 KiB of depths: more would leave the processor's inner caches.
constexpr int kMostBins = 4096;

void setBins(MarchTable& table, Interval range, bool whole) {
    // Whole values lie on bins, where the corners of most transfer functions lie, too.
    if (whole && range.high - range.low + 2 < kMostBins) range = {std::floor(range.low), std::ceil(range.high)};
    const double width = range.high - range.low;
    const bool onBins = whole && width < kMostBins && double(float(range.low)) == range.low;
    table.low = float(range.low);
    table.scale = float(onBins ? std::floor((kMostBins - 1) / width) : (kMostBins - 1) / width);
    table.bins = std::clamp(int(std::ceil(width * double(table.scale))) + 1, 2, kMostBins);
}

}  // namespace

bool MarchTable::mayAbsorb(const Interval& values) const {
    if (!(values.low <= values.high)) return false;
    const double slack = 0.01 + 4e-7 * double(scale) * std::max(std::abs(values.low), std::abs(values.high));
    const auto bin = [&](double position) { return std::size_t(std::clamp(position, 0.0, double(bins - 1))); };
    const std::size_t first = bin((values.low - double(low)) * double(scale) + 0.5 - slack);
    const std::size_t last = bin((values.high - double(low)) * double(scale) + 0.5 + slack);
    // A value that does not change has the extinction of its bin alone.
    return absorbingBefore_[last + 1] > absorbingBefore_[first];
}

MarchTable makeMarchTable(const TransferFunction& look, const Interval& data, bool whole) {
    MarchTable table;
    // A little wider than the corners, so that a step at an end stays one.
    setBins(table, tabulatedRange(look, data, 1.0 / 256, 1e-6), whole);
    std::vector<std::array<float, 4>> plain;
    double depth = 0, before = 0;
    Vec3 glow(0), glowBefore(0);
    table.absorbingBefore_.assign(1, 0);
    for (int n = 0; n < table.bins; ++n) {
        const double value = double(table.low) + n / double(table.scale);
        const double extinction = extinctionOf(look.opacity(value));
        const Vec3 color = look.color(value), shine = extinction * color;
        if (n > 0) {
            depth += 0.5 * (before + extinction);
            glow += 0.5 * (glowBefore + shine);
        }
        before = extinction;
        glowBefore = shine;
        const auto high = float(depth);
        table.depth.push_back({high, float(depth - double(high)), float(extinction), 0});
        table.color.push_back({float(glow.x), float(glow.y), float(glow.z), 0});
        plain.push_back({float(color.x), float(color.y), float(color.z), 0});
        table.absorbingBefore_.push_back(table.absorbingBefore_.back() + (extinction > 0));
    }
    table.next.resize(std::size_t(table.bins));
    float next = float(table.bins);
    for (auto n = std::size_t(table.bins); n-- > 0;) {
        if (table.depth[n][2] > 0) next = float(n);
        table.next[n] = next;
    }
    table.color.insert(table.color.end(), plain.begin(), plain.end());
    return table;
}

}  // namespace voledit
