#pragma once
// What a term finds out about itself on first use.

#include <memory>
#include <mutex>

#include "core/objects/empty_space.h"

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

private:
    mutable std::once_flag bricksOnce_, spaceOnce_;
    mutable std::unique_ptr<const VisibleBricks> bricks_;
    mutable std::unique_ptr<const EmptySpace> space_;
};

}  // namespace voledit
