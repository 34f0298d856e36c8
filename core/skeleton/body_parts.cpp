#include "core/skeleton/body_parts.h"

#include <algorithm>

namespace voledit {

namespace {

BodyPart plainPart(JointWord word) {
    switch (word) {
        case JointWord::Hips:
            return BodyPart::Hips;
        case JointWord::Spine:
            return BodyPart::Spine;
        case JointWord::Neck:
            return BodyPart::Neck;
        case JointWord::Head:
            return BodyPart::Head;
        case JointWord::Collar:
            return BodyPart::Collar;
        case JointWord::UpperArm:
            return BodyPart::UpperArm;
        case JointWord::Forearm:
            return BodyPart::Forearm;
        case JointWord::Hand:
            return BodyPart::Hand;
        case JointWord::Fingers:
            return BodyPart::Fingers;
        case JointWord::Thumb:
            return BodyPart::Thumb;
        case JointWord::Index:
            return BodyPart::Index;
        case JointWord::MiddleFinger:
            return BodyPart::MiddleFinger;
        case JointWord::Ring:
            return BodyPart::Ring;
        case JointWord::Little:
            return BodyPart::Little;
        case JointWord::Thigh:
            return BodyPart::Thigh;
        case JointWord::Shin:
            return BodyPart::Shin;
        case JointWord::Foot:
            return BodyPart::Foot;
        case JointWord::Toe:
            return BodyPart::Toe;
        default:
            return BodyPart::None;
    }
}

class Body {
public:
    explicit Body(const Skeleton& skeleton) : skeleton_(skeleton) {
        for (const Joint& joint : skeleton.joints) {
            names_.push_back(readName(joint.name));
            const NameReading& name = names_.back();
            const bool counts = !name.isEnd && !name.helper;
            roles_.push_back({counts ? plainPart(name.word) : BodyPart::None, name.side});
        }
    }

    std::vector<BodyRole> roles() {
        for (const BodySide side : {BodySide::Left, BodySide::Right}) {
            // In this order: what a word means depends on those decided before.
            eachOf(JointWord::Leg, side, [&](int j) { return legOf(j); });
            eachOf(JointWord::Hip, side,
                   [&](int j) { return below(j, BodyPart::Thigh) || hipBelow(j) ? BodyPart::None : BodyPart::Thigh; });
            eachOf(JointWord::Arm, side, [&](int j) { return armOf(j); });
            eachOf(JointWord::Shoulder, side,
                   [&](int j) { return below(j, BodyPart::UpperArm) ? BodyPart::Collar : BodyPart::UpperArm; });
        }
        nameHips();
        nameEnds();
        for (BodyRole& role : roles_)
            if (role.part == BodyPart::None) role.side = BodySide::Middle;
        return std::move(roles_);
    }

private:
    std::size_t count() const { return roles_.size(); }
    int parentOf(int j) const { return skeleton_.joints[std::size_t(j)].parent; }
    BodyRole& role(int j) { return roles_[std::size_t(j)]; }
    const NameReading& name(int j) const { return names_[std::size_t(j)]; }

    bool isBelow(int j, int above) const {
        while (j > above) j = parentOf(j);
        return j == above;
    }

    /// Whether a joint below `j`, on its side, passes. One walk over the joints, however deep they are.
    template <class Test>
    bool anyBelow(int j, const Test& test) {
        std::vector<char> inside(count(), 0);
        inside[std::size_t(j)] = 1;
        for (int k = j + 1; k < int(count()); ++k) {
            const int parent = parentOf(k);
            if (parent == Joint::kNoParent || !inside[std::size_t(parent)]) continue;
            inside[std::size_t(k)] = 1;
            if (name(k).side == name(j).side && test(k)) return true;
        }
        return false;
    }
    bool below(int j, BodyPart part) {
        return anyBelow(j, [&](int k) { return role(k).part == part; });
    }
    bool hipBelow(int j) {
        return anyBelow(j, [&](int k) { return name(k).word == JointWord::Hip && !name(k).isEnd && !name(k).helper; });
    }
    template <class Test>
    bool above(int j, const Test& test) {
        for (int k = parentOf(j); k != Joint::kNoParent; k = parentOf(k))
            if (name(k).side == name(j).side && test(k)) return true;
        return false;
    }

    template <class Decide>
    void eachOf(JointWord word, BodySide side, const Decide& decide) {
        for (int j = 0; j < int(count()); ++j)
            if (name(j).word == word && name(j).side == side && !name(j).isEnd && !name(j).helper)
                role(j) = {decide(j), side};
    }

    BodyPart legOf(int j) {
        const bool shinBelow = below(j, BodyPart::Shin);
        const bool thighAbove = above(j, [&](int k) { return role(k).part == BodyPart::Thigh; });
        const bool hipAbove = above(j, [&](int k) { return name(k).word == JointWord::Hip; });
        if (shinBelow) return thighAbove ? BodyPart::None : BodyPart::Thigh;
        return thighAbove || hipAbove ? BodyPart::Shin : BodyPart::Thigh;
    }

    BodyPart armOf(int j) {
        const bool upperAbove = above(j, [&](int k) { return role(k).part == BodyPart::UpperArm; });
        if (!upperAbove) return below(j, BodyPart::UpperArm) ? BodyPart::Collar : BodyPart::UpperArm;
        return below(j, BodyPart::Forearm) ? BodyPart::None : BodyPart::Forearm;
    }

    void nameHips() {
        const auto has = [&](BodyPart part) {
            return std::any_of(roles_.begin(), roles_.end(), [&](const BodyRole& role) { return role.part == part; });
        };
        if (has(BodyPart::Hips)) return;
        const auto left = jointsOf(roles_, {BodyPart::Thigh, BodySide::Left});
        const auto right = jointsOf(roles_, {BodyPart::Thigh, BodySide::Right});
        int hips = Joint::kNoParent;
        if (!left.empty() && !right.empty()) {
            hips = parentOf(left.front());
            while (hips != Joint::kNoParent && !isBelow(right.front(), hips)) hips = parentOf(hips);
        }
        for (int j = 0; j < int(count()) && hips == Joint::kNoParent; ++j)
            if (name(j).word == JointWord::Root && !name(j).helper) hips = j;
        if (hips != Joint::kNoParent) role(hips) = {BodyPart::Hips, BodySide::Middle};
    }

    /// Ends are called after the joint above, which has its role by now.
    void nameEnds() {
        for (int j = 0; j < int(count()); ++j) {
            const int parent = parentOf(j);
            if (!name(j).isEnd || parent == Joint::kNoParent || name(parent).isEnd) continue;
            const BodyRole of = role(parent);
            if (of.part == BodyPart::Head) role(j) = {BodyPart::HeadEnd, of.side};
            if (of.part == BodyPart::Hand) role(j) = {BodyPart::HandEnd, of.side};
            if (of.part == BodyPart::Toe) role(j) = {BodyPart::ToeEnd, of.side};
            // A foot that ends at the toes has a joint there in other rigs.
            if (of.part == BodyPart::Foot && !below(parent, BodyPart::Toe)) role(j) = {BodyPart::Toe, of.side};
        }
    }

    const Skeleton& skeleton_;
    std::vector<NameReading> names_;
    std::vector<BodyRole> roles_;
};

}  // namespace

std::vector<BodyRole> bodyRoles(const Skeleton& skeleton) {
    return Body(skeleton).roles();
}

std::vector<int> jointsOf(const std::vector<BodyRole>& roles, const BodyRole& role) {
    std::vector<int> joints;
    for (std::size_t j = 0; j < roles.size(); ++j)
        if (roles[j] == role) joints.push_back(int(j));
    return joints;
}

}  // namespace voledit
