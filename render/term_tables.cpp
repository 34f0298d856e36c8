#include "render/term_tables.h"

#include <algorithm>
#include <cmath>

namespace voledit {

void setRange(ProgramTable& table, const std::optional<Interval>& values) {
    double low = kInfinity, high = -kInfinity;
    const auto take = [&](double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    };
    for (const auto& point : table.color.points) take(point.value);
    for (const auto& point : table.value.points) take(point.x);
    if (!(low <= high)) take(0);
    // A little wider, so that a step at an end stays a step.
    const double margin = std::max({(high - low) / 1000, std::abs(low) * 1e-6, std::abs(high) * 1e-6, 1e-12});
    low -= margin;
    high += margin;
    if (values && values->low <= values->high) {
        low = std::clamp(low, values->low, values->high);
        high = std::clamp(high, values->low, values->high);
    }
    if (!(low < high)) high = low + std::max(std::abs(low) * 1e-6, 1e-12);
    table.low = low;
    table.high = high;
}

std::vector<float> entriesOf(const ProgramTable& table) {
    std::vector<float> entries;
    entries.reserve(std::size_t(kTableEntries) * 4);
    for (int n = 0; n < kTableEntries; ++n) {
        const double x = table.low + (table.high - table.low) * n / (kTableEntries - 1);
        const Vec3 color = table.color(x);
        entries.insert(entries.end(), {float(color.x), float(color.y), float(color.z), float(table.value(x))});
    }
    return entries;
}

}  // namespace voledit
