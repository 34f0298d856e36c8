#include "core/objects/shadow_volume.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "core/base/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/objects/shadow_volume.cpp"
#include <hwy/foreach_target.h>  // compiles this file once for each instruction set

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace voledit::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using F = HWY_CAPPED(float, 8);
using Real = hn::Vec<F>;

/// Rays pass a plane: each of light[n] meets the alpha between alpha[n] and alpha[n + 1] over a distance of 1 + beyond
/// spacings (beyond < 1); left[n] is what comes to the middle of it, · 65535. Reads and writes whole vectors.
void passPlane(const float* alpha, float fraction, float beyond, std::size_t count, float* light, std::uint16_t* left) {
    const Real one = hn::Set(F(), 1), f = hn::Set(F(), fraction);
    const Real linear = hn::Set(F(), beyond), square = hn::Set(F(), beyond * (1 - beyond) / 2);
    const hn::Rebind<std::uint16_t, F> narrow;
    const auto pass = [&](std::size_t n) HWY_ATTR {
        const Real low = hn::LoadU(F(), alpha + n), high = hn::LoadU(F(), alpha + n + 1);
        const Real a = hn::Add(low, hn::Mul(f, hn::Sub(high, low)));
        // (1 − a)^(1 + beyond), its second factor by the first terms of its series.
        const Real more = hn::Sub(one, hn::Mul(a, hn::Add(linear, hn::Mul(square, a))));
        const Real before = hn::LoadU(F(), light + n), after = hn::Mul(before, hn::Mul(hn::Sub(one, a), more));
        hn::StoreU(after, F(), light + n);
        return hn::NearestInt(hn::Mul(hn::Add(before, after), hn::Set(F(), 65535 / 2.0F)));
    };
    const std::size_t lanes = hn::Lanes(F());
    std::size_t n = 0;
    for (; n + lanes <= count; n += lanes) hn::StoreU(hn::DemoteTo(narrow, pass(n)), narrow, left + n);
    if (n == count) return;
    std::uint16_t last[8];
    hn::StoreU(hn::DemoteTo(narrow, pass(n)), narrow, last);
    std::copy_n(last, count - n, left + n);
}

/// alpha[n] = the mean of two rows by a fraction.
void mixRows(const std::uint16_t* low, const std::uint16_t* high, float fraction, std::size_t count, float* alpha) {
    const hn::Rebind<std::uint16_t, F> narrow;
    const hn::RebindToSigned<F> wide;
    const Real f = hn::Set(F(), fraction), scale = hn::Set(F(), 1 / 65535.0F);
    const std::size_t lanes = hn::Lanes(F());
    const auto read = [&](const std::uint16_t* from)
                          HWY_ATTR { return hn::ConvertTo(F(), hn::PromoteTo(wide, hn::LoadU(narrow, from))); };
    std::size_t n = 0;
    for (; n + lanes <= count; n += lanes) {
        const Real a = read(low + n), b = read(high + n);
        hn::StoreU(hn::Mul(hn::Add(a, hn::Mul(f, hn::Sub(b, a))), scale), F(), alpha + n);
    }
    for (; n < count; ++n) alpha[n] = (float(low[n]) + fraction * (float(high[n]) - float(low[n]))) * (1 / 65535.0F);
}

}  // namespace voledit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace voledit {

HWY_EXPORT(passPlane);
HWY_EXPORT(mixRows);

namespace {

constexpr int kVector = 8;  // the longest, in passPlane

int remainder(int n, int of) {
    const int r = n % of;
    return r < 0 ? r + of : r;
}

/// The rows of cells that rays of light cross.
struct Planes {
    int row, column, plane;  // axes of the grid: along a row, from row to row, from plane to plane
    Index3 count;            // cells on these
    std::array<std::size_t, 3> stride{};
    std::array<float, 2> slope{};  // how far light goes along row and column from plane to plane
    float beyond = 0;              // the way from plane to plane, less 1, spacings
    bool fromEnd = false;          // light comes from the last plane

    Planes(const OpacityGrid& grid, const Vec3f& toward) {
        const Index3 size = grid.size();
        plane = 0;
        for (int a = 1; a < 3; ++a)
            if (std::abs(toward[a]) > std::abs(toward[plane])) plane = a;
        row = plane == 0 ? 1 : 0;
        column = 3 - plane - row;
        const std::array<std::size_t, 3> strides{1, std::size_t(size.x), std::size_t(size.x) * std::size_t(size.y)};
        const std::array<int, 3> axes{row, column, plane};
        for (std::size_t n = 0; n < 3; ++n) {
            count[int(n)] = size[axes[n]];
            stride[n] = strides[std::size_t(axes[n])];
        }
        slope = {toward[row] / toward[plane], toward[column] / toward[plane]};
        beyond = std::min(1 / std::abs(toward[plane]) - 1, 1.0F);
        fromEnd = toward[plane] > 0;
    }

    /// How far, along row or column, rays have gone from their own places where they cross plane k.
    float shift(std::size_t axis, int k) const { return slope[axis] * (float(k) + 0.5F - 0.5F * float(count.z)); }
};

/// One row of rays on its way through all planes.
class RayRow {
public:
    RayRow(const OpacityGrid& grid, const Planes& planes, Index3 size)
        : grid_(grid),
          planes_(planes),
          size_(size),
          light_(std::size_t(size.x + kVector)),
          alpha_(std::size_t(size.x + 2 * kVector)),
          low_(std::size_t(planes.count.x)),
          high_(std::size_t(planes.count.x)) {}

    void follow(int r, std::vector<std::uint16_t>& left) {
        std::fill(light_.begin(), light_.end(), 1.0F);
        int before = 0, offsetBefore = 0;
        for (int n = 0; n < size_.z; ++n) {
            const int k = planes_.fromEnd ? size_.z - 1 - n : n;
            const float along = planes_.shift(0, k), across = planes_.shift(1, k);
            const int offset = int(std::floor(along)), down = int(std::floor(across));
            const int column = remainder(r + down + ShadowVolume::kMargin, size_.y) - ShadowVolume::kMargin;
            // Rays that come in on one side are others than those that have left on the other.
            if (n > 0 && std::abs(column - before) > size_.y / 2) std::fill(light_.begin(), light_.end(), 1.0F);
            const int first = remainder(-ShadowVolume::kMargin - offset, size_.x);
            if (n > 0 && offset > offsetBefore) light_[std::size_t(first)] = 1;
            if (n > 0 && offset < offsetBefore) light_[std::size_t(remainder(first - 1, size_.x))] = 1;
            before = column;
            offsetBefore = offset;
            readAlphas(k, column, across - float(down));
            std::uint16_t* to = &left[std::size_t(size_.x) * (std::size_t(r) + std::size_t(size_.y) * std::size_t(k))];
            pass(std::size_t(first), along - float(offset), to);
        }
    }

private:
    /// alpha_[m] between rows `column` and the next, of cell m − kMargin.
    void readAlphas(int k, int column, float fraction) {
        std::fill(alpha_.begin(), alpha_.end(), 0.0F);
        const auto inside = [&](int c) { return c >= 0 && c < planes_.count.y; };
        if (!inside(column) && !inside(column + 1)) return;
        const std::uint16_t* low = rowOf(k, inside(column) ? column : column + 1, low_);
        const std::uint16_t* high = inside(column + 1) && inside(column) ? rowOf(k, column + 1, high_) : low;
        // Beyond the grid there is nothing, and the outermost cells are clear.
        HWY_DYNAMIC_DISPATCH(mixRows)
        (low, high, fraction, low_.size(), alpha_.data() + ShadowVolume::kMargin);
    }

    const std::uint16_t* rowOf(int k, int column, std::vector<std::uint16_t>& copy) const {
        const std::uint16_t* from =
            grid_.level(0).alpha.data() + planes_.stride[1] * std::size_t(column) + planes_.stride[2] * std::size_t(k);
        if (planes_.stride[0] == 1) return from;
        for (std::size_t n = 0; n < copy.size(); ++n) copy[n] = from[n * planes_.stride[0]];
        return copy.data();
    }

    /// Ray `first` crosses the plane at cell −kMargin, the following ones beside it, the last followed by ray 0.
    void pass(std::size_t first, float fraction, std::uint16_t* to) {
        const std::size_t count = std::size_t(size_.x) - first;
        HWY_DYNAMIC_DISPATCH(passPlane)(alpha_.data(), fraction, planes_.beyond, count, &light_[first], to + first);
        if (first == 0) return;
        // Vectors reach beyond the last ray, into those that have passed already.
        std::array<float, kVector> passed{};
        std::copy_n(&light_[first], kVector, passed.begin());
        HWY_DYNAMIC_DISPATCH(passPlane)
        (alpha_.data() + count, fraction, planes_.beyond, first, light_.data(), to);
        std::copy_n(passed.begin(), kVector, &light_[first]);
    }

    const OpacityGrid& grid_;
    const Planes& planes_;
    Index3 size_;
    std::vector<float> light_, alpha_;
    std::vector<std::uint16_t> low_, high_;
};

}  // namespace

ShadowVolume::ShadowVolume(const OpacityGrid& grid, const Vec3f& toward) {
    assert(toward != Vec3f(0));
    const Planes planes(grid, toward);
    size_ = planes.count + Index3(2 * kMargin, 2 * kMargin, 0);
    raysFromGrid_ = Mat4f(0);
    for (int n = 0; n < 2; ++n) {
        const float slope = planes.slope[std::size_t(n)];
        raysFromGrid_[n == 0 ? planes.row : planes.column][n] = 1;
        raysFromGrid_[planes.plane][n] = -slope;
        raysFromGrid_[3][n] = slope * 0.5F * float(planes.count.z);
    }
    raysFromGrid_[planes.plane][2] = 1;
    raysFromGrid_[3][3] = 1;
    left_.resize(std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(size_.z));
    parallelFor(std::size_t(size_.y), 4, [&](std::size_t begin, std::size_t end) {
        RayRow row(grid, planes, size_);
        for (std::size_t r = begin; r < end; ++r) row.follow(int(r), left_);
    });
}

float ShadowVolume::at(const Vec3f& at) const {
    const Vec3f p = Vec3f(raysFromGrid_ * Vec4f(at, 1)) - 0.5F;
    const float z = std::clamp(p.z, 0.0F, float(size_.z - 1));
    const auto i = int(std::floor(p.x)), j = int(std::floor(p.y)), k = std::max(std::min(int(z), size_.z - 2), 0);
    const float f = p.x - float(i), g = p.y - float(j), h = z - float(k);
    const std::array<std::size_t, 2> x{std::size_t(remainder(i, size_.x)), std::size_t(remainder(i + 1, size_.x))},
        y{std::size_t(remainder(j, size_.y)), std::size_t(remainder(j + 1, size_.y))};
    const auto plane = [&](int n) {
        const std::uint16_t* from = &left_[std::size_t(size_.x) * std::size_t(size_.y) * std::size_t(n)];
        const auto line = [&](std::size_t m) {
            const std::uint16_t* row = from + std::size_t(size_.x) * m;
            return float(row[x[0]]) + f * (float(row[x[1]]) - float(row[x[0]]));
        };
        const float low = line(y[0]);
        return low + g * (line(y[1]) - low);
    };
    const float low = plane(k);
    return (low + h * (plane(std::min(k + 1, size_.z - 1)) - low)) * (1 / 65535.0F);
}

}  // namespace voledit
#endif
