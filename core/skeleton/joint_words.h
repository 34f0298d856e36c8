#pragma once
// What a joint's name says by its words: which part of a body, on which side.

#include <cstdint>
#include <string>

namespace voledit {

enum class BodySide : std::uint8_t { Middle, Left, Right };

/// What one name says without its neighbours. "Hip", "Shoulder", "Arm" and "Leg" mean one joint or the next by what
/// else there is (core/skeleton/body_parts.h).
enum class JointWord : std::uint8_t {
    None,
    Root,
    Hips,
    Spine,
    Neck,
    Head,
    Collar,
    Shoulder,
    Arm,
    UpperArm,
    Forearm,
    Hand,
    Fingers,
    Thumb,
    Index,
    MiddleFinger,
    Ring,
    Little,
    Hip,
    Leg,
    Thigh,
    Shin,
    Foot,
    Toe,
};

struct NameReading {
    JointWord word = JointWord::None;
    BodySide side = BodySide::Middle;
    bool isEnd = false;   // marks the end of the joint above: "…_End", "…Nub"
    bool helper = false;  // twist, roll and IK joints, and such as begin with _
};

/// Reads a name as rigs of BVH files, MakeHuman, CMU, Mixamo, Daz, 3ds Max, Blender and FBX have it: "LeftUpLeg",
/// "upperleg01.L", "lThigh", "mixamorig:LeftForeArm", "Bip01 L Calf".
NameReading readName(const std::string& name);

/// Lower-case letters and digits alone, without a name space before a colon: equal for names that mean to be equal.
std::string plainName(const std::string& name);

}  // namespace voledit
