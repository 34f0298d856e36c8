#include "core/skeleton/limb_joints.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <unordered_map>

namespace voledit {
namespace {

/// The angle, plane and wedge of a bend; corners are found by it.
struct Bend {
    Vec3 first{0}, second{0};  // directions; the second as if bent by the limit at most
    Vec3 normal{0};            // first + second
    Vec3 axis{0};
    double wedge = 0;
};

Bend bendOf(const PlacedLimb& first, const PlacedLimb& second, double miterLimit) {
    Bend bend{first.direction, second.direction, first.direction + second.direction, Vec3(0), 0};
    const Vec3 cross = glm::cross(first.direction, second.direction);
    const double sine = glm::length(cross);
    const double angle = std::atan2(sine, glm::dot(first.direction, second.direction));
    const double largest = largestMitre(miterLimit);
    if (!(angle > largest)) return bend;
    // Straight back: any axis across the bone serves; one that is fixed in the limb turns with it.
    constexpr double kStraightBack = 1e-12;
    Vec3 axis = sine > kStraightBack ? cross : first.section[1] - first.section[0];
    axis = glm::normalize(axis - first.direction * glm::dot(axis, first.direction));
    bend.axis = axis;
    bend.wedge = angle - largest;
    bend.second = std::cos(largest) * first.direction + std::sin(largest) * glm::cross(axis, first.direction);
    bend.normal = bend.first + bend.second;
    return bend;
}

/// Where the edge lines at `section` from the joint along `direction` meet the plane through the joint: offsets from
/// it.
Quad cut(const Quad& section, const Vec3& direction, const Vec3& normal) {
    const double along = glm::dot(direction, normal);
    Quad result;
    for (std::size_t m = 0; m < 4; ++m) result[m] = section[m] - direction * (glm::dot(section[m], normal) / along);
    return result;
}

Quad secondCut(const Bend& bend, const PlacedLimb& second) {
    if (bend.wedge == 0) return cut(second.section, bend.second, bend.normal);
    const Quat back = glm::angleAxis(-bend.wedge, bend.axis);
    Quad section;
    for (std::size_t m = 0; m < 4; ++m) section[m] = back * second.section[m];
    return cut(section, bend.second, bend.normal);
}

Vec3 restDirection(const Limb& limb, const std::vector<PosedJoint>& rest) {
    const Vec3 bone = rest[std::size_t(limb.to)].position - rest[std::size_t(limb.from)].position;
    const double length = glm::length(bone);
    return length > 0 ? bone / length : Vec3(0);
}

}  // namespace

double largestMitre(double miterLimit) {
    // A mitre a thousand times as far as the section is as good as none.
    return 2 * std::acos(1 / std::min(miterLimit, 1e3));
}

bool JointFaces::outside(const Vec3& point) const {
    const Vec3 reach = point - joint;
    return glm::dot(reach, glm::cross(normal, axis)) > 1e-9 * glm::length(end[2] - end[0]);
}

JointFaces jointFaces(const PlacedLimb& first, const PlacedLimb& second, double miterLimit) {
    const Bend bend = bendOf(first, second, miterLimit);
    const Quad a = cut(first.section, bend.first, bend.normal), b = secondCut(bend, second);
    JointFaces faces;
    faces.joint = first.end;
    faces.normal = glm::normalize(bend.normal);
    faces.axis = bend.axis;
    faces.wedge = bend.wedge;
    for (std::size_t m = 0; m < 4; ++m) faces.end[m] = faces.joint + 0.5 * (a[m] + b[m]);
    faces.start = faces.end;
    if (bend.wedge == 0) return faces;
    faces.turn = glm::angleAxis(bend.wedge, bend.axis);
    for (std::size_t m = 0; m < 4; ++m) faces.start[m] = faces.joint + faces.turn * (faces.end[m] - faces.joint);
    return faces;
}

int matchingTurns(const PlacedLimb& first, const PlacedLimb& second, double miterLimit) {
    const Bend bend = bendOf(first, second, miterLimit);
    const Quad a = cut(first.section, bend.first, bend.normal), b = secondCut(bend, second);
    int best = 0;
    double least = kInfinity;
    for (int turns = 0; turns < 4; ++turns) {
        const Quad tried = turned(b, turns);
        double sum = 0;
        for (std::size_t m = 0; m < 4; ++m) sum += glm::dot(tried[m] - a[m], tried[m] - a[m]);
        // Sections turned by 45° against each other tie; rounding must not choose.
        if (sum < least * (1 - 1e-9)) {
            least = sum;
            best = turns;
        }
    }
    return best;
}

LimbLinks linkedLimbs(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest,
                      const std::vector<bool>& disjoint) {
    LimbLinks links{std::vector<int>(limbs.size(), -1), std::vector<int>(limbs.size(), -1), {}};
    std::unordered_map<int, std::vector<int>> beginning;
    for (std::size_t l = 0; l < limbs.size(); ++l) beginning[limbs[l].from].push_back(int(l));
    const auto straightness = [&](int a, int b) {
        return glm::dot(restDirection(limbs[std::size_t(a)], rest), restDirection(limbs[std::size_t(b)], rest));
    };
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        const auto found = beginning.find(limbs[l].to);
        const std::size_t joint = std::size_t(limbs[l].to);
        if (found == beginning.end() || (joint < disjoint.size() && disjoint[joint])) continue;
        int best = -1;
        for (const int other : found->second)
            if (other != int(l) && (best < 0 || straightness(int(l), other) > straightness(int(l), best))) best = other;
        if (best < 0) continue;
        int& before = links.previous[std::size_t(best)];
        if (before < 0 || straightness(int(l), best) > straightness(before, best)) before = int(l);
    }
    for (std::size_t l = 0; l < limbs.size(); ++l)
        if (links.previous[l] >= 0) links.next[std::size_t(links.previous[l])] = int(l);
    for (std::size_t l = 0; l < limbs.size(); ++l)
        if (links.previous[l] < 0)
            for (int m = int(l); m >= 0; m = links.next[std::size_t(m)]) links.order.push_back(m);
    return links;
}

int continuationOf(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest, int limb,
                   const std::vector<bool>& disjoint) {
    return linkedLimbs(limbs, rest, disjoint).next[std::size_t(limb)];
}

}  // namespace voledit
