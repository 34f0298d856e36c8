#pragma once
// A term's opacity on a regular grid: what light meets on its way, without evaluating the term again and again.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/objects/term.h"

namespace voledit {

/// Alphas of one spacing of a term's material at the centres of cubic cells, over the term's bounds and at least one
/// empty cell more on every side; means of 2³, 4³ … cells on further levels; and how far around each brick of cells all
/// is clear. Immutable. "Grid" is the space in which cell (i, j, k) is [i, i + 1] × [j, j + 1] × [k, k + 1]: lengths in
/// spacings.
class OpacityGrid {
public:
    static constexpr int kLevels = 4;  // sizes are multiples of 2³
    static constexpr int kBrick = 4;   // cells along a brick's side
    static constexpr std::size_t kMostCells = std::size_t(1) << 23;
    static constexpr int kFarthest = 32;  // clearances are cut to this

    struct Level {
        Index3 size{0};
        std::vector<std::uint16_t> alpha;  // alpha · 65535, x fastest
    };

    /// Samples `term` every `spacing` (world units, > 0; farther where that would be more than kMostCells). In
    /// parallel.
    OpacityGrid(const Term& term, double spacing, double opacityDistance);

    double spacing() const { return spacing_; }  // world units
    Index3 size() const { return levels_.front().size; }
    /// Grid coordinates of a world point.
    Vec3f gridFromWorld(const Vec3& p) const { return Vec3f((p - origin_) / spacing_); }
    const Vec3& origin() const { return origin_; }  // world point of grid (0, 0, 0)

    /// Alpha of one spacing at a point of the grid, linear between the centres of the level's cells; held beyond.
    float alpha(const Vec3f& at, int level = 0) const;

    /// Bricks: 0 where linear interpolation within may give an alpha above 0; else n: so are not the bricks up to n − 1
    /// away, on any axis.
    const std::vector<std::uint8_t>& clearance() const { return clearance_; }
    Index3 brickCount() const { return bricks_; }
    std::uint8_t clearanceOf(const Index3& brick) const {
        return clearance_[std::size_t(brick.x) +
                          std::size_t(bricks_.x) *
                              (std::size_t(brick.y) + std::size_t(bricks_.y) * std::size_t(brick.z))];
    }
    const Level& level(int n) const { return levels_[std::size_t(n)]; }

private:
    void sampleTerm(const Term& term, double opacityDistance);
    void addLevels();
    void measureClearance();

    double spacing_;
    Vec3 origin_{0};
    std::vector<Level> levels_;
    Index3 bricks_{0};
    std::vector<std::uint8_t> clearance_;
};

/// The term's grid, of this spacing or finer, made on first use and kept with it until a finer one is asked for, or one
/// for another distance. Safe from many threads.
std::shared_ptr<const OpacityGrid> opacityGridOf(const Term& term, double spacing, double opacityDistance);

}  // namespace voledit
