#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/rigging/biped_joints.h"
#include "core/rigging/grid_steps.h"

namespace voledit {

namespace {

/// Area of the section across the path at s, in cells.
double areaAt(const BodyShape& body, const MedialPath& path, double s) {
    const double h = body.box.size().y;
    return double(body.sectionAt(path.at(s), path.direction(s, 0.02 * h), 0.14 * h).cells);
}

/// Length along the path (from the tip) at which the section first takes in the trunk: the armpit's.
double armpitAt(const BodyShape& body, const MedialPath& path) {
    const double length = path.length();
    std::vector<double> upper;
    for (double s = 0.45 * length; s < 0.65 * length; s += body.step) upper.push_back(areaAt(body, path, s));
    std::sort(upper.begin(), upper.end());
    const double usual = upper[upper.size() / 2];
    for (double s = 0.55 * length; s < length; s += 0.5 * body.step)
        if (areaAt(body, path, s) > 1.8 * usual) return s;
    return length;
}

/// The least section where the wrist may be: about a quarter of the way from the finger tips to the shoulder.
double wristAt(const BodyShape& body, const MedialPath& path, double shoulderAt) {
    double best = 0.26 * shoulderAt, least = kInfinity;
    for (double s = 0.2 * shoulderAt; s <= 0.36 * shoulderAt; s += 0.5 * body.step)
        // A hand hangs together across the plane only as far as its fingers do, so all of it is counted.
        if (const double area = areaAt(body, path, s); area < least) std::tie(least, best) = std::pair(area, s);
    return best;
}

/// The middle of the hand's flesh beyond the wrist, and how far it reaches along the way there.
Vec3 handEnd(const BodyShape& body, const Vec3& wrist, const Vec3& tip) {
    const double reach = 1.5 * glm::length(tip - wrist);
    const Vec3 forward = glm::normalize(tip - wrist);
    const auto eachOfHand = [&](const auto& visit) {
        const Index3 low = glm::clamp(cellAt(body.voxels, wrist - reach), Index3(0), body.voxels.size - 1);
        const Index3 high = glm::clamp(cellAt(body.voxels, wrist + reach), Index3(0), body.voxels.size - 1);
        for (Index3 c = low; c.z <= high.z; ++c.z)
            for (c.y = low.y; c.y <= high.y; ++c.y)
                for (c.x = low.x; c.x <= high.x; ++c.x) {
                    const Vec3 d = body.voxels.centre(c) - wrist;
                    if (body.voxels.opaque[body.voxels.indexOf(c)] && glm::dot(d, forward) > 0 &&
                        glm::length(d) < reach)
                        visit(d);
                }
    };
    Vec3 sum(0);
    double count = 0;
    eachOfHand([&](const Vec3& d) { sum += d, ++count; });
    if (count < 1 || glm::length(sum) == 0) return tip;
    const Vec3 along = glm::normalize(sum);
    double farthest = 0;
    eachOfHand([&](const Vec3& d) { farthest = std::max(farthest, glm::dot(d, along)); });
    return wrist + farthest * along;
}

void placeArm(const BodyShape& body, const MedialPath& path, std::array<Vec3, 5>& arm) {
    const double armpit = armpitAt(body, path);
    const Vec3 pit = path.at(armpit);
    const Vec3 inward = glm::normalize(pit - path.at(armpit - 0.25 * path.length()));
    // Seen along the arm the joint is above the armpit: an arm that hangs goes on past the armpit's section by about
    // its thickness, one that is held out ends there.
    const double radius = std::sqrt(areaAt(body, path, armpit - 0.12 * path.length()) / kPi) * body.step;
    const double beyond = 2.1 * radius * std::clamp(inward.y, 0.0, 1.0);
    arm[1] = pit + beyond * inward;
    const double shoulderAt = std::min(path.length(), armpit + beyond);
    const double wrist = wristAt(body, path, shoulderAt);
    const Section cut = body.sectionAt(path.at(wrist), path.direction(wrist, 3 * body.step), 3 * radius);
    arm[3] = cut.cells ? cut.mean : path.at(wrist);
    // The elbow: where the arm bends, or about the middle between shoulder and wrist.
    const double span = shoulderAt - wrist;
    const auto [bendAt, bend] = path.bulge(wrist, shoulderAt);
    const double share = (bendAt - wrist) / span, plain = 0.47;
    const double weight = share > 0.35 && share < 0.65 ? std::clamp(bend / (0.08 * span), 0.0, 1.0) : 0;
    const double elbow = wrist + glm::mix(plain, share, weight) * span;
    const Section across = body.sectionAt(path.at(elbow), path.direction(elbow, 0.1 * span), 3 * radius);
    arm[2] = across.cells ? across.mean : path.at(elbow);
    arm[4] = handEnd(body, arm[3], path.at(0));
}

}  // namespace

void placeArms(const BodyShape& body, const BipedPaths& paths, BipedJoints& joints) {
    for (std::size_t s = 0; s < 2; ++s) {
        auto& arm = joints.arm[s];
        if (!paths.arm[s].empty()) placeArm(body, paths.arm[s], arm);
        // The collar bone begins beside the breast bone, in front of the spine, about as high as it ends.
        const Section chest = body.levelAt(arm[1].y, joints.trunk[3]);
        const double front = chest.cells ? chest.box.max.z : joints.trunk[3].z;
        const double x = glm::mix(joints.trunk[4].x, arm[1].x, 0.16);
        const double z = glm::mix(joints.trunk[4].z, front, 0.3);
        arm[0] = {x, std::min(arm[1].y, joints.trunk[4].y), z};
    }
}

}  // namespace voledit
