#include "render/visibility.h"

#include <algorithm>
#include <cmath>

namespace voledit {

namespace {
constexpr int kSide = ValueBricks::kSide;
}  // namespace

std::pair<double, double> finiteRange(const ValueBricks& bricks) {
    double low = kInfinity, high = -kInfinity;
    for (std::size_t n = 0; n < bricks.low.size(); ++n) {
        if (std::isfinite(bricks.low[n])) low = std::min(low, double(bricks.low[n]));
        if (std::isfinite(bricks.high[n])) high = std::max(high, double(bricks.high[n]));
    }
    return low <= high ? std::pair(low, high) : std::pair(0.0, 0.0);
}

Visibility::Visibility(const ValueBricks& bricks, const TransferTable& table) : count_(bricks.count) {
    const auto at = [&](int i, int j, int k) {
        return std::size_t(i) +
               std::size_t(count_.x + 1) * (std::size_t(j) + std::size_t(count_.y + 1) * std::size_t(k));
    };
    sums_.assign(at(0, 0, count_.z + 1), 0);
    std::size_t n = 0;
    for (int k = 0; k < count_.z; ++k)
        for (int j = 0; j < count_.y; ++j) {
            int row = 0;
            for (int i = 0; i < count_.x; ++i, ++n) {
                row += bricks.low[n] <= bricks.high[n] && table.visible(bricks.low[n], bricks.high[n]);
                sums_[at(i + 1, j + 1, k + 1)] =
                    row + sums_[at(i + 1, j, k + 1)] + sums_[at(i + 1, j + 1, k)] - sums_[at(i + 1, j, k)];
            }
        }
}

bool Visibility::visible(const Box3& box) const {
    if (sums_.empty()) return true;
    Index3 first, end;
    for (int a = 0; a < 3; ++a) {
        first[a] = int(std::clamp(std::floor(box.min[a] / kSide), 0.0, double(count_[a] - 1)));
        end[a] = int(std::clamp(std::ceil(box.max[a] / kSide), first[a] + 1.0, double(count_[a])));
    }
    const auto sum = [&](int i, int j, int k) {
        return sums_[std::size_t(i) +
                     std::size_t(count_.x + 1) * (std::size_t(j) + std::size_t(count_.y + 1) * std::size_t(k))];
    };
    const int inFront = sum(end.x, end.y, first.z) - sum(first.x, end.y, first.z) - sum(end.x, first.y, first.z) +
                        sum(first.x, first.y, first.z);
    const int atBack = sum(end.x, end.y, end.z) - sum(first.x, end.y, end.z) - sum(end.x, first.y, end.z) +
                       sum(first.x, first.y, end.z);
    return atBack > inFront;
}

}  // namespace voledit
