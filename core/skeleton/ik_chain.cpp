#include "core/skeleton/ik_chain.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/skeleton/joint_limits.h"

namespace voledit {
namespace {

/// Parts of a bone's length below which what lies across it is rounding, not a bend.
constexpr double kStraight = 1e-7;

/// The part of v across a unit direction; nullopt where it is less than `least`.
std::optional<Vec3> across(const Vec3& v, const Vec3& direction, double least) {
    const Vec3 part = v - direction * glm::dot(v, direction);
    const double length = glm::length(part);
    if (!(length > least)) return std::nullopt;
    return part / length;
}

Vec3 anyAcross(const Vec3& direction) {
    const Vec3 size = glm::abs(direction);
    Vec3 axis(0);
    axis[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
    return glm::normalize(axis - direction * glm::dot(axis, direction));
}

/// The rotation that carries one pair of unit vectors at right angles to another.
Quat carrying(const Vec3& a, const Vec3& b, const Vec3& toA, const Vec3& toB) {
    return glm::normalize(
        glm::quat_cast(Mat3(toA, toB, glm::cross(toA, toB)) * glm::transpose(Mat3(a, b, glm::cross(a, b)))));
}

}  // namespace

IkChain::IkChain(const Skeleton& skeleton, const Pose& pose, const std::vector<int>& joints) : joints_(joints) {
    const std::vector<PosedJoint> posed = posedJoints(skeleton, pose);
    for (int j = skeleton.joints[std::size_t(joints.front())].parent; j != Joint::kNoParent;
         j = skeleton.joints[std::size_t(j)].parent)
        parent_ = pose.rotate[std::size_t(j)] * parent_;
    for (std::size_t n = 0; n < joints.size(); ++n) {
        const std::size_t j = std::size_t(joints[n]);
        const Joint& joint = skeleton.joints[j];
        restPositions_.push_back(joint.at);
        boneVectors_.push_back(n == 0 ? Vec3(0)
                                      : joint.at - skeleton.joints[std::size_t(joint.parent)].at + pose.translate[j]);
        limits_.push_back(n + 1 < joints.size() ? joint.limits : std::nullopt);
        rotate_.push_back(pose.rotate[j]);
    }
    turned_.resize(joints.size(), Quat(1, 0, 0, 0));
    positions_.resize(joints.size(), posed[std::size_t(joints.front())].position);
    place(0);
}

void IkChain::place(std::size_t from) {
    for (std::size_t n = from; n < joints_.size(); ++n) {
        turned_[n] = glm::normalize((n == 0 ? parent_ : turned_[n - 1]) * rotate_[n]);
        if (n > 0 && n > from) positions_[n] = positions_[n - 1] + turned_[n - 1] * boneVectors_[n];
    }
}

double IkChain::length() const {
    double sum = 0;
    for (const Vec3& bone : boneVectors_) sum += glm::length(bone);
    return sum;
}

bool IkChain::hasLimits() const {
    return std::any_of(limits_.begin(), limits_.end(), [](const auto& limits) { return limits.has_value(); });
}

void IkChain::ignoreLimits() {
    limits_.assign(limits_.size(), std::nullopt);
}

void IkChain::turn(int joint, const Quat& rotation) {
    const std::size_t n = std::size_t(joint);
    const Quat above = n == 0 ? parent_ : turned_[n - 1];
    rotate_[n] = glm::normalize(glm::conjugate(above) * rotation * above * rotate_[n]);
    if (limits_[n]) rotate_[n] = limited(rotate_[n], *limits_[n]);
    place(n);
}

void IkChain::pull(int joint, const Vec3& target) {
    // A joint at the end or at the target has no direction to turn to.
    const double least = 1e-12 * length();
    const Vec3 reach = end() - at(joint), wanted = target - at(joint);
    if (!(glm::length(reach) > least && glm::length(wanted) > least)) return;
    if (!limits_[std::size_t(joint)]) return turn(joint, shortestArc(reach, wanted));
    for (int axis = 0; axis < 3; ++axis) pullAngle(joint, axis, target);
}

Vec3 IkChain::axisOf(int joint, int axis) const {
    const std::size_t n = std::size_t(joint);
    Vec3 about(0);
    about[axis] = 1;
    if (!limits_[n]) return about;
    // As the angles applied after it have turned it.
    Vec3 outer = degreesWithin(rotate_[n], *limits_[n]);
    for (int inner = 0; inner <= axis; ++inner) outer[inner] = 0;
    return (n == 0 ? parent_ : turned_[n - 1]) * (quatOfDegrees(outer) * about);
}

void IkChain::pullAngle(int joint, int axis, const Vec3& target) {
    const std::size_t n = std::size_t(joint);
    const JointLimits& limits = *limits_[n];
    const Vec3 about = axisOf(joint, axis);
    const double least = 1e-12 * length();
    const auto reach = across(end() - at(joint), about, least), wanted = across(target - at(joint), about, least);
    if (!reach || !wanted) return;
    // The distance falls the more the nearer the angle comes to this one, either way round.
    const double turn = std::atan2(glm::dot(glm::cross(*reach, *wanted), about), glm::dot(*reach, *wanted));
    Vec3 degrees = degreesWithin(rotate_[n], limits);
    degrees[axis] = clampedAngle(degrees[axis] + turn * (180 / kPi), limits.min[axis], limits.max[axis]);
    rotate_[n] = quatOfDegrees(degrees);
    place(n);
}

void IkChain::stepTowards(const Vec3& target, double damping) {
    const Vec3 error = target - end();
    const double scale = length();
    std::vector<Vec3> columns(3 * std::size_t(bones()));  // how far the end goes for a radian of each angle
    for (int n = 0; n < bones(); ++n)
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3 column = glm::cross(axisOf(n, axis), end() - at(n));
            const auto& limits = limits_[std::size_t(n)];
            // An angle at its limit is out of the game where the error would push it on.
            if (limits) {
                const double degrees = degreesWithin(rotate_[std::size_t(n)], *limits)[axis];
                const double pushed = degrees + 1e-6 * (glm::dot(column, error) > 0 ? 1 : -1);
                if (pushed < limits->min[axis] || pushed > limits->max[axis]) continue;
            }
            columns[3 * std::size_t(n) + std::size_t(axis)] = column;
        }
    Mat3 normal(damping * scale * scale);
    for (const Vec3& column : columns) normal += glm::outerProduct(column, column);
    const Vec3 weighted = glm::inverse(normal) * error;
    const IkChain before = *this;
    for (int n = 0; n < bones(); ++n) {
        const std::size_t j = std::size_t(n);
        Vec3 turn;
        for (int axis = 0; axis < 3; ++axis) turn[axis] = glm::dot(columns[3 * j + std::size_t(axis)], weighted);
        if (limits_[j]) {
            const Vec3 degrees = degreesWithin(rotate_[j], *limits_[j]) + turn * (180 / kPi);
            rotate_[j] = quatOfDegrees(glm::clamp(degrees, limits_[j]->min, limits_[j]->max));
        } else if (const double angle = glm::length(turn); angle > 0) {
            const Quat above = n == 0 ? parent_ : before.turned_[j - 1];
            rotate_[j] =
                glm::normalize(glm::conjugate(above) * glm::angleAxis(angle, turn / angle) * above * rotate_[j]);
        }
    }
    place(0);
}

void IkChain::takeRotations(const IkChain& other) {
    for (std::size_t n = 0; n < rotate_.size(); ++n)
        rotate_[n] = limits_[n] ? limited(other.rotate_[n], *limits_[n]) : other.rotate_[n];
    place(0);
}

void IkChain::toSpreadPose(int n) {
    // Additive recurrence by the generalised golden ratio of three dimensions, another offset for each joint.
    const Vec3 step(0.8191725133961645, 0.6710436067037893, 0.5497004779019703);
    for (std::size_t j = 0; j < rotate_.size(); ++j)
        if (limits_[j]) {
            const Vec3 part = glm::fract(0.5 + double(n) * (1 + double(j)) * step);
            rotate_[j] = quatOfDegrees(limits_[j]->min + part * (limits_[j]->max - limits_[j]->min));
        }
    place(0);
}

void IkChain::loosen(const Vec3& target, const std::optional<Vec3>& pole) {
    const double least = 1e-6 * length();
    const Vec3 reach = glm::length(target - at(0)) > least ? target - at(0) : end() - at(0);
    if (!(glm::length(reach) > least)) return;
    const Vec3 direction = glm::normalize(reach);
    for (const Vec3& position : positions_)
        if (across(position - at(0), direction, least)) return;
    const Vec3 towards = bendDirection(std::max(1, bones() / 2), direction, pole);
    constexpr double kBend = 0.2;  // radians
    turn(0, glm::angleAxis(kBend, glm::cross(direction, towards)));
    for (int n = 1; n < bones(); ++n) {
        turn(n, glm::angleAxis(-2 * kBend / bones(), glm::cross(direction, towards)));
        // Limits may leave another way to bend than the one tried.
        if (const auto& limits = limits_[std::size_t(n)])
            local(n) = slerped(local(n), limited(quatOfDegrees(0.5 * (limits->min + limits->max)), *limits), 0.1);
    }
    place(0);
}

bool IkChain::canBend(int k) const {
    const double least = 1e-12 * length();
    return glm::length(at(k) - at(0)) > least && glm::length(end() - at(k)) > least;
}

Vec3 IkChain::bendDirection(int k, const Vec3& direction, const std::optional<Vec3>& pole) const {
    const double least = kStraight * length();
    if (pole)
        if (const auto towards = across(*pole - at(0), direction, least)) return *towards;
    // What lies across the line from the first joint to the end, carried along as that turns to the direction.
    const auto carried = [&](const Vec3& elbow, const Vec3& tip, const Quat& turned) -> std::optional<Vec3> {
        const double size = glm::length(tip);
        if (!(size > least)) return across(turned * elbow, direction, least);
        const auto out = across(elbow, tip / size, least);
        if (!out) return std::nullopt;
        return across(shortestArc(turned * tip, direction) * (turned * *out), direction, 0.5);
    };
    if (const auto now = carried(at(k) - at(0), end() - at(0), Quat(1, 0, 0, 0))) return *now;
    const Vec3& first = restPositions_.front();
    const auto atRest = carried(restPositions_[std::size_t(k)] - first, restPositions_.back() - first, turned_.front());
    return atRest ? *atRest : anyAcross(direction);
}

void IkChain::bend(int k, const Vec3& target, const std::optional<Vec3>& pole) {
    const Vec3 root = at(0), upper = at(k) - root, lower = end() - at(k);
    const double a = glm::length(upper), b = glm::length(lower), least = 1e-12 * (a + b);
    const auto directionTo = [&](const Vec3& point) { return glm::normalize(point - root); };
    const double wanted = glm::length(target - root);
    const Vec3 direction = wanted > least                      ? directionTo(target)
                           : glm::length(end() - root) > least ? directionTo(end())
                                                               : upper / a;
    const double distance = std::clamp(wanted, std::abs(a - b), a + b);
    const Vec3 out = bendDirection(k, direction, pole);
    const double cosine =
        distance > least ? std::clamp((distance / a + (a - b) / distance * ((a + b) / a)) / 2, -1.0, 1.0) : 0;
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const Vec3 elbow = root + a * (cosine * direction + sine * out), tip = root + distance * direction;
    const Vec3 newUpper = glm::normalize(elbow - root), normal = glm::normalize(glm::cross(out, direction));
    // The axis of the elbow goes with the limb, so that a knee stays a hinge; a straight limb has none.
    const auto hinge = across(glm::cross(upper, lower) / (a * b), upper / a, kStraight);
    turn(0, hinge ? carrying(upper / a, *hinge, newUpper, normal) : shortestArc(upper, newUpper));
    const Vec3 from = end() - at(k), to = tip - at(k);
    if (!(glm::length(to) > 0)) return;
    const double angle = std::atan2(glm::dot(glm::cross(from, to), normal), glm::dot(from, to));
    turn(k, glm::angleAxis(angle, normal));
    turn(k, shortestArc(end() - at(k), to));
}

void IkChain::swivel(int k, const Vec3& pole) {
    const Vec3 reach = end() - at(0);
    const double least = kStraight * length();
    if (!(glm::length(reach) > least)) return;
    const Vec3 axis = glm::normalize(reach);
    const auto now = across(at(k) - at(0), axis, least), wanted = across(pole - at(0), axis, least);
    if (!now || !wanted) return;
    turn(0, glm::angleAxis(std::atan2(glm::dot(glm::cross(*now, *wanted), axis), glm::dot(*now, *wanted)), axis));
}

void IkChain::store(Pose& pose) const {
    for (std::size_t n = 0; n + 1 < joints_.size(); ++n) pose.rotate[std::size_t(joints_[n])] = rotate_[n];
}

}  // namespace voledit
