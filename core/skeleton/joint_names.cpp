// Joints of two skeletons that mean the same.

#include <algorithm>
#include <set>

#include "core/skeleton/body_parts.h"
#include "core/skeleton/motion.h"

namespace voledit {

namespace {

class Matching {
public:
    Matching(const Skeleton& skeleton, const Skeleton& motion)
        : skeleton_(skeleton), motion_(motion), skeletonRoles_(bodyRoles(skeleton)), motionRoles_(bodyRoles(motion)) {}

    std::map<std::string, std::string> pairs() {
        std::set<BodyRole> roles(skeletonRoles_.begin(), skeletonRoles_.end());
        for (const BodyRole& role : roles)
            if (role.part != BodyPart::None) matchRole(role);
        for (const BodySide side : {BodySide::Left, BodySide::Right}) matchHandEnd(side);
        matchNames();
        return std::move(pairs_);
    }

private:
    const std::string& skeletonName(int j) const { return skeleton_.joints[std::size_t(j)].name; }
    const std::string& motionName(int j) const { return motion_.joints[std::size_t(j)].name; }

    bool isFree(int s) const { return !pairs_.contains(skeletonName(s)); }

    void pair(int s, int m) {
        if (!isFree(s) || !used_.insert(m).second) return;
        pairs_[skeletonName(s)] = motionName(m);
    }

    void matchRole(const BodyRole& role) {
        const auto own = jointsOf(skeletonRoles_, role), theirs = jointsOf(motionRoles_, role);
        if (theirs.empty()) return;
        const bool inOrder = role.part == BodyPart::Spine || role.part == BodyPart::Neck;
        const auto named = [&](int s) {
            return std::find_if(theirs.begin(), theirs.end(), [&](int m) { return motionName(m) == skeletonName(s); });
        };
        // Half of a spine by names and the other by order would cross.
        const bool allNamed = std::all_of(own.begin(), own.end(), [&](int s) { return named(s) != theirs.end(); });
        for (const int s : own)
            if (named(s) != theirs.end() && (allNamed || !inOrder)) pair(s, *named(s));
        if (allNamed) return;
        if (inOrder)
            matchEvenly(own, theirs);
        else if (role.part == BodyPart::ToeEnd)
            matchFirst(own, belowUsed(theirs, {BodyPart::Toe, role.side}));
        else
            matchFirst(own, middleChain(motion_, theirs));
    }

    /// Those of the joints that stand below one that is used in this role.
    std::vector<int> belowUsed(const std::vector<int>& joints, const BodyRole& role) const {
        std::vector<int> below;
        for (const int j : joints) {
            int up = motion_.joints[std::size_t(j)].parent;
            while (up != Joint::kNoParent && !(motionRoles_[std::size_t(up)] == role && used_.contains(up)))
                up = motion_.joints[std::size_t(up)].parent;
            if (up != Joint::kNoParent) below.push_back(j);
        }
        return below;
    }

    /// Of joints of one role those of one chain; where several stand side by side (toes, fingers), the one in their
    /// middle.
    static std::vector<int> middleChain(const Skeleton& skeleton, const std::vector<int>& joints) {
        const auto parentOf = [&](int j) { return skeleton.joints[std::size_t(j)].parent; };
        std::vector<int> firsts;
        for (const int j : joints)
            if (!std::binary_search(joints.begin(), joints.end(), parentOf(j))) firsts.push_back(j);
        Vec3 mean(0);
        for (const int j : firsts) mean += skeleton.joints[std::size_t(j)].at / double(firsts.size());
        const auto distance = [&](int j) { return glm::length(skeleton.joints[std::size_t(j)].at - mean); };
        const auto nearer = [&](int a, int b) { return distance(a) < distance(b); };
        std::vector<int> chain{*std::min_element(firsts.begin(), firsts.end(), nearer)};
        for (const int j : joints)
            if (parentOf(j) == chain.back()) chain.push_back(j);
        return chain;
    }

    /// First to first, last to last, the others spread between.
    void matchEvenly(const std::vector<int>& own, const std::vector<int>& theirs) {
        const std::size_t n = own.size(), m = theirs.size();
        const auto spread = [](std::size_t i, std::size_t from, std::size_t to) {
            return from < 2 ? 0 : (2 * i * (to - 1) + from - 1) / (2 * (from - 1));
        };
        for (std::size_t i = 0; i < std::min(n, m); ++i)
            pair(own[n <= m ? i : spread(i, m, n)], theirs[n <= m ? spread(i, n, m) : i]);
    }

    void matchFirst(const std::vector<int>& own, const std::vector<int>& theirs) {
        std::size_t next = 0;
        for (const int s : own) {
            if (!isFree(s)) continue;
            while (next < theirs.size() && used_.contains(theirs[next])) ++next;
            if (next == theirs.size()) return;
            pair(s, theirs[next]);
        }
    }

    /// Rigs with fingers have no end of the hand: what points along it is the middle finger.
    void matchHandEnd(BodySide side) {
        const auto own = jointsOf(skeletonRoles_, {BodyPart::HandEnd, side});
        if (own.empty() || !isFree(own.front())) return;
        for (const BodyPart part : {BodyPart::MiddleFinger, BodyPart::Fingers, BodyPart::Index, BodyPart::Ring}) {
            const auto theirs = jointsOf(motionRoles_, {part, side});
            if (theirs.empty()) continue;
            const int first = middleChain(motion_, theirs).front();
            if (!used_.contains(first)) return pair(own.front(), first);
        }
    }

    /// Joints that no body has by their names alone: letter by letter, then by what is left of them without marks.
    void matchNames() {
        const auto same = [](const std::string& name) { return name; };
        matchNames(same);
        matchNames(plainName);
    }
    template <class Key>
    void matchNames(const Key& key) {
        std::map<std::string, int> free;
        for (int m = 0; m < int(motion_.joints.size()); ++m)
            if (motionRoles_[std::size_t(m)].part == BodyPart::None && !used_.contains(m))
                free.emplace(key(motionName(m)), m);
        for (int s = 0; s < int(skeleton_.joints.size()); ++s) {
            if (skeletonRoles_[std::size_t(s)].part != BodyPart::None) continue;
            const auto found = free.find(key(skeletonName(s)));
            if (found != free.end()) pair(s, found->second);
        }
    }

    const Skeleton& skeleton_;
    const Skeleton& motion_;
    std::vector<BodyRole> skeletonRoles_, motionRoles_;
    std::map<std::string, std::string> pairs_;
    std::set<int> used_;  // joints of the motion
};

}  // namespace

std::map<std::string, std::string> matchingJoints(const Skeleton& skeleton, const Motion& motion) {
    const Skeleton theirs = skeletonOf(motion);
    return Matching(skeleton, theirs).pairs();
}

UpAxis upOf(const Skeleton& skeleton) {
    const std::vector<BodyRole> roles = bodyRoles(skeleton);
    const auto middleOf = [&](std::initializer_list<BodyPart> parts) -> std::optional<Vec3> {
        for (const BodyPart part : parts) {
            Vec3 sum(0);
            double count = 0;
            for (std::size_t j = 0; j < roles.size(); ++j)
                if (roles[j].part == part) sum += skeleton.joints[j].at, ++count;
            if (count > 0) return sum / count;
        }
        return std::nullopt;
    };
    const auto top = middleOf({BodyPart::Head, BodyPart::Neck, BodyPart::UpperArm, BodyPart::Spine});
    const auto bottom = middleOf({BodyPart::Foot, BodyPart::Shin, BodyPart::Thigh, BodyPart::Hips});
    Vec3 reach(0);
    if (top && bottom) {
        reach = *top - *bottom;
    } else if (!skeleton.joints.empty()) {
        Vec3 low(kInfinity), high(-kInfinity);
        for (const Joint& joint : skeleton.joints) low = glm::min(low, joint.at), high = glm::max(high, joint.at);
        reach = high - low;
    }
    // A body that lies along x is rare, a rest pose in which all bones point along x is not.
    constexpr double muchFarther = 4;
    int axis = std::abs(reach.y) > std::abs(reach.z) ? 1 : 2;
    if (std::abs(reach.x) > muchFarther * std::abs(reach[axis])) axis = 0;
    return {axis, reach[axis] < 0 ? -1.0 : 1.0};
}

}  // namespace voledit
