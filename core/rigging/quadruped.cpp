#include "core/rigging/quadruped.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/rigging/body_frame.h"
#include "core/rigging/tree_paths.h"

namespace voledit {

namespace {

using Feet = std::array<Vec3, 4>;

/// The height at which the legs join the trunk: the lowest level at which the four are not four parts any more.
double bellyOf(const BodyShape& body, const Feet& feet) {
    for (double y = feet[0].y; y < body.box.max.y; y += body.voxels.spacing.y)
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a + 1; b < 4; ++b) {
                const Section s = body.levelAt(y, feet[a]), t = body.levelAt(y, feet[b]);
                if (!s.cells || !t.cells || glm::length(s.mean - t.mean) < 0.1 * body.step) return y;
            }
    return body.box.center().y;
}

/// The middle of the body's section across its length at z, near height y.
Vec3 trunkAt(const BodyShape& body, double z, const Vec3& near, double reach) {
    const Section s = body.sectionAt({near.x, near.y, z}, {0, 0, 1}, reach);
    return s.cells ? Vec3(s.mean.x, s.mean.y, z) : Vec3(near.x, near.y, z);
}

/// Hip or shoulder, knee or elbow, ankle or wrist, and the foot's end of one leg.
std::array<Vec3, 4> legAt(const BodyShape& body, const Vec3& foot, double belly, double depth) {
    const auto level = [&](double y, const Vec3& near) {
        const Section s = body.levelAt(y, near);
        return s.cells ? Vec3(s.mean.x, y, s.mean.z) : Vec3(near.x, y, near.z);
    };
    const double ground = body.box.min.y - 0.5 * body.step;
    const Vec3 top = level(belly - 1.5 * body.step, foot);
    std::array<Vec3, 4> leg;
    leg[0] = Vec3(top.x, belly + 0.25 * depth, top.z);
    leg[1] = level(glm::mix(ground, leg[0].y, 0.5), top);
    leg[2] = level(glm::mix(ground, leg[0].y, 0.16), leg[1]);
    leg[3] = level(ground + 0.5 * body.step, leg[2]);
    leg[3].y = ground;
    return leg;
}

/// Ends of the curve skeleton that are head and tail: foremost above the belly, and rearmost; −1 where there is none.
struct Tips {
    int head = -1, tail = -1;
};

Tips tipsOf(const BodyShape& body, const Feet& feet, double belly) {
    const double fore = 0.5 * (feet[2].z + feet[3].z), hind = 0.5 * (feet[0].z + feet[1].z);
    Tips tips;
    for (const int e : HungTree(body.tree, 0).ends()) {
        const Vec3& at = body.tree.nodes[std::size_t(e)].at;
        // A head may hang, a tail mostly does: what counts is how far out they are.
        if (at.z > fore && at.y > glm::mix(body.box.min.y, belly, 0.5) &&
            (tips.head < 0 ||
             at.z + at.y > body.tree.nodes[std::size_t(tips.head)].at.z + body.tree.nodes[std::size_t(tips.head)].at.y))
            tips.head = e;
        if (at.z < hind && at.y > glm::mix(body.box.min.y, belly, 0.35) &&
            (tips.tail < 0 || at.z < body.tree.nodes[std::size_t(tips.tail)].at.z))
            tips.tail = e;
    }
    return tips;
}

/// Adds joints in a row below `parent`; gives the index of the first.
int addRow(Skeleton& skeleton, int parent, const std::vector<std::string>& names, const std::vector<Vec3>& at) {
    const int first = static_cast<int>(skeleton.joints.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        skeleton.joints.push_back({names[i], parent, at[i], std::nullopt});
        parent = static_cast<int>(skeleton.joints.size()) - 1;
    }
    return first;
}

/// Points of the way from the tip to the trunk at parts of the length outside it; empty where that is short.
std::vector<Vec3> outwards(const BodyShape& body, int tip, const Vec3& from, double least) {
    if (tip < 0) return {};
    int root = 0;
    for (int i = 1; i < static_cast<int>(body.tree.nodes.size()); ++i)
        if (glm::length(body.tree.nodes[std::size_t(i)].at - from) <
            glm::length(body.tree.nodes[std::size_t(root)].at - from))
            root = i;
    const MedialPath path(body.tree, HungTree(body.tree, root).between(root, tip), 2 * body.step);
    const double start = body.tree.nodes[std::size_t(root)].radius;
    if (path.empty() || path.length() < start + least) return {};
    std::vector<Vec3> line;
    for (const double t : {0.0, 0.55, 1.0}) line.push_back(path.at(glm::mix(start, path.length(), t)));
    // On to the surface: the curve skeleton ends as deep inside as the end is thick.
    line.back() += path.direction(path.length(), 3 * body.step) * body.tree.nodes[std::size_t(tip)].radius;
    return line;
}

}  // namespace

std::optional<Feet> fourFeet(const BodyShape& body) {
    const double height = body.box.size().y;
    Index3 low(0), high = body.voxels.size - 1;
    low.y = high.y =
        static_cast<int>(std::lround((body.box.min.y + 0.1 * height - body.voxels.origin.y) / body.voxels.spacing.y));
    auto parts = partsOf(body.voxels, low, high, 1);
    if (parts.size() < 4) return std::nullopt;
    // Four of about one size, and no more of them.
    if (parts[3].cells * 8 < parts[0].cells) return std::nullopt;
    if (parts.size() > 4 && parts[4].cells * 8 >= parts[0].cells) return std::nullopt;
    parts.resize(4);
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.mean.z < b.mean.z; });
    Feet feet;
    for (std::size_t pair = 0; pair < 2; ++pair) {
        const Part &a = parts[2 * pair], &b = parts[2 * pair + 1];
        if ((a.mean.x > body.mean.x) == (b.mean.x > body.mean.x)) return std::nullopt;
        feet[2 * pair] = a.mean.x > b.mean.x ? a.mean : b.mean;
        feet[2 * pair + 1] = a.mean.x > b.mean.x ? b.mean : a.mean;
    }
    return feet;
}

Skeleton quadrupedIn(const BodyShape& body) {
    const auto feet = fourFeet(body);
    if (!feet)
        throw Error("rig", "the object does not stand on four legs that are apart from one another",
                    "choose another template");
    const double belly = bellyOf(body, *feet);
    const Vec3 above(body.mean.x, belly + 2 * body.step, 0);
    const double hind = 0.5 * ((*feet)[0].z + (*feet)[1].z), fore = 0.5 * ((*feet)[2].z + (*feet)[3].z);
    const double middle = 0.5 * (hind + fore);
    const Section loins = body.sectionAt({above.x, above.y, middle}, {0, 0, 1}, body.box.size().y);
    const double depth = loins.cells ? loins.box.size().y + body.step : 0.3 * body.box.size().y;
    const Vec3 back = loins.cells ? loins.mean : above;
    Skeleton skeleton;
    std::vector<Vec3> trunk;
    for (const double t : {0.0, 0.33, 0.67, 1.0})
        trunk.push_back(trunkAt(body, glm::mix(hind, fore, t), back, 0.75 * depth));
    // Sections through the legs reach to the ground: the spine keeps to the trunk.
    trunk.front().y = std::max(trunk.front().y, back.y);
    trunk.back().y = std::max(trunk.back().y, back.y);
    const Tips tips = tipsOf(body, *feet, belly);
    const auto neck = outwards(body, tips.head, trunk.back(), 0.3 * depth);
    addRow(skeleton, Joint::kNoParent, {"Hips", "Spine", "Spine1", "Spine2"}, trunk);
    if (!neck.empty()) addRow(skeleton, 3, {"Neck", "Head", "Head_End"}, neck);
    for (std::size_t f = 0; f < 4; ++f) {
        const std::string side = f % 2 == 0 ? "Left" : "Right";
        const auto leg = legAt(body, (*feet)[f], belly, depth);
        const bool isHind = f < 2;
        const std::vector<std::string> names = isHind ? std::vector<std::string>{"UpLeg", "Leg", "Foot", "Foot_End"}
                                                      : std::vector<std::string>{"Arm", "ForeArm", "Hand", "Hand_End"};
        std::vector<std::string> full;
        for (const std::string& name : names) full.push_back(side + name);
        addRow(skeleton, isHind ? 0 : 3, full, {leg.begin(), leg.end()});
    }
    if (const auto tail = outwards(body, tips.tail, trunk.front(), 0.5 * depth); !tail.empty())
        addRow(skeleton, 0, {"Tail", "Tail1", "Tail_End"}, tail);
    return skeleton;
}

std::vector<Limb> quadrupedLimbs(const Skeleton& skeleton) {
    std::vector<Limb> limbs;
    for (int to = 0; to < static_cast<int>(skeleton.joints.size()); ++to) {
        const Joint& joint = skeleton.joints[std::size_t(to)];
        if (joint.parent == Joint::kNoParent) continue;
        Limb limb;
        limb.from = joint.parent;
        limb.to = to;
        const std::string side = joint.name.starts_with("Left") ? "Left" : "Right";
        limb.name = joint.name.ends_with("UpLeg")                                     ? side + "Hip"
                    : joint.name.ends_with("Arm") && !joint.name.ends_with("ForeArm") ? side + "Shoulder"
                    : joint.name == "Tail"                                            ? "TailRoot"
                                           : skeleton.joints[std::size_t(joint.parent)].name;
        limbs.push_back(limb);
    }
    return limbs;
}

}  // namespace voledit
