#include "core/rigging/rig.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/rigging/biped.h"
#include "core/rigging/biped_joints.h"
#include "core/rigging/body_frame.h"
#include "core/rigging/body_shape.h"
#include "core/rigging/chain.h"
#include "core/rigging/limb_boxes.h"
#include "core/rigging/quadruped.h"

namespace voledit {

namespace {

constexpr std::pair<RigTemplate, const char*> kNames[] = {
    {RigTemplate::Biped, "biped"}, {RigTemplate::Quadruped, "quadruped"}, {RigTemplate::Chain, "chain"}};

void requireSome(const OpaqueVoxels& voxels) {
    if (voxels.count() == 0)
        throw Error("rig", "nothing of the object is opaque, so there is nothing to lay a skeleton into",
                    "check its appearance");
}

BodyShape shapeOf(const OpaqueVoxels& voxels, const BodyFrame& frame, const RigOptions& options) {
    return {turned(voxels, frame), options.thinness};
}

/// Whether a level through the shins shows two parts of about one size, on both sides of the middle.
bool standsOnTwoLegs(const BodyShape& body) {
    Index3 low(0), high = body.voxels.size - 1;
    const double shins = body.box.min.y + 0.18 * body.box.size().y;
    low.y = high.y = static_cast<int>(std::lround((shins - body.voxels.origin.y) / body.voxels.spacing.y));
    const auto parts = partsOf(body.voxels, low, high, 1);
    return parts.size() >= 2 && parts[1].cells * 3 >= parts[0].cells &&
           (parts.size() == 2 || parts[2].cells * 4 < parts[1].cells) &&
           (parts[0].mean.x > body.mean.x) != (parts[1].mean.x > body.mean.x);
}

/// Skeleton and limbs without boxes.
Rig rigIn(const OpaqueVoxels& voxels, RigTemplate rig, const RigOptions& options) {
    const BodyFrame frame = rig == RigTemplate::Chain ? BodyFrame{} : bodyFrame(voxels, rig == RigTemplate::Quadruped);
    const BodyShape body = shapeOf(voxels, frame, options);
    Rig result;
    if (rig == RigTemplate::Biped) {
        result.skeleton = bipedIn(body);
        result.limbs = bipedLimbs(result.skeleton);
    } else if (rig == RigTemplate::Quadruped) {
        result.skeleton = quadrupedIn(body);
        result.limbs = quadrupedLimbs(result.skeleton);
    } else {
        result.skeleton = chainIn(body, options.chain);
        result.limbs = chainLimbs(result.skeleton);
    }
    result.skeleton = laidInto(result.skeleton, Mat4(frame.axes));
    return result;
}

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

RigTemplate suitedTemplate(const OpaqueVoxels& voxels, const RigOptions& options) {
    requireSome(voxels);
    const BodyShape four = shapeOf(voxels, bodyFrame(voxels, true), options);
    if (fourFeet(four)) return RigTemplate::Quadruped;
    const BodyShape two = shapeOf(voxels, bodyFrame(voxels, false), options);
    const BipedPaths paths = bipedPaths(two);
    const auto isThere = [](const std::array<MedialPath, 2>& pair) { return !pair[0].empty() && !pair[1].empty(); };
    return standsOnTwoLegs(two) && isThere(paths.leg) && isThere(paths.arm) ? RigTemplate::Biped : RigTemplate::Chain;
}

Rig fittedRig(const OpaqueVoxels& voxels, RigTemplate rig, const RigOptions& options) {
    requireSome(voxels);
    Rig fitted = rigIn(voxels, rig, options);
    const auto rest = posedJoints(fitted.skeleton, restPose(fitted.skeleton));
    const OpaqueVoxels solid = withoutCavities(voxels);
    const auto rims = rimsOf(solid, limbParts(solid, distanceField(solid), fitted.limbs, rest), fitted.limbs.size());
    fitted.limbs = fittedLimbs(voxels, rest, alignedRolls(fitted.limbs, rest, rims), {}, options);
    return fitted;
}

}  // namespace voledit
