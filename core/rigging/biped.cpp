#include "core/rigging/biped.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/rigging/body_frame.h"
#include "core/rigging/grid_steps.h"

namespace voledit {

namespace {

constexpr const char* kSides[2] = {"Left", "Right"};

/// Where a body's joints are, left to right.
struct BipedJoints {
    std::array<Vec3, 7> trunk;               // Hips, Spine, Spine1, Spine2, Neck, Head, Head_End
    std::array<std::array<Vec3, 5>, 2> leg;  // of each side: UpLeg, Leg, Foot, ToeBase, ToeBase_End
    std::array<std::array<Vec3, 5>, 2> arm;  // Shoulder, Arm, ForeArm, Hand, Hand_End
};

/// The body cut across.
class Slices {
public:
    explicit Slices(const OpaqueVoxels& body) : body_(body), box_(body.bounds()) {}
    const Box3& box() const { return box_; }

    /// Mean of the part nearest to x = `near` of the slice across `axis` at `at` (world units); its x, y or z is `at`.
    Vec3 middleAt(int axis, double at, const Vec3& near) const {
        Index3 low(0), high = body_.size - 1;
        low[axis] = high[axis] =
            std::clamp(int(std::lround((at - body_.origin[axis]) / body_.spacing[axis])), 0, body_.size[axis] - 1);
        Vec3 best = near;
        double nearest = kInfinity;
        for (const Part& part : partsOf(body_, low, high, 4)) {
            Vec3 d = part.mean - near;
            d[axis] = 0;
            if (glm::length(d) >= nearest) continue;
            nearest = glm::length(d);
            best = part.mean;
        }
        best[axis] = at;
        return best;
    }

    /// The foremost opaque cell up to the height `top`, on the same side of the body as `near`.
    Vec3 foremost(const Vec3& near, double top) const {
        Vec3 best = near;
        for (std::size_t i = 0; i < body_.opaque.size(); ++i) {
            if (!body_.opaque[i]) continue;
            const Vec3 p = body_.centre(cellOf(body_, i));
            if (p.y <= top && (p.x > box_.center().x) == (near.x > box_.center().x) && p.z > best.z) best = p;
        }
        return best;
    }

private:
    const OpaqueVoxels& body_;
    Box3 box_;
};

BipedJoints byBounds(const OpaqueVoxels& body) {
    const Slices slices(body);
    const Box3 box = slices.box();
    const double h = box.size().y;
    const Vec3 middle(box.center().x, 0, box.center().z);
    const auto level = [&](double f) { return box.min.y + f * h; };
    BipedJoints joints;
    const std::array<double, 7> trunk{0.537, 0.585, 0.66, 0.75, 0.84, 0.905, 1};
    for (std::size_t i = 0; i < trunk.size(); ++i) joints.trunk[i] = slices.middleAt(1, level(trunk[i]), middle);
    for (std::size_t s = 0; s < 2; ++s) {
        const double side = s == 0 ? 1 : -1;
        auto& leg = joints.leg[s];
        leg[0] = joints.trunk[0] + Vec3(side * 0.066 * h, -0.014 * h, 0);
        leg[1] = slices.middleAt(1, level(0.27), leg[0]);
        leg[2] = slices.middleAt(1, level(0.044), leg[1]);
        leg[4] = slices.foremost(leg[2], level(0.03));
        leg[3] = glm::mix(leg[2], leg[4], 0.6);
        leg[3].y = leg[4].y;
        auto& arm = joints.arm[s];
        arm[0] = joints.trunk[3] + Vec3(side * 0.016 * h, 0.055 * h, 0.02 * h);
        arm[1] = joints.trunk[3] + Vec3(side * 0.101 * h, 0.057 * h, 0);
        const double tip = s == 0 ? box.max.x : box.min.x;
        Vec3 at = arm[1];
        const std::array<double, 3> reach{0.48, 0.85, 1};
        for (std::size_t i = 0; i < 3; ++i) at = arm[i + 2] = slices.middleAt(0, glm::mix(arm[1].x, tip, reach[i]), at);
    }
    return joints;
}

/// Adds joints in a row below `parent`.
template <std::size_t n>
void addChain(Skeleton& skeleton, int parent, const std::array<std::string, n>& names, const std::array<Vec3, n>& at) {
    for (std::size_t i = 0; i < n; ++i) {
        skeleton.joints.push_back({names[i], parent, at[i], std::nullopt});
        parent = static_cast<int>(skeleton.joints.size()) - 1;
    }
}

}  // namespace

Skeleton bipedIn(const OpaqueVoxels& body, const RigOptions&) {
    const BipedJoints joints = byBounds(body);
    Skeleton skeleton;
    addChain<7>(skeleton, Joint::kNoParent, {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "Head_End"},
                joints.trunk);
    for (std::size_t s = 0; s < 2; ++s) {
        const std::string side = kSides[s];
        addChain<5>(skeleton, skeleton.find("Hips"),
                    {side + "UpLeg", side + "Leg", side + "Foot", side + "ToeBase", side + "ToeBase_End"},
                    joints.leg[s]);
    }
    for (std::size_t s = 0; s < 2; ++s) {
        const std::string side = kSides[s];
        addChain<5>(skeleton, skeleton.find("Spine2"),
                    {side + "Shoulder", side + "Arm", side + "ForeArm", side + "Hand", side + "Hand_End"},
                    joints.arm[s]);
    }
    return skeleton;
}

std::vector<Limb> bipedLimbs(const Skeleton& skeleton) {
    std::vector<Limb> limbs;
    for (int to = 0; to < static_cast<int>(skeleton.joints.size()); ++to) {
        const Joint& joint = skeleton.joints[std::size_t(to)];
        if (joint.parent == Joint::kNoParent || joint.name.ends_with("Shoulder")) continue;
        const std::string parent = skeleton.joints[std::size_t(joint.parent)].name;
        Limb limb;
        limb.name = joint.name == "LeftUpLeg" ? "LeftHip" : joint.name == "RightUpLeg" ? "RightHip" : parent;
        limb.from = joint.parent;
        limb.to = to;
        limbs.push_back(limb);
    }
    return limbs;
}

}  // namespace voledit
