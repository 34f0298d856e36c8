#include "core/skeleton/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace voledit {

namespace {

bool isPosition(MotionChannel channel) {
    return channel <= MotionChannel::Zposition;
}

/// Which of x, y, z.
int axisOf(MotionChannel channel) {
    return int(channel) % 3;
}

Quat turnAbout(int axis, double degrees) {
    Vec3 direction{0};
    direction[axis] = 1;
    return glm::angleAxis(degrees * (kPi / 180), direction);
}

}  // namespace

std::size_t Motion::channelCount() const {
    std::size_t count = 0;
    for (const MotionJoint& joint : joints) count += joint.channels.size();
    return count;
}

Skeleton skeletonOf(const Motion& motion) {
    Skeleton skeleton;
    skeleton.joints.reserve(motion.joints.size());
    for (const MotionJoint& joint : motion.joints) {
        const bool isRoot = joint.parent == Joint::kNoParent;
        const Vec3 base = isRoot ? Vec3(0) : skeleton.joints[std::size_t(joint.parent)].at;
        skeleton.joints.push_back({joint.name, joint.parent, base + joint.offset, std::nullopt});
    }
    return skeleton;
}

Pose poseOfFrame(const Motion& motion, std::size_t frame) {
    Pose pose;
    pose.rotate.reserve(motion.joints.size());
    pose.translate.reserve(motion.joints.size());
    const double* value = motion.values.data() + frame * motion.channelCount();
    for (const MotionJoint& joint : motion.joints) {
        Quat rotation(1, 0, 0, 0);
        Vec3 translation(0);
        for (const MotionChannel channel : joint.channels) {
            const int axis = axisOf(channel);
            if (!isPosition(channel))
                rotation = rotation * turnAbout(axis, *value);
            else
                translation[axis] = *value - (joint.parent == Joint::kNoParent ? joint.offset[axis] : 0);
            ++value;
        }
        pose.rotate.push_back(glm::normalize(rotation));
        pose.translate.push_back(translation);
    }
    return pose;
}

Pose poseAt(const Motion& motion, double t) {
    if (motion.frames == 0) return restPose(skeletonOf(motion));
    const double last = double(motion.frames - 1);
    const double place = std::isnan(t) ? 0 : std::clamp(t / motion.frameTime, 0.0, last);
    const double before = std::floor(place);
    const Pose pose = poseOfFrame(motion, std::size_t(before));
    if (place == before) return pose;
    return interpolated(pose, poseOfFrame(motion, std::size_t(before) + 1), place - before);
}

}  // namespace voledit
