#include "core/fields/volume.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <mutex>

#include "core/fields/statistics.h"
#include "core/fields/value_bricks.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

constexpr double kInsideTolerance = 1e-3;  // voxels; the contract's

constexpr std::array<std::string_view, 8> kTypeNames{"int8",  "uint8",  "int16", "uint16",
                                                     "int32", "uint32", "float", "double"};

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
    static double mix(double a, double b, double t) { return t == 0 ? a : a + t * (b - a); }

    const T* values_;
    Index3 size_;
    std::array<std::ptrdiff_t, 3> stride_;
};

/// Bound on the rounding error of indexFromWorld · p for p in the domain, a few units in the last place of the largest
/// intermediate number.
Vec3 roundingOf(const VolumeGrid& grid, const Mat4& indexFromWorld) {
    const Box3 world = boundsOf(grid.worldFrame());
    Vec3 bound;
    for (int row = 0; row < 3; ++row) {
        double largest = std::abs(indexFromWorld[3][row]);
        for (int column = 0; column < 3; ++column)
            largest += std::abs(indexFromWorld[column][row]) *
                       std::max(std::abs(world.min[column]), std::abs(world.max[column]));
        bound[row] = 16 * std::numeric_limits<double>::epsilon() * largest;
    }
    return bound;
}

}  // namespace

std::size_t byteSize(VoxelType type) {
    return withVoxelType(type, [](auto t) { return sizeof(t); });
}

std::string_view nameOf(VoxelType type) {
    return kTypeNames[std::size_t(type)];
}

std::optional<VoxelType> voxelTypeOf(std::string_view name) {
    const auto found = std::find(kTypeNames.begin(), kTypeNames.end(), name);
    if (found == kTypeNames.end()) return std::nullopt;
    return VoxelType(found - kTypeNames.begin());
}

std::pair<double, double> rangeOf(VoxelType type) {
    return withVoxelType(type, [](auto t) -> std::pair<double, double> {
        using T = decltype(t);
        if constexpr (std::is_floating_point_v<T>) return {-kInfinity, kInfinity};
        return {double(std::numeric_limits<T>::lowest()), double(std::numeric_limits<T>::max())};
    });
}

Vec3 VolumeGrid::spacing() const {
    return {glm::length(Vec3(worldFromIndex[0])), glm::length(Vec3(worldFromIndex[1])),
            glm::length(Vec3(worldFromIndex[2]))};
}

Mat3 VolumeGrid::direction() const {
    Mat3 result(worldFromIndex);
    for (int a = 0; a < 3; ++a) result[a] = glm::normalize(result[a]);
    return result;
}

Box3 VolumeGrid::indexDomain() const {
    Box3 box{Vec3(0), Vec3(size - 1)};
    for (int a = 0; a < 3; ++a)
        if (size[a] == 1) {
            box.min[a] = -0.5;
            box.max[a] = 0.5;
        }
    return box;
}

Frame VolumeGrid::worldFrame() const {
    const Box3 box = indexDomain();
    const Vec3 extent = box.size();
    Frame frame;
    frame.corner = transformPoint(worldFromIndex, box.min);
    for (int a = 0; a < 3; ++a) frame.edge[std::size_t(a)] = extent[a] * Vec3(worldFromIndex[a]);
    return frame;
}

struct Volume::Lazy {
    explicit Lazy(std::size_t channels) : once(channels), bricks(channels) {}
    std::vector<std::once_flag> once;
    std::vector<ValueBricks> bricks;
};

Volume::Volume(VolumeGrid grid, VoxelType type, std::span<const std::byte> voxels, std::shared_ptr<const void> owner,
               VolumeStatistics statistics)
    : grid_(grid),
      type_(type),
      voxels_(voxels),
      owner_(std::move(owner)),
      statistics_(std::move(statistics)),
      indexFromWorld_(glm::inverse(grid.worldFromIndex)),
      lazy_(std::make_shared<Lazy>(std::size_t(grid.channels))),
      rounding_(roundingOf(grid, indexFromWorld_)) {
    assert(grid.size.x > 0 && grid.size.y > 0 && grid.size.z > 0 && grid.channels > 0);
    assert(voxels.size() == grid.valueCount() * byteSize(type));
}

template <class T>
std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid& grid, std::vector<T> values) {
    assert(values.size() == grid.valueCount());
    const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
    const auto voxels = std::as_bytes(std::span(*owner));
    return std::make_shared<const Volume>(grid, voxelTypeFor<T>(), voxels, owner,
                                          statisticsOf(voxelTypeFor<T>(), voxels, grid.channels));
}

template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<std::int8_t>);
template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<std::uint8_t>);
template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<std::int16_t>);
template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<std::uint16_t>);
template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<std::int32_t>);
template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<std::uint32_t>);
template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<float>);
template std::shared_ptr<const Volume> Volume::fromValues(const VolumeGrid&, std::vector<double>);

const ValueBricks& Volume::bricks(int channel) const {
    assert(channel >= 0 && channel < grid_.channels);
    const auto c = std::size_t(channel);
    std::call_once(lazy_->once[c], [&] { lazy_->bricks[c] = makeValueBricks(*this, channel); });
    return lazy_->bricks[c];
}

double Volume::at(Index3 index, int channel) const {
    assert(index.x >= 0 && index.y >= 0 && index.z >= 0 && index.x < grid_.size.x && index.y < grid_.size.y &&
           index.z < grid_.size.z && channel >= 0 && channel < grid_.channels);
    const std::size_t sample =
        std::size_t(index.x) +
        std::size_t(grid_.size.x) * (std::size_t(index.y) + std::size_t(grid_.size.y) * std::size_t(index.z));
    const std::size_t value = sample * std::size_t(grid_.channels) + std::size_t(channel);
    return withVoxelType(type_,
                         [&](auto t) { return double(reinterpret_cast<const decltype(t)*>(voxels_.data())[value]); });
}

void Volume::sample(std::span<const Vec3> p, std::span<double> value, int channel) const {
    assert(p.size() == value.size() && channel >= 0 && channel < grid_.channels);
    const Locator locate(grid_, indexFromWorld_, rounding_);
    withVoxelType(type_, [&](auto t) {
        const GridView<decltype(t)> grid(grid_, voxels_, channel);
        Vec3 x;
        for (std::size_t n = 0; n < p.size(); ++n) value[n] = locate(p[n], x) ? grid(x) : kNaN;
    });
}

void Volume::gradient(std::span<const Vec3> p, std::span<Vec3> gradient, int channel) const {
    assert(p.size() == gradient.size() && channel >= 0 && channel < grid_.channels);
    const Locator locate(grid_, indexFromWorld_, rounding_);
    const Mat3 worldFromDifferences = glm::transpose(Mat3(indexFromWorld_));
    withVoxelType(type_, [&](auto t) {
        const GridView<decltype(t)> grid(grid_, voxels_, channel);
        Vec3 x;
        for (std::size_t n = 0; n < p.size(); ++n)
            gradient[n] = locate(p[n], x) ? worldFromDifferences * grid.differences(x) : Vec3(0);
    });
}

}  // namespace voledit
