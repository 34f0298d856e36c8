#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/rigging/biped_joints.h"

namespace voledit {

namespace {

/// Widths of the body's middle part over height, from shoulders to top.
struct Neck {
    double base = 0, skull = 0;  // heights of the neck's foot and of the skull's pivot
};

/// The narrowest level between head and shoulders; the neck reaches down to where it has grown by a third.
Neck neckOf(const BodyShape& body, const Vec3& near) {
    const double height = body.box.size().y, top = body.box.max.y;
    const double from = top - 0.26 * height, to = top - 0.09 * height;
    const auto width = [&](double y) {
        const Section s = body.levelAt(y, near);
        return s.cells ? s.box.size().x + body.step : kInfinity;
    };
    double throat = top - 0.13 * height, narrowest = kInfinity;
    for (double y = to; y >= from; y -= body.voxels.spacing.y)
        if (const double w = width(y); w < narrowest) std::tie(narrowest, throat) = std::pair(w, y);
    Neck neck;
    neck.base = throat;
    while (neck.base > from && width(neck.base) < 1.33 * narrowest) neck.base -= body.voxels.spacing.y;
    // A neck as long as none is has no waist: shoulders like a bottle's.
    neck.base = std::clamp(neck.base, top - 0.2 * height, top - 0.13 * height);
    throat = std::max(throat, neck.base + 0.02 * height);
    neck.skull = throat + 0.2 * (top - throat);
    return neck;
}

}  // namespace

BipedJoints bipedByProportions(const BodyShape& body) {
    const double h = body.box.size().y;
    const auto level = [&](double f) { return body.box.min.y + f * h; };
    const auto middleAt = [&](double y, const Vec3& near) {
        const Section s = body.levelAt(y, near);
        return s.cells ? Vec3(s.mean.x, y, s.mean.z) : Vec3(near.x, y, near.z);
    };
    BipedJoints joints;
    const std::array<double, 7> trunk{0.535, 0.58, 0.655, 0.745, 0.84, 0.9, 1};
    for (std::size_t i = 0; i < trunk.size(); ++i) joints.trunk[i] = middleAt(level(trunk[i]), body.mean);
    for (std::size_t s = 0; s < 2; ++s) {
        const double side = s == 0 ? 1 : -1;
        auto& leg = joints.leg[s];
        leg[0] = joints.trunk[0] + Vec3(side * 0.058 * h, -0.015 * h, 0);
        leg[1] = middleAt(level(0.275), leg[0]);
        leg[2] = middleAt(level(0.045), leg[1]);
        leg[3] = Vec3(leg[2].x, level(0.015), leg[2].z + 0.08 * h);
        leg[4] = Vec3(leg[2].x, level(0.015), leg[2].z + 0.12 * h);
        auto& arm = joints.arm[s];
        arm[0] = joints.trunk[3] + Vec3(side * 0.016 * h, 0.06 * h, 0);
        arm[1] = joints.trunk[3] + Vec3(side * 0.1 * h, 0.06 * h, 0);
        // Arms that the body does not show hang aslant.
        const Vec3 along = glm::normalize(Vec3(side, -1, 0));
        const std::array<double, 3> reach{0.15, 0.29, 0.38};
        for (std::size_t i = 0; i < 3; ++i) arm[i + 2] = arm[1] + reach[i] * h * along;
    }
    return joints;
}

void placeTrunk(const BodyShape& body, BipedJoints& joints) {
    // High enough above the hip joints that the limbs to the legs slope: the planes in which they meet the thighs then
    // run like the groin, and a thigh that swings carries little of the flank.
    const Vec3 hips = 0.5 * (joints.leg[0][0] + joints.leg[1][0]) + Vec3(0, 0.035 * body.box.size().y, 0);
    const Neck neck = neckOf(body, hips);
    const auto middleAt = [&](double y, const Vec3& near) {
        const Section s = body.levelAt(y, near);
        return s.cells ? Vec3(s.mean.x, y, s.mean.z) : Vec3(near.x, y, near.z);
    };
    auto& trunk = joints.trunk;
    trunk[0] = middleAt(hips.y, hips);
    // Parts of the spine between hips and neck, where rigs bend it: loins, waist, and as high as the armpits, so that
    // what tapers to the neck is above them.
    const std::array<double, 3> parts{0.15, 0.42, 0.74};
    for (std::size_t i = 0; i < 3; ++i) trunk[i + 1] = middleAt(glm::mix(hips.y, neck.base, parts[i]), trunk[i]);
    trunk[4] = middleAt(neck.base, trunk[3]);
    // A belly or a breast draws the middle of a section forward; the spine bends less.
    for (std::size_t i = 1; i < 4; ++i)
        trunk[i].z = glm::mix(trunk[i].z, glm::mix(trunk[0].z, trunk[4].z, parts[i - 1]), 0.6);
    trunk[5] = middleAt(neck.skull, trunk[4]);
    // The skull's pivot is above the neck, not in the middle of the face.
    trunk[5].z = glm::mix(trunk[4].z, trunk[5].z, 0.25);
    trunk[6] = middleAt(glm::mix(neck.skull, body.box.max.y, 0.6), trunk[5]);
    trunk[6].y = body.box.max.y;
}

}  // namespace voledit
