#pragma once
// Handles on the faces of a limb's box, by which it is pulled larger or smaller while the rig is edited.

#include <optional>

#include "app/editor/tools/actor_view.h"
#include "core/scene/scene_actors.h"
#include "render/overlay.h"

namespace voledit {

/// A face of the box about a limb at rest.
struct RegionHandle {
    int limb = 0;
    int face = 0;  // 0, 1: the sides at −x, +x of the bone frame; 2, 3: at −y, +y; 4, 5: the start and the end
    bool operator==(const RegionHandle&) const = default;
};

/// Where it stands, the middle of its face (world units), and which way is out: the world length of one unit there.
struct HandlePlace {
    Vec3 at{0}, out{0};
};
HandlePlace placeOf(const CompiledActor& actor, const RegionHandle& handle);

/// Of the handles of `limbs` the one nearest to pixel `at`, no further than `radius` pixels.
std::optional<RegionHandle> handleAt(const CompiledActor& actor, const std::vector<int>& limbs, const Camera& camera,
                                     Index2 size, const Vec2& at, double radius);

/// How far the face goes out when the pointer moves by `pixels`, in units of the object: what the foot of the pointer
/// on the line through the face, as it is seen, says.
double pulledBy(const HandlePlace& place, const Camera& camera, Index2 size, const Vec2& pixels);

/// Moves the face of `limb` (as it was when the pull began) out by `distance`; the opposite one stays. Ends move by
/// their pad. A box keeps a thousandth of its width.
void pull(SceneLimb& changed, const Limb& limb, int face, double distance);

/// Appends the handles of `limbs`, `marked` strong.
void appendHandles(const CompiledActor& actor, const std::vector<int>& limbs, const std::optional<RegionHandle>& marked,
                   double scale, Overlay& overlay);

}  // namespace voledit
