#pragma once
// What a term finds out about itself on first use.

#include <memory>
#include <mutex>
#include <utility>

#include "core/objects/empty_space.h"
#include "core/objects/opacity_grid.h"
#include "core/objects/openness.h"
#include "core/objects/shadow_volume.h"

namespace voledit {

/// The last thing made for one key after another. Safe from many threads.
template <class Made, class Key>
class LastMade {
public:
    template <class Make>
    std::shared_ptr<const Made> get(const Key& key, const Make& make) {
        return get(key, make, [&](const Key& known) { return known == key; });
    }
    /// The last one, if its key suits(key); else one for `key`.
    template <class Make, class Suits>
    std::shared_ptr<const Made> get(const Key& key, const Make& make, const Suits& suits) {
        const std::lock_guard lock(lock_);
        if (!made_ || !suits(key_)) {
            made_ = make();
            key_ = key;
        }
        return made_;
    }

private:
    std::mutex lock_;
    std::shared_ptr<const Made> made_;
    Key key_{};
};

/// Kept with each term, so that it lives as long and is found again wherever the term is shared. Safe from many
/// threads.
class TermCache {
public:
    const VisibleBricks& visibleBricks(const VolumeTerm& volume) const {
        std::call_once(bricksOnce_, [&] { bricks_ = std::make_unique<const VisibleBricks>(volume); });
        return *bricks_;
    }
    const EmptySpace& emptySpace(const Term& term) const {
        std::call_once(spaceOnce_, [&] { space_ = std::make_unique<const EmptySpace>(term); });
        return *space_;
    }
    /// A finer one will do: pictures in longer steps, while something moves, make none anew.
    std::shared_ptr<const OpacityGrid> opacityGrid(const Term& term, double spacing, double opacityDistance) const {
        return grid_.get(
            {spacing, opacityDistance},
            [&] { return std::make_shared<const OpacityGrid>(term, spacing, opacityDistance); },
            [&](const auto& known) { return known.first <= spacing && known.second == opacityDistance; });
    }
    /// Of a grid of this term's.
    std::shared_ptr<const Openness> openness(const std::shared_ptr<const OpacityGrid>& grid, float radius) const {
        return openness_.get({grid, radius}, [&] { return std::make_shared<const Openness>(*grid, radius); });
    }
    std::shared_ptr<const ShadowVolume> shadows(const std::shared_ptr<const OpacityGrid>& grid,
                                                const Vec3f& toward) const {
        return shadows_.get({grid, toward}, [&] { return std::make_shared<const ShadowVolume>(*grid, toward); });
    }

private:
    using GridPtr = std::shared_ptr<const OpacityGrid>;

    mutable std::once_flag bricksOnce_, spaceOnce_;
    mutable std::unique_ptr<const VisibleBricks> bricks_;
    mutable std::unique_ptr<const EmptySpace> space_;
    mutable LastMade<OpacityGrid, std::pair<double, double>> grid_;
    mutable LastMade<Openness, std::pair<GridPtr, float>> openness_;
    mutable LastMade<ShadowVolume, std::pair<GridPtr, Vec3f>> shadows_;
};

}  // namespace voledit
