#include "core/skeleton/ik.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/base/error.h"
#include "core/skeleton/ik_chain.h"

namespace voledit {
namespace {

constexpr int kMostRounds = 200;
constexpr double kTolerance = 1e-6;  // of the chain's length

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The joints of the goal's chain, the topmost first.
std::vector<int> chainOf(const Skeleton& skeleton, const IkGoal& goal) {
    std::vector<int> joints{goal.joint};
    for (int n = 0; n < goal.chain; ++n) {
        const int parent = skeleton.joints[std::size_t(joints.back())].parent;
        if (parent == Joint::kNoParent) break;
        joints.push_back(parent);
    }
    std::reverse(joints.begin(), joints.end());
    return joints;
}

/// The same goal from afar: what lies a million lengths away is out of reach in the same direction, and its square is
/// still a number.
Vec3 withinSight(const Vec3& point, const IkChain& chain) {
    const Vec3 reach = point - chain.at(0);
    const double far = std::max({std::abs(reach.x), std::abs(reach.y), std::abs(reach.z)}),
                 limit = 1e6 * chain.length();
    return far > limit ? chain.at(0) + reach * (limit / far) : point;
}

double distanceTo(const IkChain& chain, const Vec3& target) {
    return glm::length(chain.end() - target);
}

/// Points every bone at the target.
void stretch(IkChain& chain, const Vec3& target) {
    for (int b = 0; b < chain.bones(); ++b) {
        const Vec3 bone = chain.at(b + 1) - chain.at(b), reach = target - chain.at(0);
        if (glm::length(bone) > 0 && glm::length(reach) > 0) chain.turn(b, shortestArc(bone, reach));
    }
}

/// Cyclic coordinate descent: each joint in turn, the last first, turns the end towards the target.
void descend(IkChain& chain, const Vec3& target) {
    const double length = chain.length();
    double before = distanceTo(chain, target);
    for (int round = 0; round < kMostRounds && before > kTolerance * length; ++round) {
        for (int b = chain.bones() - 1; b >= 0; --b) chain.pull(b, target);
        const double now = distanceTo(chain, target);
        if (std::abs(before - now) < 1e-14 * length) break;
        before = now;
    }
}

/// The joint where the chain, stiff above and below, reaches the target with the most to spare; -1 where nowhere.
int bestElbow(const IkChain& chain, const Vec3& target) {
    const double distance = glm::length(target - chain.at(0));
    int best = -1;
    double most = 0;
    for (int k = 1; k < chain.bones(); ++k) {
        const double above = glm::length(chain.at(k) - chain.at(0)), below = glm::length(chain.end() - chain.at(k));
        const double spare = std::min(above + below - distance, distance - std::abs(above - below));
        if (std::min(above, below) > 0 && spare >= most) {
            most = spare;
            best = k;
        }
    }
    return best;
}

/// Descent stops at a tolerance and is slow near the chain's full reach; bent at one joint in closed form, the chain
/// reaches the target to rounding. Straightened first where its present shape is too short for that.
void finish(IkChain& chain, const Vec3& target) {
    if (distanceTo(chain, target) == 0) return;
    int elbow = bestElbow(chain, target);
    if (elbow < 0 && distanceTo(chain, target) > kTolerance * chain.length()) {
        IkChain straight = chain;
        stretch(straight, target);
        elbow = bestElbow(straight, target);
        if (elbow >= 0) chain = straight;
    }
    if (elbow >= 0) chain.bend(elbow, target, std::nullopt);
}

void solveFree(IkChain& chain, const IkGoal& goal) {
    const double distance = glm::length(goal.target - chain.at(0));
    if (chain.bones() == 2 && chain.canBend(1)) return chain.bend(1, goal.target, goal.pole);
    if (distance >= chain.length() || chain.bones() == 1) return stretch(chain, goal.target);
    if (chain.bones() > 2) chain.loosen(goal.target, goal.pole);
    descend(chain, goal.target);
    finish(chain, goal.target);
    if (goal.pole && chain.bones() > 2) chain.swivel(chain.bones() / 2, *goal.pole);
}

/// Descent crawls where the limb is nearly straight; steps in all angles at once [Levenberg, Marquardt] end it.
void refine(IkChain& chain, const Vec3& target) {
    const double length = chain.length();
    double damping = 1e-3;
    for (int step = 0; step < 50 && distanceTo(chain, target) > 1e-12 * length; ++step) {
        IkChain tried = chain;
        tried.stepTowards(target, damping);
        const bool nearer = distanceTo(tried, target) < distanceTo(chain, target);
        if (nearer) chain = tried;
        damping *= nearer ? 0.1 : 10;
    }
}

/// Descent from the present pose may end in a corner of the limits; it comes another way from other poses within them.
/// What is reached from those must be clearly nearer, so that a dragged limb does not jump for little.
void solveLimited(IkChain& chain, const IkGoal& goal) {
    constexpr int kOtherStarts = 8;
    const double reached = kTolerance * chain.length(), clearly = 1e-3 * chain.length();
    IkChain free = chain;
    free.ignoreLimits();
    solveFree(free, goal);
    IkChain fromNow = chain;
    chain.takeRotations(free);
    if (chain.sameRotations(free)) return;
    descend(chain, goal.target);
    refine(chain, goal.target);
    for (int start = -1; start < kOtherStarts && distanceTo(chain, goal.target) > reached; ++start) {
        IkChain other = fromNow;
        if (start < 0)
            other.loosen(goal.target, goal.pole);
        else
            other.toSpreadPose(start);
        descend(other, goal.target);
        refine(other, goal.target);
        const double better = distanceTo(chain, goal.target) - distanceTo(other, goal.target);
        if (better > clearly || (better > 0 && distanceTo(other, goal.target) <= reached)) chain = other;
    }
}

}  // namespace

Pose solved(const Skeleton& skeleton, const Pose& pose, const IkGoal& goal) {
    if (goal.joint < 0 || std::size_t(goal.joint) >= skeleton.joints.size())
        throw Error("inverse kinematics", "joint " + std::to_string(goal.joint) + " does not exist",
                    "name a joint of the skeleton");
    if (!finite(goal.target) || (goal.pole && !finite(*goal.pole)))
        throw Error("inverse kinematics", "the target is not finite", "give finite numbers");
    const std::vector<int> joints = chainOf(skeleton, goal);
    if (joints.size() < 2) return pose;
    IkChain chain(skeleton, pose, joints);
    if (!(chain.length() > 0)) return pose;
    IkGoal seen = goal;
    seen.target = withinSight(goal.target, chain);
    if (goal.pole) seen.pole = withinSight(*goal.pole, chain);
    if (chain.hasLimits())
        solveLimited(chain, seen);
    else
        solveFree(chain, seen);
    Pose result = pose;
    chain.store(result);
    return result;
}

}  // namespace voledit
