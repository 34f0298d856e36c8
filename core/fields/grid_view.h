#pragma once
// Values between the samples of a grid, in index space: what Volume::sample and Volume::gradient loop over.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/fields/volume.h"

namespace voledit {

/// How far outside its domain a volume still gives its border's value, voxels; the contract's.
inline constexpr double kInsideTolerance = 1e-3;

/// Index-space position of world points, decided and clamped once for all uses.
class Locator {
public:
    Locator(const VolumeGrid& grid, const Mat4& indexFromWorld, const Vec3& rounding)
        : indexFromWorld_(indexFromWorld), rounding_(rounding), last_(Vec3(grid.size - 1)) {
        const Box3 domain = grid.indexDomain();
        low_ = domain.min - kInsideTolerance - rounding;
        high_ = domain.max + kInsideTolerance + rounding;
    }

    /// x = p's position in index space, clamped to the samples; false outside the domain.
    bool operator()(const Vec3& p, Vec3& x) const {
        x = transformPoint(indexFromWorld_, p);
        if (!(x.x >= low_.x && x.y >= low_.y && x.z >= low_.z && x.x <= high_.x && x.y <= high_.y && x.z <= high_.z))
            return false;
        for (int a = 0; a < 3; ++a) {
            // A sample's own position must give its own value, though its index comes out a rounding error off.
            const double whole = double(int(x[a] + 0.5));
            if (std::abs(x[a] - whole) <= rounding_[a]) x[a] = whole;
            x[a] = std::min(std::max(x[a], 0.0), last_[a]);
        }
        return true;
    }

private:
    Mat4 indexFromWorld_;
    Vec3 rounding_, last_, low_, high_;
};

template <class T>
class GridView {
public:
    GridView(const VolumeGrid& grid, std::span<const std::byte> voxels, int channel)
        : values_(reinterpret_cast<const T*>(voxels.data()) + channel), size_(grid.size) {
        stride_[0] = grid.channels;
        stride_[1] = stride_[0] * grid.size.x;
        stride_[2] = stride_[1] * grid.size.y;
    }

    /// Trilinear value at x in [0, n−1]. Neighbours of weight 0 are not read, so that neither memory beyond the grid
    /// nor a NaN beside the point matters.
    double operator()(const Vec3& x) const {
        const std::ptrdiff_t i = int(x.x), j = int(x.y), k = int(x.z);
        const double u = x.x - double(i), v = x.y - double(j), w = x.z - double(k);
        const T* corner = values_ + i * stride_[0] + j * stride_[1] + k * stride_[2];
        const std::ptrdiff_t di = u > 0 ? stride_[0] : 0;
        const std::ptrdiff_t dj = v > 0 ? stride_[1] : 0;
        const std::ptrdiff_t dk = w > 0 ? stride_[2] : 0;
        const auto row = [&](const T* start) { return mix(double(start[0]), double(start[di]), u); };
        const double low = mix(row(corner), row(corner + dj), v);
        if (dk == 0) return low;
        return mix(low, mix(row(corner + dk), row(corner + dk + dj), v), w);
    }

    /// Value of the sample nearest to x in [0, n−1]; halfway, that of the larger index.
    double nearest(const Vec3& x) const {
        return double(values_[std::ptrdiff_t(x.x + 0.5) * stride_[0] + std::ptrdiff_t(x.y + 0.5) * stride_[1] +
                              std::ptrdiff_t(x.z + 0.5) * stride_[2]]);
    }

    /// The samples' values as coefficients of a uniform tricubic B-spline, at x in [0, n−1].
    double cubic(const Vec3& x) const {
        return convolved(Spline(x.x, size_.x), Spline(x.y, size_.y), Spline(x.z, size_.z), {false, false, false});
    }

    /// Gradient of that spline in index space.
    Vec3 cubicGradient(const Vec3& x) const {
        const Spline i(x.x, size_.x), j(x.y, size_.y), k(x.z, size_.z);
        return {convolved(i, j, k, {true, false, false}), convolved(i, j, k, {false, true, false}),
                convolved(i, j, k, {false, false, true})};
    }

    /// Differences of one voxel along the index axes, as volume.h defines them.
    Vec3 differences(const Vec3& x) const {
        Vec3 g(0);
        for (int a = 0; a < 3; ++a) {
            if (size_[a] == 1) continue;
            Vec3 ahead = x, behind = x;
            ahead[a] = std::min(x[a] + 1.0, double(size_[a] - 1));
            behind[a] = std::max(x[a] - 1.0, 0.0);
            g[a] = ((*this)(ahead) - (*this)(behind)) / (ahead[a] - behind[a]);
        }
        return g;
    }

private:
    /// One axis of the cubic B-spline at x: four samples, their weights and the weights' derivatives. Samples beyond
    /// the ends repeat the last one.
    struct Spline {
        Spline(double x, int size) {
            const int below = std::min(int(x), size - 1);
            const double f = x - below, g = 1 - f;
            weight = {g * g * g / 6, (4 - 3 * f * f * (2 - f)) / 6, (4 - 3 * g * g * (2 - g)) / 6, f * f * f / 6};
            if (size > 1) slope = {-g * g / 2, f * (3 * f - 4) / 2, g * (4 - 3 * g) / 2, f * f / 2};
            for (int n = 0; n < 4; ++n) sample[std::size_t(n)] = std::clamp(below - 1 + n, 0, size - 1);
        }
        std::array<double, 4> weight, slope{};
        std::array<std::ptrdiff_t, 4> sample;
    };

    double convolved(const Spline& i, const Spline& j, const Spline& k, std::array<bool, 3> differentiated) const {
        const auto& u = differentiated[0] ? i.slope : i.weight;
        const auto& v = differentiated[1] ? j.slope : j.weight;
        const auto& w = differentiated[2] ? k.slope : k.weight;
        double sum = 0;
        // Samples of weight 0 are not read: a NaN there does not matter.
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t b = 0; b < 4 && w[c] != 0; ++b) {
                const T* row = values_ + k.sample[c] * stride_[2] + j.sample[b] * stride_[1];
                for (std::size_t a = 0; a < 4 && v[b] != 0; ++a)
                    if (u[a] != 0) sum += w[c] * v[b] * u[a] * double(row[i.sample[a] * stride_[0]]);
            }
        return sum;
    }

    static double mix(double a, double b, double t) { return t == 0 ? a : a + t * (b - a); }

    const T* values_;
    Index3 size_;
    std::array<std::ptrdiff_t, 3> stride_;
};

}  // namespace voledit
