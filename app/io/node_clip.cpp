#include "app/io/node_clip.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/io/checks.h"
#include "core/base/error.h"
#include "core/io/bvh.h"
#include "core/io/unique_names.h"

namespace voledit {

namespace {

constexpr double kFastest = 1.0 / 120, kSlowest = 1.0 / 30;  // seconds between samples of keys on no grid
constexpr std::size_t kMostValues = 50'000'000;

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Vec3 mixed(const Vec3& a, const Vec3& b, double s) {
    return glm::mix(a, b, s);
}
Quat mixed(const Quat& a, const Quat& b, double s) {
    return glm::slerp(a, b, s);
}

/// Held at the ends, interpolated between.
template <class Value>
Value valueAt(const std::vector<std::pair<double, Value>>& keys, double t, const Value& without) {
    if (keys.empty()) return without;
    const auto next =
        std::upper_bound(keys.begin(), keys.end(), t, [](double time, const auto& key) { return time < key.first; });
    if (next == keys.begin()) return next->second;
    const auto& before = *std::prev(next);
    if (next == keys.end()) return before.second;
    return mixed(before.second, next->second, (t - before.first) / (next->first - before.first));
}

/// Translation, rotation and scale of a node as it stands.
struct Parts {
    Vec3 translate{0}, scale{1};
    Quat rotate{1, 0, 0, 0};
};

/// Columns of unit length at right angles; false where the matrix is flat.
bool axesOf(const Mat4& matrix, Mat3& axes) {
    const Mat3 linear(matrix);
    const double volume = glm::determinant(linear);
    if (!std::isfinite(volume) || volume == 0) return false;
    axes[0] = glm::normalize(linear[0]);
    axes[1] = glm::normalize(linear[1] - glm::dot(linear[1], axes[0]) * axes[0]);
    axes[2] = glm::cross(axes[0], axes[1]) * (volume < 0 ? -1.0 : 1.0);
    return true;
}

Parts partsOf(const Mat4& matrix) {
    Parts parts;
    parts.translate = Vec3(matrix[3]);
    Mat3 axes(1.0);
    for (int a = 0; a < 3; ++a) parts.scale[a] = glm::length(Vec3(matrix[a]));
    if (!axesOf(matrix, axes)) return parts;
    if (glm::determinant(axes) < 0) axes[2] = -axes[2], parts.scale.z = -parts.scale.z;
    parts.rotate = glm::normalize(glm::quat_cast(axes));
    return parts;
}

class NodeClip {
public:
    NodeClip(const std::string& where, const std::vector<ClipNode>& nodes, std::vector<std::string>& warnings)
        : where_(where), nodes_(nodes), warnings_(warnings) {}

    Motion motion() {
        choose();
        chooseTimes();
        for (const ClipNode& node : nodes_) parts_.push_back(partsOf(node.local));
        rest_ = globals(nullptr);
        addJoints();
        sample();
        addValues();
        return std::move(motion_);
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
        throw Error(where_, what, remedy);
    }

    /// Bones and animated nodes, all up to where they meet, and nodes without meshes below them.
    void choose() {
        const std::size_t count = nodes_.size();
        std::vector<std::size_t> below(count, 0);  // how many wanted nodes are in the tree from here
        std::size_t wanted = 0;
        for (std::size_t n = 0; n < count; ++n) {
            below[n] = nodes_[n].isBone || !nodes_[n].keys.empty();
            wanted += below[n];
        }
        if (wanted == 0)
            fail("holds no skeleton: no bones and no moving nodes", "export it with its armature or its animation");
        const std::vector<std::size_t> own = below;
        std::vector<int> branches(count, 0);  // children with such
        for (std::size_t n = count; n-- > 0;) {
            if (nodes_[n].parent == Joint::kNoParent || below[n] == 0) continue;
            below[std::size_t(nodes_[n].parent)] += below[n];
            ++branches[std::size_t(nodes_[n].parent)];
        }
        chosen_.assign(count, false);
        for (std::size_t n = 0; n < count; ++n) {
            const int parent = nodes_[n].parent;
            const bool parentChosen = parent != Joint::kNoParent && chosen_[std::size_t(parent)];
            // The lowest node that has them all below it is where they meet.
            const bool meets = own[n] || below[n] < wanted || branches[n] > 1;
            chosen_[n] = below[n] > 0 ? parentChosen || meets : parentChosen && !nodes_[n].hasMesh;
        }
    }

    template <class Keys>
    void collectTimes(const Keys& keys, std::vector<double>& times) const {
        double last = -kInfinity;
        for (const auto& [time, value] : keys) {
            if (!std::isfinite(time) || time < last) fail("its keys' times are not in order", "export it anew");
            times.push_back(last = time);
        }
    }

    void chooseTimes() {
        std::vector<double> times;
        for (const ClipNode& node : nodes_) {
            collectTimes(node.keys.translate, times);
            collectTimes(node.keys.rotate, times);
            collectTimes(node.keys.scale, times);
        }
        motion_.frames = 1;
        motion_.frameTime = kSlowest;
        if (times.empty()) {
            warnings_.push_back(where_ + ": holds no clip; its rest pose was read as one frame");
            return;
        }
        std::sort(times.begin(), times.end());
        start_ = times.front();
        const double duration = times.back() - start_;
        if (duration <= 0) return;
        motion_.frameTime = spacingOf(times);
        const double frames = std::round(duration / motion_.frameTime) + 1;
        if (frames > double(BvhLimits::frames))
            fail("its clip lasts " + std::to_string(duration) + " seconds, which is too long", "cut it into parts");
        motion_.frames = std::size_t(frames);
    }

    /// The keys' own spacing where they all lie on its multiples, as exporters that bake write them.
    double spacingOf(const std::vector<double>& times) const {
        constexpr double equal = 1e-5, offGrid = 0.02;
        double least = kInfinity;
        for (std::size_t i = 1; i < times.size(); ++i)
            if (times[i] - times[i - 1] > equal) least = std::min(least, times[i] - times[i - 1]);
        // Times are often rounded to single precision: the mean spacing is closer than the least one.
        const double duration = times.back() - start_;
        const double spacing = duration / std::max(1.0, std::round(duration / least));
        const bool grid = std::all_of(times.begin(), times.end(), [&](double t) {
            const double steps = (t - start_) / spacing;
            return std::abs(steps - std::round(steps)) < offGrid;
        });
        if (grid && spacing >= kFastest * (1 - offGrid)) return spacing;
        const double wished = std::clamp(spacing, kFastest, kSlowest);
        return duration / std::max(1.0, std::ceil(duration / wished - offGrid));
    }

    /// Of all nodes, at a time or (null) as they stand.
    std::vector<Mat4> globals(const double* time) const {
        std::vector<Mat4> global(nodes_.size());
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            const ClipNode& node = nodes_[n];
            Mat4 local = node.local;
            if (time && !node.keys.empty()) {
                const Parts& parts = parts_[n];
                const Quat rotate = glm::normalize(valueAt(node.keys.rotate, *time, parts.rotate));
                local = glm::translate(Mat4(1.0), valueAt(node.keys.translate, *time, parts.translate)) *
                        glm::mat4_cast(rotate);
                local = glm::scale(local, valueAt(node.keys.scale, *time, parts.scale));
            }
            global[n] = node.parent == Joint::kNoParent ? local : global[std::size_t(node.parent)] * local;
            for (int c = 0; c < 4; ++c)
                if (!finite(Vec3(global[n][c])) || glm::length(Vec3(global[n][c])) > BvhLimits::number)
                    fail("the node " + inQuotes(node.name) + " has numbers that are not finite, or out of range",
                         "export it anew");
        }
        return global;
    }

    std::string jointName(const std::string& written) {
        std::string name = isUtf8(written) ? written : utf8OfLatin1(written);
        for (char& c : name)
            if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '{' || c == '}') c = '_';
        const auto first = name.find_first_not_of(' ');
        name = first == std::string::npos ? "joint" : name.substr(first, name.find_last_not_of(' ') - first + 1);
        constexpr std::size_t longest = BvhLimits::nameBytes - 10;  // leaves room for a number behind it
        if (name.size() > longest) {
            std::size_t cut = longest;
            while (cut > 0 && (name[cut] & 0xc0) == 0x80) --cut;
            name.resize(cut);
        }
        return names_.unique(name);
    }

    void addJoints() {
        std::vector<int> jointOf(nodes_.size(), Joint::kNoParent), depth(nodes_.size(), 1);
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            if (!chosen_[n]) continue;
            if (joints_.size() >= kMostJoints)
                fail("its skeleton has more than " + std::to_string(kMostJoints) + " joints", "give a smaller one");
            MotionJoint joint;
            const int above = nodes_[n].parent;
            joint.parent = above == Joint::kNoParent ? Joint::kNoParent : jointOf[std::size_t(above)];
            if (joint.parent != Joint::kNoParent) depth[n] = depth[std::size_t(above)] + 1;
            if (std::size_t(depth[n]) > BvhLimits::depth)
                fail("its nodes are nested deeper than " + std::to_string(BvhLimits::depth), "give a flatter skeleton");
            joint.name = jointName(nodes_[n].name);
            if (joint.name != nodes_[n].name && isUtf8(nodes_[n].name) && !nodes_[n].name.empty() &&
                warnings_.size() < 5)
                warnings_.push_back(where_ + ": the joint " + inQuotes(nodes_[n].name) + " is called " +
                                    inQuotes(joint.name));
            const Vec3 place(rest_[n][3]);
            joint.offset = joint.parent == Joint::kNoParent ? place : place - restPlace(joint.parent);
            jointOf[n] = int(joints_.size());
            joints_.push_back(int(n));
            motion_.joints.push_back(std::move(joint));
        }
    }

    Vec3 restPlace(int joint) const { return Vec3(rest_[std::size_t(joints_[std::size_t(joint)])][3]); }

    /// Local rotation and displacement of every joint at every frame.
    void sample() {
        const std::size_t count = joints_.size();
        if (motion_.frames * count * 6 > kMostValues)
            fail("its clip has " + std::to_string(motion_.frames) + " frames of " + std::to_string(count) +
                     " joints, which is too much",
                 "cut it into parts");
        for (std::size_t frame = 0; frame < motion_.frames; ++frame) {
            const double time = start_ + double(frame) * motion_.frameTime;
            const std::vector<Mat4> global = globals(&time);
            std::vector<Quat> turned(count);  // from rest, in the world's axes
            for (std::size_t j = 0; j < count; ++j) {
                const std::size_t n = std::size_t(joints_[j]);
                const MotionJoint& joint = motion_.joints[j];
                const bool isRoot = joint.parent == Joint::kNoParent;
                const Quat above = isRoot ? Quat(1, 0, 0, 0) : turned[std::size_t(joint.parent)];
                Mat3 now(1.0), before(1.0);
                // What is scaled to nothing has no axes: it goes along.
                const bool known = axesOf(global[n], now) && axesOf(rest_[n], before);
                turned[j] = known ? glm::normalize(glm::quat_cast(now * glm::transpose(before))) : above;
                rotations_.push_back(glm::conjugate(above) * turned[j]);
                const Vec3 place(global[n][3]);
                const Vec3 from = isRoot ? Vec3(0) : Vec3(global[std::size_t(joints_[std::size_t(joint.parent)])][3]);
                moves_.push_back(isRoot ? place : glm::conjugate(above) * (place - from) - joint.offset);
            }
        }
    }

    void addValues() {
        using enum MotionChannel;
        const std::size_t count = joints_.size();
        double size = 0;
        for (std::size_t j = 0; j < count; ++j) size = std::max(size, glm::length(restPlace(int(j)) - restPlace(0)));
        for (std::size_t j = 0; j < count; ++j) {
            MotionJoint& joint = motion_.joints[j];
            bool moves = joint.parent == Joint::kNoParent, turns = moves;
            for (std::size_t i = j; i < moves_.size(); i += count) {
                moves = moves || glm::length(moves_[i]) > 1e-6 * size;
                turns = turns || std::abs(rotations_[i].w) < 1 - 1e-14;
            }
            if (moves) joint.channels = {Xposition, Yposition, Zposition};
            if (turns) joint.channels.insert(joint.channels.end(), {Zrotation, Yrotation, Xrotation});
        }
        motion_.values.reserve(motion_.frames * motion_.channelCount());
        for (std::size_t i = 0; i < moves_.size(); ++i) {
            const auto& channels = motion_.joints[i % count].channels;
            if (channels.empty()) continue;
            if (channels.front() == Xposition)
                motion_.values.insert(motion_.values.end(), {moves_[i].x, moves_[i].y, moves_[i].z});
            if (channels.back() != Xrotation) continue;
            const Vec3 degrees = degreesOf(rotations_[i]);
            motion_.values.insert(motion_.values.end(), {degrees.z, degrees.y, degrees.x});
        }
    }

    const std::string& where_;
    const std::vector<ClipNode>& nodes_;
    std::vector<std::string>& warnings_;
    Motion motion_;
    UniqueNames names_;
    std::vector<bool> chosen_;
    std::vector<int> joints_;  // the node of each joint
    std::vector<Parts> parts_;
    std::vector<Mat4> rest_;  // of each node
    double start_ = 0;
    std::vector<Quat> rotations_;  // [frame × joints]
    std::vector<Vec3> moves_;
};

}  // namespace

Motion motionOfNodes(const std::string& where, const std::vector<ClipNode>& nodes, std::vector<std::string>& warnings) {
    return NodeClip(where, nodes, warnings).motion();
}

}  // namespace voledit
