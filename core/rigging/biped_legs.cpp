#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/rigging/biped_joints.h"

namespace voledit {

namespace {

/// The highest level below the waist at which the legs are apart: there the sections through both are different ones.
double crotchOf(const BodyShape& body, const BipedPaths& paths) {
    const double h = body.box.size().y;
    const double low = body.box.min.y + 0.25 * h, high = body.box.min.y + 0.62 * h;
    for (double y = low; y < high; y += body.voxels.spacing.y) {
        std::array<Section, 2> leg;
        for (std::size_t s = 0; s < 2; ++s) {
            // Where the path crosses the level, coming from the foot.
            double at = 0;
            while (at < paths.leg[s].length() && paths.leg[s].at(at).y < y) at += 0.5 * body.step;
            leg[s] = body.levelAt(y, paths.leg[s].at(at));
        }
        const bool apart = glm::length(leg[0].mean - leg[1].mean) > 0.1 * body.step;
        if (!leg[0].cells || !leg[1].cells || !apart) return y - 0.5 * body.voxels.spacing.y;
    }
    return kNaN;
}

/// The ankle's height: a little below where the foot's length above it has shrunk to about the shin's.
double ankleOf(const BodyShape& body, const Vec3& knee, const Vec3& foot) {
    const double h = body.box.size().y, ground = body.box.min.y;
    const auto along = [&](double y) {
        const Vec3 near = glm::mix(foot, knee, std::clamp((y - foot.y) / (knee.y - foot.y), 0.0, 1.0));
        const Section s = body.levelAt(y, near);
        return s.cells ? s.box.size().z + body.step : kInfinity;
    };
    double shin = kInfinity;
    for (double y = ground + 0.06 * h; y < ground + 0.14 * h; y += body.voxels.spacing.y)
        shin = std::min(shin, along(y));
    double y = ground + 0.14 * h;
    while (y > ground + 0.02 * h && along(y) < 1.3 * shin) y -= body.voxels.spacing.y;
    return std::clamp(y - 0.15 * shin, ground + 0.035 * h, ground + 0.075 * h);
}

void placeFoot(const BodyShape& body, const MedialPath& path, std::array<Vec3, 5>& leg) {
    const double h = body.box.size().y;
    const Vec3 toe = path.at(0);
    // The middle of the sole's level, between heel and toes.
    const Section sole = body.levelAt(body.box.min.y + 0.012 * h, glm::mix(leg[2], toe, 0.5));
    if (!sole.cells) return;
    const double front = sole.box.max.z;
    const double y = std::min(leg[2].y, body.box.min.y + 0.018 * h);
    const auto across = [&](double z) {
        const Section s = body.sectionAt({sole.mean.x, y, z}, {0, 0, 1}, 0.08 * h);
        return Vec3(s.cells ? s.mean.x : sole.mean.x, y, z);
    };
    // Toes are the front third of what lies before the ankle.
    leg[3] = across(glm::mix(leg[2].z, front, 0.62));
    leg[4] = across(front - 0.5 * body.step);
    leg[4].y = leg[3].y = std::max(y, body.box.min.y + 0.25 * (leg[2].y - body.box.min.y));
}

}  // namespace

void placeLegs(const BodyShape& body, const BipedPaths& paths, BipedJoints& joints) {
    if (paths.leg[0].empty() || paths.leg[1].empty()) return;
    const double h = body.box.size().y;
    double crotch = crotchOf(body, paths);
    if (!std::isfinite(crotch)) crotch = body.box.min.y + 0.47 * h;
    for (std::size_t s = 0; s < 2; ++s) {
        auto& leg = joints.leg[s];
        const MedialPath& path = paths.leg[s];
        const auto crossing = [&](double y) {
            double at = 0;
            while (at < path.length() && path.at(at).y < y) at += 0.5 * body.step;
            return at;
        };
        const double thighTop = crossing(crotch - 0.015 * h);
        const Section thigh = body.levelAt(crotch - 0.015 * h, path.at(thighTop));
        // The hip joint is above the crotch, where the thigh's axis comes to the middle of the pelvis' half.
        const double hip = crotch + 0.047 * h;
        const Section pelvis = body.levelAt(hip, body.mean);
        const double middle = pelvis.cells ? pelvis.box.center().x : body.mean.x;
        const double half = pelvis.cells ? 0.5 * pelvis.box.size().x : 0.1 * h;
        const double side = s == 0 ? 1 : -1;
        leg[0] = {0.5 * (thigh.mean.x + middle + side * 0.6 * half), hip, pelvis.cells ? pelvis.mean.z : thigh.mean.z};
        leg[0].z = 0.5 * (leg[0].z + thigh.mean.z);
        // The knee is where the way from hip to ankle bends, or about its middle.
        const double ankleAt = crossing(body.box.min.y + 0.055 * h);
        const double hipAt = path.nearest(leg[0]);
        const auto [bendAt, bend] = path.bulge(ankleAt, std::max(hipAt, ankleAt + body.step));
        const double span = hipAt - ankleAt, share = (bendAt - ankleAt) / std::max(span, 1e-9);
        const double plain = 0.485;
        const double weight = share > 0.35 && share < 0.6 ? std::clamp(bend / (0.08 * span), 0.0, 1.0) : 0;
        leg[1] = path.at(ankleAt + glm::mix(plain, share, weight) * span);
        const Section knee = body.sectionAt(leg[1], path.direction(ankleAt + 0.48 * span, 0.05 * h), 0.12 * h);
        if (knee.cells) leg[1] = knee.mean;
        const double ankle = ankleOf(body, leg[1], path.at(ankleAt));
        // Above the foot, which would draw the middle forward.
        const Section shin = body.levelAt(ankle + 0.025 * h, path.at(crossing(ankle + 0.025 * h)));
        const Vec3 above = shin.cells ? shin.mean : path.at(crossing(ankle + 0.025 * h));
        leg[2] = glm::mix(leg[1], above, (leg[1].y - ankle) / std::max(leg[1].y - above.y, 1e-9));
        placeFoot(body, path, leg);
    }
}

}  // namespace voledit
