#include "core/fields/volume.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <mutex>

#include "core/fields/grid_view.h"
#include "core/fields/statistics.h"
#include "core/fields/value_bricks.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

constexpr std::array<std::string_view, 8> kTypeNames{"int8",  "uint8",  "int16", "uint16",
                                                     "int32", "uint32", "float", "double"};

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

void Volume::sample(std::span<const Vec3> p, std::span<double> value, int channel, Interpolation interpolation) const {
    assert(p.size() == value.size() && channel >= 0 && channel < grid_.channels);
    const Locator locate(grid_, indexFromWorld_, rounding_);
    withVoxelType(type_, [&](auto t) {
        const GridView<decltype(t)> grid(grid_, voxels_, channel);
        const auto fill = [&](const auto& valueAt) {
            Vec3 x;
            for (std::size_t n = 0; n < p.size(); ++n) value[n] = locate(p[n], x) ? valueAt(x) : kNaN;
        };
        if (interpolation == Interpolation::Linear)
            fill(grid);
        else if (interpolation == Interpolation::Nearest)
            fill([&](const Vec3& x) { return grid.nearest(x); });
        else
            fill([&](const Vec3& x) { return grid.cubic(x); });
    });
}

void Volume::gradient(std::span<const Vec3> p, std::span<Vec3> gradient, int channel,
                      Interpolation interpolation) const {
    assert(p.size() == gradient.size() && channel >= 0 && channel < grid_.channels);
    const Locator locate(grid_, indexFromWorld_, rounding_);
    const Mat3 worldFromDifferences = glm::transpose(Mat3(indexFromWorld_));
    withVoxelType(type_, [&](auto t) {
        const GridView<decltype(t)> grid(grid_, voxels_, channel);
        const auto fill = [&](const auto& gradientAt) {
            Vec3 x;
            for (std::size_t n = 0; n < p.size(); ++n)
                gradient[n] = locate(p[n], x) ? worldFromDifferences * gradientAt(x) : Vec3(0);
        };
        if (interpolation == Interpolation::Cubic)
            fill([&](const Vec3& x) { return grid.cubicGradient(x); });
        else
            fill([&](const Vec3& x) { return grid.differences(x); });
    });
}

}  // namespace voledit
