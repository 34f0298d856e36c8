#include "render/transfer_table.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace voledit {

namespace {

/// The part of [min, max] in which the function changes, a little wider so that a step at its end stays a step.
std::pair<double, double> changingRange(const TransferFunction& function, double min, double max) {
    double low = kInfinity, high = -kInfinity;
    const auto take = [&](double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    };
    for (const auto& point : function.color.points) take(point.value);
    for (const auto& point : function.opacity.points) take(point.x);
    if (!(low <= high)) take(min);
    const double margin = std::max({(high - low) / 1000, std::abs(low) * 1e-6, std::abs(high) * 1e-6, 1e-12});
    low = std::clamp(low - margin, min, max);
    high = std::clamp(high + margin, min, max);
    if (!(low < high)) high = low + std::max(std::abs(low) * 1e-6, 1e-12);
    return {low, high};
}

double thicknessOf(double opacity) {
    return -std::log(1 - std::clamp(opacity, 0.0, 0.9999));
}

}  // namespace

bool TransferTable::visible(double from, double to) const {
    const double scale = (kSize - 1) / (high - low);
    const auto entry = [&](double value) { return std::clamp((value - low) * scale, 0.0, double(kSize - 1)); };
    const auto first = std::size_t(std::floor(entry(from))), last = std::size_t(std::ceil(entry(to)));
    return visibleBefore_[last + 1] > visibleBefore_[first];
}

TransferTable makeTransferTable(const TransferFunction& function, double min, double max) {
    TransferTable table;
    std::tie(table.low, table.high) = changingRange(function, min, max);
    table.visibleBefore_.push_back(0);
    for (int n = 0; n < TransferTable::kSize; ++n) {
        const double value = table.low + (table.high - table.low) * n / (TransferTable::kSize - 1);
        const double thickness = thicknessOf(function.opacity(value));
        const Vec3 color = function.color(value);
        table.thickness.push_back(float(thickness));
        if (thickness > 0) {
            // Interpolation reaches to the neighbouring entries.
            table.firstVisible = std::min(table.firstVisible, std::max(n - 1.0, 0.0));
            table.lastVisible = std::min(n + 1.0, TransferTable::kSize - 1.0);
        }
        table.color.insert(table.color.end(), {float(color.x), float(color.y), float(color.z), 0.0F});
        table.visibleBefore_.push_back(table.visibleBefore_.back() + (thickness > 0));
    }
    if (!function.gradientOpacity.points.empty()) {
        table.gradientHigh = std::max(function.gradientOpacity.points.back().x * 1.001, 1e-12);
        for (int n = 0; n < TransferTable::kSize; ++n)
            table.gradientFactor.push_back(
                float(function.gradientOpacity(table.gradientHigh * n / (TransferTable::kSize - 1))));
    }
    return table;
}

}  // namespace voledit
