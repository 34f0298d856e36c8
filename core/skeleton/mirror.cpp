// Left and right: joints that belong together by their names, and poses seen in a mirror.

#include <cassert>
#include <cctype>
#include <string_view>
#include <unordered_map>

#include "core/skeleton/skeleton.h"

namespace voledit {
namespace {

bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool isUpper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}
char lower(char c) {
    return char(std::tolower(static_cast<unsigned char>(c)));
}

std::string lowered(std::string_view name) {
    std::string result(name);
    for (char& c : result) c = lower(c);
    return result;
}

/// Whether the letter at `i` is a word by itself: "lThigh", "upLeg_L", "hand.r", "FingerL1".
bool standsAlone(std::string_view name, std::size_t i) {
    const bool begins = i == 0 || !isLetter(name[i - 1]) || (!isUpper(name[i - 1]) && isUpper(name[i]));
    const bool ends = i + 1 == name.size() || !isLetter(name[i + 1]) || isUpper(name[i + 1]);
    return begins && ends;
}

/// What a joint on the other side may be called, in lower case; the words first.
std::vector<std::string> namesAcross(std::string_view name) {
    std::vector<std::string> names;
    const std::string low = lowered(name);
    const auto replaced = [&](std::size_t at, std::size_t length, std::string_view by) {
        names.push_back(std::string(low).replace(at, length, by));
    };
    for (std::size_t i = 0; i < low.size(); ++i) {
        if (low.compare(i, 4, "left") == 0) replaced(i, 4, "right");
        if (low.compare(i, 5, "right") == 0) replaced(i, 5, "left");
    }
    for (std::size_t i = 0; i < low.size(); ++i)
        if ((low[i] == 'l' || low[i] == 'r') && standsAlone(name, i)) replaced(i, 1, low[i] == 'l' ? "r" : "l");
    return names;
}

class Sides {
public:
    explicit Sides(const Skeleton& skeleton) : skeleton_(skeleton) {
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j)
            index_.emplace(lowered(skeleton.joints[j].name), int(j));
    }

    /// Two joints are partners only if each is the other's, so that mirroring twice changes nothing.
    int partner(int joint) const {
        const int across = found(joint);
        return found(across) == joint ? across : joint;
    }

private:
    int found(int joint) const {
        for (const std::string& name : namesAcross(skeleton_.joints[std::size_t(joint)].name))
            if (const auto other = index_.find(name); other != index_.end()) return other->second;
        return joint;
    }

    const Skeleton& skeleton_;
    std::unordered_map<std::string, int> index_;
};

}  // namespace

int mirrorPartner(const Skeleton& skeleton, int joint) {
    assert(joint >= 0 && std::size_t(joint) < skeleton.joints.size());
    return Sides(skeleton).partner(joint);
}

Pose mirrored(const Skeleton& skeleton, const Pose& pose, int axis) {
    assert(axis >= 0 && axis < 3);
    assert(pose.rotate.size() == skeleton.joints.size() && pose.translate.size() == skeleton.joints.size());
    const Sides sides(skeleton);
    Pose result = pose;
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
        const std::size_t from = std::size_t(sides.partner(int(j)));
        // A rotation's axis is the normal of a plane: the mirror keeps what it turns across itself.
        Vec3 about(-pose.rotate[from].x, -pose.rotate[from].y, -pose.rotate[from].z);
        about[axis] = -about[axis];
        result.rotate[j] = Quat(pose.rotate[from].w, about);
        result.translate[j] = pose.translate[from];
        result.translate[j][axis] = -result.translate[j][axis];
    }
    return result;
}

}  // namespace voledit
