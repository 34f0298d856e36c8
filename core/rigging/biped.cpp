#include "core/rigging/biped.h"

#include <glm/common.hpp>

#include "core/rigging/biped_joints.h"
#include "core/rigging/body_frame.h"

namespace voledit {

namespace {

/// Adds joints in a row below `parent`.
template <std::size_t n>
void addChain(Skeleton& skeleton, int parent, const std::array<std::string, n>& names, const std::array<Vec3, n>& at) {
    for (std::size_t i = 0; i < n; ++i) {
        skeleton.joints.push_back({names[i], parent, at[i], std::nullopt});
        parent = static_cast<int>(skeleton.joints.size()) - 1;
    }
}

Skeleton skeletonOf(const BipedJoints& joints) {
    const std::array<std::string, 2> sides{"Left", "Right"};
    Skeleton skeleton;
    addChain<7>(skeleton, Joint::kNoParent, {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "Head_End"},
                joints.trunk);
    for (std::size_t s = 0; s < 2; ++s)
        addChain<5>(
            skeleton, skeleton.find("Hips"),
            {sides[s] + "UpLeg", sides[s] + "Leg", sides[s] + "Foot", sides[s] + "ToeBase", sides[s] + "ToeBase_End"},
            joints.leg[s]);
    for (std::size_t s = 0; s < 2; ++s)
        addChain<5>(
            skeleton, skeleton.find("Spine2"),
            {sides[s] + "Shoulder", sides[s] + "Arm", sides[s] + "ForeArm", sides[s] + "Hand", sides[s] + "Hand_End"},
            joints.arm[s]);
    return skeleton;
}

}  // namespace

void makeSymmetric(const BodyShape& body, BipedJoints& joints) {
    constexpr double kAlike = 0.9;
    if (mirrorSymmetry(body.voxels, 0) < kAlike) return;
    const double middle = body.mean.x;
    const auto mirrored = [&](const Vec3& p) { return Vec3(2 * middle - p.x, p.y, p.z); };
    for (Vec3& p : joints.trunk) p.x = middle;
    for (auto* pair : {&joints.leg, &joints.arm})
        for (std::size_t i = 0; i < 5; ++i) {
            (*pair)[0][i] = 0.5 * ((*pair)[0][i] + mirrored((*pair)[1][i]));
            (*pair)[1][i] = mirrored((*pair)[0][i]);
        }
}

Skeleton bipedIn(const BodyShape& body) {
    BipedJoints joints = bipedByProportions(body);
    const BipedPaths paths = bipedPaths(body);
    placeLegs(body, paths, joints);
    placeTrunk(body, joints);
    placeArms(body, paths, joints);
    makeSymmetric(body, joints);
    return skeletonOf(joints);
}

std::vector<Limb> bipedLimbs(const Skeleton& skeleton) {
    std::vector<Limb> limbs;
    for (int to = 0; to < static_cast<int>(skeleton.joints.size()); ++to) {
        const Joint& joint = skeleton.joints[std::size_t(to)];
        if (joint.parent == Joint::kNoParent || joint.name.ends_with("Shoulder")) continue;
        Limb limb;
        limb.name = joint.name == "LeftUpLeg"    ? "LeftHip"
                    : joint.name == "RightUpLeg" ? "RightHip"
                                                 : skeleton.joints[std::size_t(joint.parent)].name;
        limb.from = joint.parent;
        limb.to = to;
        limbs.push_back(limb);
    }
    return limbs;
}

}  // namespace voledit
