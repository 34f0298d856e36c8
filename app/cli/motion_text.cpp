#include "app/cli/motion_text.h"

#include <algorithm>
#include <iostream>

#include "core/base/box3.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kChannelNames[] = {"Xposition", "Yposition", "Zposition", "Xrotation", "Yrotation", "Zrotation"};

Json toJson(const Vec3& v) {
    return {v.x, v.y, v.z};
}

std::string nameOf(const UpAxis& up) {
    return (up.sign < 0 ? "-" : "") + std::string(1, "xyz"[up.axis]);
}

Json channelNames(const MotionJoint& joint) {
    Json names = Json::array();
    for (const MotionChannel channel : joint.channels) names.push_back(kChannelNames[std::size_t(channel)]);
    return names;
}

Json hierarchyOf(const Motion& motion, const Skeleton& skeleton) {
    Json hierarchy = Json::array();
    for (std::size_t j = 0; j < motion.joints.size(); ++j) {
        const MotionJoint& joint = motion.joints[j];
        const bool isRoot = joint.parent == Joint::kNoParent;
        hierarchy.push_back({{"name", joint.name},
                             {"parent", isRoot ? Json(nullptr) : Json(motion.joints[std::size_t(joint.parent)].name)},
                             {"offset", toJson(joint.offset)},
                             {"at", toJson(skeleton.joints[j].at)},
                             {"channels", channelNames(joint)},
                             {"endSite", joint.endSite}});
    }
    return hierarchy;
}

}  // namespace

Json motionJson(const MotionFile& file) {
    const Motion& motion = *file.motion;
    const Skeleton skeleton = skeletonOf(motion);
    const UpAxis up = upOf(skeleton);
    Box3 box;
    for (const Joint& joint : skeleton.joints) box = join(box, joint.at);
    const auto ends = std::count_if(motion.joints.begin(), motion.joints.end(),
                                    [](const MotionJoint& joint) { return joint.endSite; });
    Json json;
    json["kind"] = "motion";
    json["format"] = file.format;
    json["joints"] = motion.joints.size() - std::size_t(ends);
    json["endSites"] = ends;
    json["channels"] = motion.channelCount();
    json["frames"] = motion.frames;
    json["frameTime"] = motion.frameTime;
    json["fps"] = 1 / motion.frameTime;
    json["duration"] = motion.duration();
    json["height"] = box.max[up.axis] - box.min[up.axis];
    json["up"] = nameOf(up);
    json["bounds"] = {{"min", toJson(box.min)}, {"max", toJson(box.max)}};
    json["hierarchy"] = hierarchyOf(motion, skeleton);
    return json;
}

void printMotion(const MotionFile& file) {
    const Json json = motionJson(file);
    for (const auto& [name, value] : json.items())
        if (name != "hierarchy")
            std::cout << name << ": " << (value.is_string() ? value.get<std::string>() : value.dump()) << "\n";
    std::cout << "hierarchy:\n";
    std::vector<std::size_t> depth;
    for (const MotionJoint& joint : file.motion->joints) {
        depth.push_back(joint.parent == Joint::kNoParent ? 1 : depth[std::size_t(joint.parent)] + 1);
        std::cout << std::string(2 * depth.back(), ' ') << joint.name;
        if (!joint.channels.empty()) std::cout << " (" << joint.channels.size() << " channels)";
        std::cout << "\n";
    }
}

}  // namespace voledit
