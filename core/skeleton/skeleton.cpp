#include "core/skeleton/skeleton.h"

#include <cassert>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <unordered_map>

#include "core/base/error.h"

namespace voledit {
namespace {

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void validate(const Joint& joint) {
    const std::string where = "joint '" + joint.name + "'";
    if (!finite(joint.at)) throw Error(where, "its position is not finite", "give three finite numbers");
    if (!joint.limits) return;
    const JointLimits& limits = *joint.limits;
    for (int a = 0; a < 3; ++a)
        if (!(limits.min[a] <= limits.max[a]))
            throw Error(where, "its limits about " + std::string(1, "xyz"[a]) + " leave no angle",
                        "give a min that is at most max, in degrees");
}

/// Index of each name. Throws for names that are empty or stand twice.
std::unordered_map<std::string, int> indexOfNames(const std::vector<Joint>& joints) {
    std::unordered_map<std::string, int> indices;
    indices.reserve(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const std::string& name = joints[j].name;
        if (name.empty())
            throw Error("joint " + std::to_string(j), "it has no name", "give each joint a name of its own");
        if (!indices.emplace(name, int(j)).second)
            throw Error("joint '" + name + "'", "its name is given twice", "give each joint a name of its own");
    }
    return indices;
}

/// The parents' indices. Throws for those that are missing.
std::vector<int> parentIndices(const std::vector<Joint>& joints, const std::vector<std::string>& parents) {
    const auto indices = indexOfNames(joints);
    std::vector<int> result(joints.size(), Joint::kNoParent);
    for (std::size_t j = 0; j < joints.size(); ++j) {
        if (parents[j].empty()) continue;
        const auto found = indices.find(parents[j]);
        if (found == indices.end())
            throw Error("joint '" + joints[j].name + "'", "its parent '" + parents[j] + "' is missing",
                        "name a joint of the same skeleton, or null for a root");
        result[j] = found->second;
    }
    return result;
}

/// All joints, ancestors that stand too late moved before their first descendant. Throws for circles.
std::vector<int> parentsFirst(const std::vector<Joint>& joints, const std::vector<int>& parents) {
    enum class State : std::uint8_t { Waiting, Visiting, Placed };
    std::vector<State> state(joints.size(), State::Waiting);
    std::vector<int> order, above;
    order.reserve(joints.size());
    for (std::size_t first = 0; first < joints.size(); ++first) {
        int j = int(first);
        while (j != Joint::kNoParent && state[std::size_t(j)] == State::Waiting) {
            state[std::size_t(j)] = State::Visiting;
            above.push_back(j);
            j = parents[std::size_t(j)];
        }
        if (j != Joint::kNoParent && state[std::size_t(j)] == State::Visiting)
            throw Error("joint '" + joints[std::size_t(j)].name + "'",
                        "it is its own ancestor: the parents run in a circle",
                        "let one joint of the circle have another parent, or null");
        for (; !above.empty(); above.pop_back()) {
            order.push_back(above.back());
            state[std::size_t(above.back())] = State::Placed;
        }
    }
    return order;
}

}  // namespace

int Skeleton::find(const std::string& name) const {
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (joints[j].name == name) return int(j);
    return -1;
}

std::vector<int> Skeleton::childrenOf(int joint) const {
    std::vector<int> children;
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (joints[j].parent == joint) children.push_back(int(j));
    return children;
}

Skeleton makeSkeleton(std::vector<Joint> joints, const std::vector<std::string>& parents) {
    assert(joints.size() == parents.size());
    if (joints.size() > kMostJoints)
        throw Error("skeleton", std::to_string(joints.size()) + " joints are too many",
                    "use at most " + std::to_string(kMostJoints));
    for (const Joint& joint : joints) validate(joint);
    const std::vector<int> parentOf = parentIndices(joints, parents);
    const std::vector<int> order = parentsFirst(joints, parentOf);
    std::vector<int> placeOf(joints.size());
    for (std::size_t n = 0; n < order.size(); ++n) placeOf[std::size_t(order[n])] = int(n);
    Skeleton skeleton;
    skeleton.joints.reserve(joints.size());
    for (const int j : order) {
        Joint joint = std::move(joints[std::size_t(j)]);
        const int parent = parentOf[std::size_t(j)];
        joint.parent = parent == Joint::kNoParent ? Joint::kNoParent : placeOf[std::size_t(parent)];
        skeleton.joints.push_back(std::move(joint));
    }
    return skeleton;
}

Pose restPose(const Skeleton& skeleton) {
    return {std::vector<Quat>(skeleton.joints.size(), Quat(1, 0, 0, 0)),
            std::vector<Vec3>(skeleton.joints.size(), Vec3(0))};
}

std::vector<PosedJoint> posedJoints(const Skeleton& skeleton, const Pose& pose) {
    const std::size_t count = skeleton.joints.size();
    assert(pose.rotate.size() == count && pose.translate.size() == count);
    std::vector<PosedJoint> posed(count);
    std::vector<Quat> turned(count);
    // Displacements from rest, so that the rest pose is where the joints are to the bit.
    std::vector<Vec3> moved(count);
    for (std::size_t j = 0; j < count; ++j) {
        const Joint& joint = skeleton.joints[j];
        if (joint.parent == Joint::kNoParent) {
            turned[j] = pose.rotate[j];
            moved[j] = pose.translate[j];
        } else {
            const std::size_t parent = std::size_t(joint.parent);
            assert(parent < j);
            const Vec3 bone = joint.at - skeleton.joints[parent].at;
            turned[j] = turned[parent] * pose.rotate[j];
            moved[j] =
                moved[parent] + (posed[parent].linear - Mat3(1)) * bone + posed[parent].linear * pose.translate[j];
        }
        posed[j] = {glm::mat3_cast(turned[j]), joint.at + moved[j]};
    }
    return posed;
}

std::vector<PosedJoint> laidInto(const std::vector<PosedJoint>& joints, const Mat4& objectFromSkeleton) {
    const Mat3 linear(objectFromSkeleton), inverse = glm::inverse(linear);
    std::vector<PosedJoint> laid;
    laid.reserve(joints.size());
    // The difference from the identity, so that an unturned joint stays unturned to the bit.
    for (const PosedJoint& joint : joints)
        laid.push_back({Mat3(1) + linear * (joint.linear - Mat3(1)) * inverse,
                        linear * joint.position + Vec3(objectFromSkeleton[3])});
    return laid;
}

Skeleton laidInto(const Skeleton& skeleton, const Mat4& objectFromSkeleton) {
    Skeleton laid = skeleton;
    const Mat3 linear(objectFromSkeleton);
    for (Joint& joint : laid.joints) joint.at = linear * joint.at + Vec3(objectFromSkeleton[3]);
    return laid;
}

Pose interpolated(const Pose& a, const Pose& b, double s) {
    assert(a.rotate.size() == b.rotate.size() && a.translate.size() == b.translate.size());
    Pose pose;
    pose.rotate.reserve(a.rotate.size());
    pose.translate.reserve(a.translate.size());
    for (std::size_t j = 0; j < a.rotate.size(); ++j) pose.rotate.push_back(slerped(a.rotate[j], b.rotate[j], s));
    for (std::size_t j = 0; j < a.translate.size(); ++j)
        pose.translate.push_back(s == 1 ? b.translate[j] : a.translate[j] + s * (b.translate[j] - a.translate[j]));
    return pose;
}

}  // namespace voledit
