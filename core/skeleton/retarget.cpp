// Motions on other skeletons than their own.

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <unordered_map>

#include "core/base/error.h"
#include "core/skeleton/best_rotation.h"
#include "core/skeleton/body_parts.h"
#include "core/skeleton/motion.h"

namespace voledit {

namespace {

constexpr int kNone = -1;

/// Global rotations of a pose's joints.
std::vector<Quat> globalRotations(const Skeleton& skeleton, const Pose& pose) {
    std::vector<Quat> global = pose.rotate;
    for (std::size_t j = 0; j < global.size(); ++j)
        if (const int parent = skeleton.joints[j].parent; parent != Joint::kNoParent)
            global[j] = global[std::size_t(parent)] * global[j];
    return global;
}

/// A skeleton, a motion's own, and which joints are driven.
struct Pairing {
    const Skeleton& skeleton;
    Skeleton source;             // of the motion
    std::vector<int> driver;     // of each joint of the skeleton: the motion's joint; kNone
    std::vector<int> above;      // the nearest driven joint above; kNone
    std::vector<int> below;      // how many driven joints are below with none between
    std::vector<int> onlyBelow;  // the one such; kNone where there is none or several
    std::vector<int> driven;     // joints of the skeleton, ascending
    std::vector<bool> endSite;   // of the motion's joints

    Pairing(const Skeleton& target, const Motion& motion, const std::map<std::string, std::string>& joints)
        : skeleton(target), source(skeletonOf(motion)) {
        for (const MotionJoint& joint : motion.joints) endSite.push_back(joint.endSite);
        std::unordered_map<std::string, int> index;
        for (std::size_t m = 0; m < source.joints.size(); ++m) index.emplace(source.joints[m].name, int(m));
        const std::size_t count = target.joints.size();
        driver.assign(count, kNone);
        above.assign(count, kNone);
        onlyBelow.assign(count, kNone);
        below.assign(count, 0);
        for (std::size_t j = 0; j < count; ++j) {
            const auto named = joints.find(target.joints[j].name);
            const auto found = named == joints.end() ? index.end() : index.find(named->second);
            if (found != index.end()) driver[j] = found->second;
            if (const int parent = target.joints[j].parent; parent != Joint::kNoParent)
                above[j] = driver[std::size_t(parent)] != kNone ? parent : above[std::size_t(parent)];
            if (driver[j] == kNone) continue;
            driven.push_back(int(j));
            if (above[j] != kNone)
                onlyBelow[std::size_t(above[j])] = ++below[std::size_t(above[j])] == 1 ? int(j) : kNone;
        }
    }

    /// Rest places of the driven joints, and those of their drivers at `posed`.
    std::vector<Vec3> ownPlaces() const {
        std::vector<Vec3> places;
        for (const int j : driven) places.push_back(skeleton.joints[std::size_t(j)].at);
        return places;
    }
    std::vector<Vec3> driverPlaces(const std::vector<PosedJoint>& posed) const {
        std::vector<Vec3> places;
        for (const int j : driven) places.push_back(posed[std::size_t(driver[std::size_t(j)])].position);
        return places;
    }
    bool sourceIsBelow(int m, int ancestor) const {
        while (m > ancestor) m = source.joints[std::size_t(m)].parent;
        return m == ancestor;
    }
};

/// The pose of the motion that is compared with the skeleton's rest, and how they lie to each other.
struct Reference {
    std::vector<PosedJoint> places;  // of the motion's joints
    std::vector<Quat> rotations;     // global
    Quat aligned{1, 0, 0, 0};        // turns that body upon the skeleton's
    double likeness = 0;
    bool isRest = false;
};

Reference referenceOf(const Pairing& pairing, const Pose& pose) {
    Reference reference;
    reference.places = posedJoints(pairing.source, pose);
    reference.rotations = globalRotations(pairing.source, pose);
    const BestRotation best = bestRotation(pairing.driverPlaces(reference.places), pairing.ownPlaces());
    reference.aligned = best.rotation;
    reference.likeness = best.likeness;
    return reference;
}

Vec3 axisVector(int axis, double sign) {
    Vec3 v(0);
    v[axis] = sign;
    return v;
}

/// Angle of a rotation, radians.
double turnOf(const Quat& rotation) {
    return 2 * std::atan2(glm::length(Vec3(rotation.x, rotation.y, rotation.z)), std::abs(rotation.w));
}

/// The rotation itself or, where it is nearly one of the 24 that carry axes to axes, that one: rest poses are seldom
/// quite symmetric, and a motion should not lean for it.
Quat straightened(const Quat& rotation) {
    constexpr double nearly = 25 * kPi / 180;
    const Mat3 m = glm::mat3_cast(rotation);
    Mat3 straight(0.0);
    for (int c = 0; c < 3; ++c) {
        int largest = 0;
        for (int r = 1; r < 3; ++r)
            if (std::abs(m[c][r]) > std::abs(m[c][largest])) largest = r;
        straight[c][largest] = m[c][largest] < 0 ? -1 : 1;
    }
    if (std::abs(glm::determinant(straight) - 1) > 0.5) return rotation;
    const Quat found = glm::normalize(glm::quat_cast(straight));
    return turnOf(glm::conjugate(found) * rotation) < nearly ? found : rotation;
}

/// The motion's rest pose. In some files it is no posture at all, but all bones along one axis: then the frame, among a
/// few, in which the body stands most like the skeleton's.
Reference chosenReference(const Pairing& pairing, const Motion& motion) {
    constexpr double alike = 0.8, better = 0.05;
    constexpr std::size_t looks = 32;
    Reference rest = referenceOf(pairing, restPose(pairing.source));
    rest.isRest = true;
    if (rest.likeness >= alike || motion.frames == 0) return rest;
    Reference best = rest;
    best.likeness += better;
    const std::size_t step = std::max<std::size_t>(1, motion.frames / looks);
    for (std::size_t frame = 0; frame < motion.frames; frame += step) {
        Reference reference = referenceOf(pairing, poseOfFrame(motion, frame));
        if (reference.likeness > best.likeness) best = std::move(reference);
    }
    return best.likeness > rest.likeness + better ? best : rest;
}

/// The parts of a similarity: x ↦ scale·rotation(x) + …, the scale below 0 where it mirrors.
struct Similarity {
    Quat rotation{1, 0, 0, 0};
    double scale = 1;
};

Similarity similarityOf(const Mat4& matrix) {
    const Mat3 linear(matrix);
    const double determinant = glm::determinant(linear);
    if (!std::isfinite(determinant) || determinant == 0)
        throw Error("the motion's place", "its matrix has no inverse", "give a scale other than 0 and finite numbers");
    const double scale = std::cbrt(determinant);
    const Vec3 x = glm::normalize(linear[0] / scale);
    const Vec3 z = glm::normalize(glm::cross(x, linear[1] / scale));
    return {glm::normalize(glm::quat_cast(Mat3(x, glm::cross(z, x), z))), scale};
}

/// The turn from the motion's axes to the skeleton's: its up to the skeleton's up, its left to the skeleton's left.
Quat uprightTurn(const Skeleton& skeleton, const Quat& aligned) {
    const UpAxis up = upOf(skeleton);
    const Vec3 ownUp = axisVector(up.axis, up.sign);
    const Vec3 theirUp = glm::conjugate(aligned) * ownUp;
    int axis = 0;
    for (int a = 1; a < 3; ++a)
        if (std::abs(theirUp[a]) > std::abs(theirUp[axis])) axis = a;
    const Vec3 straight = axisVector(axis, theirUp[axis] < 0 ? -1 : 1);
    return straightened(glm::normalize(shortestArc(aligned * straight, ownUp) * aligned));
}

/// Parts that every rest pose holds alike: upright, or flat on the ground. Where their bones point differently there,
/// rigs only disagree about where in the flesh the joints lie (a collar begins at the neck or in the chest).
bool isHeldAlike(BodyPart part) {
    switch (part) {
        case BodyPart::Hips:
        case BodyPart::Spine:
        case BodyPart::Neck:
        case BodyPart::Head:
        case BodyPart::Collar:
        case BodyPart::Foot:
        case BodyPart::Toe:
            return true;
        default:
            return false;
    }
}

class Retargeting {
public:
    Retargeting(const Skeleton& skeleton, const Motion& motion, const MotionMap& map)
        : pairing_(skeleton, motion, map.joints),
          map_(map),
          similarity_(similarityOf(map.skeletonFromMotion)),
          turn_(similarity_.rotation),
          reference_(chosenReference(pairing_, motion)),
          roles_(bodyRoles(skeleton)) {
        const Quat body = bodyAtReference();
        correction_.assign(skeleton.joints.size(), Quat(1, 0, 0, 0));
        for (const int j : pairing_.driven)
            correction_[std::size_t(j)] = glm::conjugate(carried(reference_.rotations, j)) * boneTurn(j, body) * body;
    }

    Pose pose(const Pose& of) const {
        const Skeleton& skeleton = pairing_.skeleton;
        const std::vector<PosedJoint> places = posedJoints(pairing_.source, of);
        const std::vector<Quat> rotations = globalRotations(pairing_.source, of);
        Pose pose = restPose(skeleton);
        std::vector<Quat> global = pose.rotate;
        for (std::size_t j = 0; j < global.size(); ++j) {
            const int parent = skeleton.joints[j].parent;
            const Quat base = parent == Joint::kNoParent ? Quat(1, 0, 0, 0) : global[std::size_t(parent)];
            if (pairing_.driver[j] == kNone) {
                global[j] = base;
                continue;
            }
            global[j] = carried(rotations, int(j)) * correction_[j];
            pose.rotate[j] = glm::normalize(glm::conjugate(base) * global[j]);
            if (isTopmost(int(j)))
                pose.translate[j] = rootMove(int(j), places);
            else
                pose.translate[j] = glm::conjugate(base) * jointMove(int(j), of, rotations);
        }
        return pose;
    }

    /// The first driven joint with none above.
    int root() const { return pairing_.driven.empty() ? kNone : pairing_.driven.front(); }

private:
    /// How the motion's body stands in the skeleton's space at the reference, from the skeleton's rest.
    Quat bodyAtReference() const {
        const Quat exact = turn_ * glm::conjugate(reference_.aligned);
        constexpr double same = 1e-3;
        if (!reference_.isRest || turnOf(exact) < same) return exact;
        return turn_ * glm::conjugate(uprightTurn(pairing_.skeleton, reference_.aligned));
    }

    const Joint& joint(int j) const { return pairing_.skeleton.joints[std::size_t(j)]; }
    int driver(int j) const { return pairing_.driver[std::size_t(j)]; }

    /// The driver's rotation, in the skeleton's axes.
    Quat carried(const std::vector<Quat>& rotations, int j) const {
        return turn_ * rotations[std::size_t(driver(j))] * glm::conjugate(turn_);
    }
    Vec3 carried(const Vec3& v) const { return similarity_.scale * (turn_ * v); }

    /// Turns the skeleton's rest bone, standing as the body does, to where the motion's points at the reference.
    Quat boneTurn(int j, const Quat& body) const {
        while (!hasBone(j)) {
            // A rest pose says how a hand or a head is held; where there is none, it is held as the bone above.
            const bool isHub = pairing_.below[std::size_t(j)] > 1;
            if (reference_.isRest || isHub || pairing_.above[std::size_t(j)] == kNone) return {1, 0, 0, 0};
            j = pairing_.above[std::size_t(j)];
        }
        const int end = pairing_.onlyBelow[std::size_t(j)];
        const Vec3 own = body * (joint(end).at - joint(j).at);
        const Vec3 theirs = carried(reference_.places[std::size_t(driver(end))].position -
                                    reference_.places[std::size_t(driver(j))].position);
        if (!(glm::length(own) > 0) || !(glm::length(theirs) > 0)) return {1, 0, 0, 0};
        return shortestArc(own, theirs);
    }

    /// Whether the bone's direction is to be the motion's.
    bool hasBone(int j) const {
        const int end = pairing_.onlyBelow[std::size_t(j)];
        if (end == kNone || !pairing_.sourceIsBelow(driver(end), driver(j))) return false;
        if (reference_.isRest && isHeldAlike(roles_[std::size_t(j)].part)) return false;
        // Where a file's rest pose is no posture, its end sites are no ends: nothing was ever measured there.
        return reference_.isRest || !pairing_.endSite[std::size_t(driver(end))];
    }

    /// Whether `j` carries its tree with it: no driven joint above it, nor another such in its tree.
    bool isTopmost(int j) const {
        if (pairing_.above[std::size_t(j)] != kNone) return false;
        return std::none_of(pairing_.driven.begin(), pairing_.driven.end(), [&](int k) {
            return k != j && pairing_.above[std::size_t(k)] == kNone && treeOf(k) == treeOf(j);
        });
    }
    int treeOf(int j) const {
        while (joint(j).parent != Joint::kNoParent) j = joint(j).parent;
        return j;
    }

    Vec3 rootMove(int j, const std::vector<PosedJoint>& places) const {
        const Vec3& x = places[std::size_t(driver(j))].position;
        // Joints above it are at rest: its own move is seen in the skeleton's axes.
        const Vec3 move = Vec3(map_.skeletonFromMotion * Vec4(x, 1)) - joint(j).at;
        return map_.inPlace ? axisVector(map_.up, move[map_.up]) : move;
    }

    /// What a joint below the root is moved by its position channels, skeleton axes: where the bone above it is the
    /// motion's own. Other skeletons keep the lengths of their bones.
    Vec3 jointMove(int j, const Pose& of, const std::vector<Quat>& rotations) const {
        const std::size_t m = std::size_t(driver(j));
        const Joint& source = pairing_.source.joints[m];
        if (of.translate[m] == Vec3(0) || joint(j).parent == Joint::kNoParent || source.parent == Joint::kNoParent)
            return Vec3(0);
        if (driver(joint(j).parent) != source.parent) return Vec3(0);
        const Vec3 own = joint(j).at - joint(joint(j).parent).at;
        const Vec3 theirs = carried(source.at - pairing_.source.joints[std::size_t(source.parent)].at);
        constexpr double equal = 1e-6;
        if (glm::length(own - theirs) > equal * (glm::length(own) + glm::length(theirs))) return Vec3(0);
        return carried(rotations[std::size_t(source.parent)] * of.translate[m]);
    }

    Pairing pairing_;
    const MotionMap& map_;
    Similarity similarity_;
    Quat turn_;
    Reference reference_;
    std::vector<BodyRole> roles_;   // of the skeleton's joints
    std::vector<Quat> correction_;  // N of each driven joint
};

/// Lengths of the legs where both skeletons have them by the pairing, else of all bones between paired joints.
double scaleBetween(const Pairing& pairing, const Reference& reference) {
    const std::vector<BodyRole> roles = bodyRoles(pairing.skeleton);
    double legs[2] = {0, 0}, all[2] = {0, 0};
    for (const int j : pairing.driven) {
        const int up = pairing.above[std::size_t(j)];
        if (up == kNone) continue;
        const auto place = [&](int k) {
            return reference.places[std::size_t(pairing.driver[std::size_t(k)])].position;
        };
        const double own =
            glm::length(pairing.skeleton.joints[std::size_t(j)].at - pairing.skeleton.joints[std::size_t(up)].at);
        const double theirs = glm::length(place(j) - place(up));
        all[0] += own, all[1] += theirs;
        const BodyPart part = roles[std::size_t(j)].part, from = roles[std::size_t(up)].part;
        if ((from != BodyPart::Thigh && from != BodyPart::Shin) || (part != BodyPart::Shin && part != BodyPart::Foot))
            continue;
        legs[0] += own, legs[1] += theirs;
    }
    const double* lengths = legs[0] > 0 && legs[1] > 0 ? legs : all;
    return lengths[0] > 0 && lengths[1] > 0 ? lengths[0] / lengths[1] : 1;
}

double lowest(const std::vector<PosedJoint>& posed, const std::vector<int>& joints, const UpAxis& up) {
    double low = kInfinity;
    for (const int j : joints) low = std::min(low, up.sign * posed[std::size_t(j)].position[up.axis]);
    return low;
}

}  // namespace

Pose retargeted(const Skeleton& skeleton, const Motion& motion, const MotionMap& map, double t) {
    return Retargeting(skeleton, motion, map).pose(poseAt(motion, t));
}

Mat4 proposedMotionFit(const Skeleton& skeleton, const Motion& motion,
                       const std::map<std::string, std::string>& joints) {
    const Pairing pairing(skeleton, motion, joints);
    if (pairing.driven.size() < 2)
        throw Error("motion", "fewer than two of its joints are mapped to the skeleton's",
                    "map more joints in the table of the motion");
    const Reference reference = chosenReference(pairing, motion);
    const double scale = scaleBetween(pairing, reference);
    MotionMap map;
    map.joints = joints;
    map.skeletonFromMotion = glm::scale(glm::mat4_cast(uprightTurn(skeleton, reference.aligned)), Vec3(scale));
    const Retargeting retargeting(skeleton, motion, map);
    const std::vector<PosedJoint> posed = posedJoints(skeleton, retargeting.pose(poseAt(motion, 0)));
    const std::vector<PosedJoint> rest = posedJoints(skeleton, restPose(skeleton));
    const UpAxis up = upOf(skeleton);
    const std::size_t root = std::size_t(retargeting.root());
    Vec3 move = rest[root].position - posed[root].position;
    move[up.axis] = up.sign * (lowest(rest, pairing.driven, up) - lowest(posed, pairing.driven, up));
    map.skeletonFromMotion[3] = Vec4(move, 1);
    return map.skeletonFromMotion;
}

}  // namespace voledit
