#pragma once
// A chain of bones that inverse kinematics turns. Of use to ik.cpp only.

#include <optional>
#include <vector>

#include "core/skeleton/ik.h"

namespace voledit {

/// Joints 0 … bones(), each the parent of the next; all but the last turn, within their limits. Positions are in
/// skeleton space. A value: copies are tried against each other.
class IkChain {
public:
    /// `joints`: at least two, the topmost first.
    IkChain(const Skeleton& skeleton, const Pose& pose, const std::vector<int>& joints);

    int bones() const { return int(positions_.size()) - 1; }
    const Vec3& at(int joint) const { return positions_[std::size_t(joint)]; }
    const Vec3& end() const { return positions_.back(); }
    double length() const;  // of all bones together
    bool hasLimits() const;
    void ignoreLimits();

    /// Turns a joint by a rotation in skeleton space, as far as its limits let it.
    void turn(int joint, const Quat& rotation);
    /// Turns a joint so that the end comes as near to the target as that joint can bring it: all at once where it is
    /// free, else one of its three angles after the other, each to the best within its limits. No farther than it was.
    void pull(int joint, const Vec3& target);
    /// One step of damped least squares in all angles at once, `damping` relative to the chain's length; angles stop at
    /// their limits. May lead away where the damping is too small.
    void stepTowards(const Vec3& target, double damping);
    /// Takes another chain's rotations, as far as the limits let it.
    void takeRotations(const IkChain& other);
    bool sameRotations(const IkChain& other) const { return rotate_ == other.rotate_; }
    /// Every limited joint to a place within its limits: the middles for n = 0, then others, spread evenly.
    void toSpreadPose(int n);
    /// Where all bones lie along one line with the target, descent cannot bend them: gives them a small bend, towards
    /// the pole, or the middles of the limits. Changes nothing otherwise.
    void loosen(const Vec3& target, const std::optional<Vec3>& pole);

    /// Whether joint k parts the chain into two pieces of some length.
    bool canBend(int k) const;
    /// Brings the end to the target, or as near as it comes, by turning joints 0 and k alone, as if the bones above and
    /// below k were one each: the law of cosines. The bend goes towards the pole; without one, where it is now, or at
    /// rest. The axis of the bend stays as it is in the limb. Limits are not minded.
    void bend(int k, const Vec3& target, const std::optional<Vec3>& pole);
    /// Turns the chain about the line from its first joint to its end so that joint k lies towards the pole.
    void swivel(int k, const Vec3& pole);

    void store(Pose& pose) const;

private:
    void pullAngle(int joint, int axis, const Vec3& target);
    Vec3 axisOf(int joint, int axis) const;  // that an angle turns about, skeleton space
    void place(std::size_t from);            // positions and rotations of the joints after `from`, and its own rotation
    Vec3 bendDirection(int k, const Vec3& direction, const std::optional<Vec3>& pole) const;
    Quat& local(int joint) { return rotate_[std::size_t(joint)]; }

    std::vector<int> joints_;
    std::vector<Vec3> restPositions_, boneVectors_;  // bone from the joint before, in its axes
    std::vector<std::optional<JointLimits>> limits_;
    std::vector<Quat> rotate_;  // local
    Quat parent_{1, 0, 0, 0};   // global rotation of the first joint's parent
    std::vector<Quat> turned_;  // global
    std::vector<Vec3> positions_;
};

}  // namespace voledit
