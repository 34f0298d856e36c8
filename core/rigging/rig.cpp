#include "core/rigging/rig.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/rigging/biped.h"
#include "core/rigging/body_frame.h"
#include "core/rigging/body_shape.h"
#include "core/rigging/limb_boxes.h"

namespace voledit {

namespace {

constexpr std::pair<RigTemplate, const char*> kNames[] = {
    {RigTemplate::Biped, "biped"}, {RigTemplate::Quadruped, "quadruped"}, {RigTemplate::Chain, "chain"}};

}  // namespace

RigTemplate rigTemplateOf(const std::string& word) {
    for (const auto& [rig, name] : kNames)
        if (word == name) return rig;
    throw Error("template \"" + word + "\": there are biped, quadruped and chain");
}

const char* nameOf(RigTemplate rig) {
    for (const auto& [known, name] : kNames)
        if (rig == known) return name;
    return "";
}

Rig fittedRig(const OpaqueVoxels& voxels, RigTemplate, const RigOptions& options) {
    if (voxels.count() == 0)
        throw Error("rig", "nothing of the object is opaque, so there is nothing to lay a skeleton into",
                    "check its appearance");
    const BodyFrame frame = bodyFrame(voxels, false);
    const BodyShape body(turned(voxels, frame), options.thinness);
    Rig rig;
    rig.skeleton = laidInto(bipedIn(body), Mat4(frame.axes));
    rig.limbs = bipedLimbs(rig.skeleton);
    const auto rest = posedJoints(rig.skeleton, restPose(rig.skeleton));
    const OpaqueVoxels solid = withoutCavities(voxels);
    const auto rims = rimsOf(solid, limbParts(solid, distanceField(solid), rig.limbs, rest), rig.limbs.size());
    rig.limbs = fittedLimbs(voxels, rest, alignedRolls(rig.limbs, rest, rims), {}, options);
    return rig;
}

}  // namespace voledit
