#pragma once
// How actors are drawn over the picture: bones, joints, the rings of the selected one, regions, voxels not covered.

#include <optional>
#include <vector>

#include "app/editor/actor_state.h"
#include "app/editor/tools/actor_view.h"
#include "render/overlay.h"

namespace voledit {

struct ActorLook {
    std::vector<int> selected;       // joints, the leading one last
    std::optional<int> hovered;      // joint
    std::optional<int> hoveredBone;  // limb
    bool active = true;              // false: another node is selected, and the actor is drawn fainter
    bool regions = false, rest = false, coverage = false;
    Camera camera{};
    Index2 size{1, 1};
    double scale = 1;  // of the interface
};

/// Appends bones (tapered octahedra, as wide as a tenth of their length), lines from joints to those below them that
/// no limb joins, and joints; the regions of selected joints' limbs (with `regions` of all).
void appendActor(const CompiledActor& actor, const ActorLook& look, Overlay& overlay);

/// Voxels of `body` in no region (red) and in several (yellow), where the object is at rest; where there are very many,
/// every n-th.
void appendCoverage(const CompiledActor& actor, const ActorBody& body, const Coverage& coverage, double scale,
                    Overlay& overlay);

/// A ring about a joint that turns it: about its own x, y, z (0, 1, 2) or the view (3).
struct RingHit {
    int axis = 0;
    bool operator==(const RingHit&) const = default;
};
/// Appends the rings about `joint`, as large on the screen wherever it is; the one of `marked` strong, the others as
/// they lie before or behind the joint.
void appendRings(const CompiledActor& actor, int joint, const std::optional<RingHit>& marked, const ActorLook& look,
                 Overlay& overlay);
/// The ring about `joint` that pixel `at` lies on, within `radius` pixels: own axes before the view's.
std::optional<RingHit> ringAt(const CompiledActor& actor, int joint, const ActorLook& look, const Vec2& at,
                              double radius);

}  // namespace voledit
