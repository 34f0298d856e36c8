#pragma once
// What is found out about the actor whose rig is edited, in the background: its opaque voxels, their distances to the
// surface, and how its regions cover them.

#include <vector>

#include "app/editor/background.h"
#include "app/editor/workspace.h"

namespace voledit {

/// A voxel is opaque from this opacity on, for rigging.
inline constexpr double kOpaque = 0.05;

/// The opaque voxels of `of` and their distances. Throws Error, Cancelled.
std::shared_ptr<const ActorBody> bodyOf(const TermPtr& of, Progress* progress);

class ActorAnalysis {
public:
    /// Once a frame: takes over what is ready, and starts what is missing or out of date, for the active actor while
    /// its rig is edited. What does not belong to it any more is dropped. With `wait` (headless) nothing is left
    /// undone. Problems become notices.
    void update(Workspace& workspace, bool wait);
    bool running() const { return work_.running(); }

private:
    bool startWhatIsMissing(Workspace& workspace);

    Background work_;
    // What the coverage was counted for.
    std::vector<Limb> limbs_;
    std::vector<Vec3> rest_;
    RegionOptions options_;
    std::shared_ptr<const ActorBody> of_;
    std::shared_ptr<const Term> failed_;  // of this nothing can be found out
};

}  // namespace voledit
