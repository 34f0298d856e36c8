#pragma once
// A regular grid of samples in physical space, in the file's own number type.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/box3.h"
#include "core/base/types.h"

namespace voledit {

enum class VoxelType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

/// Bytes of one value: 1, 2, 4 or 8.
std::size_t byteSize(VoxelType type);
/// The contract's name: "int8" … "uint32", "float", "double".
std::string_view nameOf(VoxelType type);
/// Inverse of `nameOf`; nullopt for another word.
std::optional<VoxelType> voxelTypeOf(std::string_view name);
/// Smallest and largest value that `type` holds (±infinity for the two real types).
std::pair<double, double> rangeOf(VoxelType type);

/// How values between the samples of a regular grid follow from them.
enum class Interpolation : std::uint8_t { Linear, Nearest, Cubic };

/// Where the samples of a regular grid lie. Samples stand at whole indices; the grid's domain is the box of its sample
/// positions, first to last, an axis of one sample being one spacing thick (centred on it) (scene-format.md).
struct VolumeGrid {
    Index3 size{1, 1, 1};      // samples along i, j, k; each ≥ 1
    int channels = 1;          // values a sample, interleaved
    Mat4 worldFromIndex{1.0};  // affine: index (i, j, k) to physical LPS millimetres; shear is kept

    bool operator==(const VolumeGrid&) const = default;

    std::size_t sampleCount() const { return std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z); }
    std::size_t valueCount() const { return sampleCount() * std::size_t(channels); }
    /// Lengths of the three axes' steps, world units.
    Vec3 spacing() const;
    /// Unit vectors of the three axes, as columns.
    Mat3 direction() const;
    /// World position of sample (0, 0, 0).
    Vec3 origin() const { return Vec3(worldFromIndex[3]); }
    /// The domain as a box in index space: [0, n−1] on each axis, [−½, ½] on an axis of one sample.
    Box3 indexDomain() const;
    /// The domain as an (oriented) world frame.
    Frame worldFrame() const;
};

/// What the reader found while it went through the voxels; over finite values of channel 0.
struct VolumeStatistics {
    double min = 0, max = 0, mean = 0;
    /// Counts of 256 equal bins from min to max (the last bin holds max).
    std::vector<std::uint64_t> histogram;
};

struct ValueBricks;

/// An immutable grid of samples. Voxels are owned by whatever `owner` is (heap, or memory that another process
/// filled), i fastest, channels interleaved, in the machine's byte order. Rescale slope and intercept are applied
/// already. Nothing is resampled, ever.
class Volume {
public:
    /// `voxels` must hold grid.valueCount() values of `type` and live as long as `owner`.
    Volume(VolumeGrid grid, VoxelType type, std::span<const std::byte> voxels, std::shared_ptr<const void> owner,
           VolumeStatistics statistics);

    /// Copies `values` (any arithmetic type that VoxelType names; grid.valueCount() of them) and counts statistics.
    template <class T>
    static std::shared_ptr<const Volume> fromValues(const VolumeGrid& grid, std::vector<T> values);

    const VolumeGrid& grid() const { return grid_; }
    VoxelType type() const { return type_; }
    std::span<const std::byte> voxels() const { return voxels_; }
    const VolumeStatistics& statistics() const { return statistics_; }
    const Mat4& indexFromWorld() const { return indexFromWorld_; }

    /// Ranges of the values in small bricks (value_bricks.h), made on first use. Safe from many threads.
    const ValueBricks& bricks(int channel) const;

    /// Stored value at a whole index (must be inside the grid).
    double at(Index3 index, int channel = 0) const;

    /// value[n] = value of `channel` at world point p[n]; NaN outside the domain (a point within 0.001 voxel of it
    /// counts as inside and is clamped) and where p is undefined. Sizes must be equal. Runs in the calling thread.
    /// Linear: trilinear; at a sample's position the stored value to the bit. Nearest: the stored value of the nearest
    /// sample. Cubic: the samples as coefficients of a uniform tricubic B-spline (repeated beyond the ends), which is
    /// smooth to the second derivative and smooths noise; it does not pass through the samples.
    void sample(std::span<const Vec3> p, std::span<double> value, int channel = 0,
                Interpolation interpolation = Interpolation::Linear) const;

    /// gradient[n] = gradient in world units⁻¹; 0 outside. Cubic: the B-spline's own. Linear and nearest: of the
    /// trilinear field T, by central differences of one voxel, which is what the slices use too: with
    /// x = indexFromWorld · p clamped to [0, n−1], the axes a of index space each give, with b = min(xₐ + 1, nₐ − 1)
    /// and c = max(xₐ − 1, 0) and the other coordinates of x as they are,
    ///   gₐ = (T(xₐ := b) − T(xₐ := c)) / (b − c), or 0 where nₐ = 1,
    /// so differences become one-sided towards the domain's faces; the result is (indexFromWorld's linear part)ᵀ · g.
    /// Sizes must be equal. Runs in the calling thread.
    void gradient(std::span<const Vec3> p, std::span<Vec3> gradient, int channel = 0,
                  Interpolation interpolation = Interpolation::Linear) const;

private:
    struct Lazy;
    VolumeGrid grid_;
    VoxelType type_;
    std::span<const std::byte> voxels_;
    std::shared_ptr<const void> owner_;
    VolumeStatistics statistics_;
    Mat4 indexFromWorld_;
    std::shared_ptr<Lazy> lazy_;
    Vec3 rounding_;  // bound on the rounding error of an index computed from a world position, voxels
};

}  // namespace voledit
