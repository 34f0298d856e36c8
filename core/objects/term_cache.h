#pragma once
// What a term finds out about itself on first use.

#include <memory>
#include <mutex>
#include <utility>

#include "core/objects/empty_space.h"
#include "core/objects/opacity_grid.h"

namespace voledit {

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
    /// The last one that was asked for is kept.
    std::shared_ptr<const OpacityGrid> opacityGrid(const Term& term, double spacing, double opacityDistance) const {
        const std::lock_guard lock(gridLock_);
        if (!grid_ || gridFor_ != std::pair(spacing, opacityDistance)) {
            grid_ = std::make_shared<const OpacityGrid>(term, spacing, opacityDistance);
            gridFor_ = {spacing, opacityDistance};
        }
        return grid_;
    }

private:
    mutable std::once_flag bricksOnce_, spaceOnce_;
    mutable std::unique_ptr<const VisibleBricks> bricks_;
    mutable std::unique_ptr<const EmptySpace> space_;
    mutable std::mutex gridLock_;
    mutable std::shared_ptr<const OpacityGrid> grid_;
    mutable std::pair<double, double> gridFor_;
};

}  // namespace voledit
