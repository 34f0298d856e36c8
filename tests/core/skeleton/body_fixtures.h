#pragma once
// A standing biped, and motions made by hand.

#include <string>

#include "core/skeleton/motion.h"

namespace voledit {

/// The 25 joints of the biped template with arms as `arm` points (unit, of the left side), y up, facing +z.
inline Skeleton standingBiped(const Vec3& arm = {0.7071067811865476, -0.7071067811865476, 0}) {
    std::vector<Joint> joints;
    std::vector<std::string> parents;
    const auto add = [&](const std::string& name, const std::string& parent, const Vec3& at) {
        joints.push_back({name, Joint::kNoParent, at, {}});
        parents.push_back(parent);
    };
    add("Hips", "", {0, 10, 0});
    add("Spine", "Hips", {0, 11.2, -0.1});
    add("Spine1", "Spine", {0, 12.4, -0.2});
    add("Spine2", "Spine1", {0, 13.8, -0.2});
    add("Neck", "Spine2", {0, 15.6, -0.1});
    add("Head", "Neck", {0, 16.6, 0.1});
    add("Head_End", "Head", {0, 18.4, 0.2});
    for (const double side : {1.0, -1.0}) {
        const std::string s = side > 0 ? "Left" : "Right";
        const Vec3 shoulder(side * 1.7, 15, -0.2), along(side * arm.x, arm.y, arm.z);
        add(s + "UpLeg", "Hips", {side * 1.0, 9.6, 0});
        add(s + "Leg", s + "UpLeg", {side * 1.2, 5.8, 0.1});
        add(s + "Foot", s + "Leg", {side * 1.4, 2, -0.3});
        add(s + "ToeBase", s + "Foot", {side * 1.6, 1.4, 1.0});
        add(s + "ToeBase_End", s + "ToeBase", {side * 1.7, 1.3, 1.7});
        add(s + "Shoulder", "Spine2", {side * 0.3, 15, 0});
        add(s + "Arm", s + "Shoulder", shoulder);
        add(s + "ForeArm", s + "Arm", shoulder + 2.4 * along);
        add(s + "Hand", s + "ForeArm", shoulder + 4.4 * along);
        add(s + "Hand_End", s + "Hand", shoulder + 5.6 * along);
    }
    return makeSkeleton(std::move(joints), parents);
}

/// A motion with the rest pose of `skeleton` and the given frames, all channels at every joint.
inline Motion motionOf(const Skeleton& skeleton, const std::vector<Pose>& frames, double frameTime = 0.1) {
    using enum MotionChannel;
    Motion motion;
    for (const Joint& joint : skeleton.joints) {
        const bool isRoot = joint.parent == Joint::kNoParent;
        const Vec3 from = isRoot ? Vec3(0) : skeleton.joints[std::size_t(joint.parent)].at;
        motion.joints.push_back({joint.name,
                                 joint.parent,
                                 joint.at - from,
                                 {Xposition, Yposition, Zposition, Zrotation, Yrotation, Xrotation},
                                 false});
    }
    motion.frameTime = frameTime;
    motion.frames = frames.size();
    for (const Pose& pose : frames)
        for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
            const bool isRoot = motion.joints[j].parent == Joint::kNoParent;
            const Vec3 place = pose.translate[j] + (isRoot ? motion.joints[j].offset : Vec3(0));
            const Vec3 degrees = degreesOf(pose.rotate[j]);
            motion.values.insert(motion.values.end(), {place.x, place.y, place.z, degrees.z, degrees.y, degrees.x});
        }
    return motion;
}

/// Every name of the skeleton to itself.
inline std::map<std::string, std::string> sameNames(const Skeleton& skeleton) {
    std::map<std::string, std::string> names;
    for (const Joint& joint : skeleton.joints) names[joint.name] = joint.name;
    return names;
}

}  // namespace voledit
