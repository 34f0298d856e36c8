#include "core/skeleton/joint_words.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

using enum JointWord;
using Side = BodySide;

struct Case {
    const char* name;
    JointWord word;
    Side side;
};

TEST(JointWords, NamesOfManyRigs) {
    const Case cases[] = {
        // Mixamo, MotionBuilder
        {"LeftUpLeg", Thigh, Side::Left},
        {"mixamorig:LeftForeArm", Forearm, Side::Left},
        {"mixamorig1:RightToeBase", Toe, Side::Right},
        {"RightHandMiddle2", MiddleFinger, Side::Right},
        {"LeftInHandRing", Ring, Side::Left},
        {"LeftLeg", Leg, Side::Left},
        {"RightArm", Arm, Side::Right},
        {"LeftShoulder", Shoulder, Side::Left},
        {"Spine1", Spine, Side::Middle},
        {"HeadTop_End", Head, Side::Middle},
        // CMU
        {"LHipJoint", Hip, Side::Left},
        {"LeftHip", Hip, Side::Left},
        {"RightKnee", Shin, Side::Right},
        {"lowerback", Spine, Side::Middle},
        {"lowerneck", Neck, Side::Middle},
        {"rhand", Hand, Side::Right},
        {"LFingers", Fingers, Side::Left},
        {"LeftWrist", Hand, Side::Left},
        // MakeHuman
        {"upperleg01.L", Thigh, Side::Left},
        {"lowerarm02.R", Forearm, Side::Right},
        {"clavicle.L", Collar, Side::Left},
        {"pelvis.R", None, Side::Right},
        {"breast.L", None, Side::Left},
        {"LoLeg_L", Shin, Side::Left},
        {"UpArm_R", UpperArm, Side::Right},
        {"Pinky1_L", Little, Side::Left},
        // Daz, 3ds Max, Blender
        {"lThigh", Thigh, Side::Left},
        {"rShldr", Shoulder, Side::Right},
        {"lForeArm", Forearm, Side::Left},
        {"Bip01 L Calf", Shin, Side::Left},
        {"Bip01 R UpperArm", UpperArm, Side::Right},
        {"Bip01 Pelvis", Hips, Side::Middle},
        {"upper_arm.R", UpperArm, Side::Right},
        {"shin.L", Shin, Side::Left},
        {"leftupleg", Thigh, Side::Left},
        {"rthumb1", Thumb, Side::Right},
        // No parts of bodies
        {"Armature", None, Side::Middle},
        {"", None, Side::Middle},
        {":", None, Side::Middle},
        {"root", Root, Side::Middle},
        {"42", None, Side::Middle},
    };
    for (const Case& c : cases) {
        const NameReading reading = readName(c.name);
        EXPECT_EQ(reading.word, c.word) << c.name << " reads as word " << int(reading.word);
        EXPECT_EQ(reading.side, c.side) << c.name;
    }
}

TEST(JointWords, EndsAndHelpers) {
    for (const char* end : {"Head_End", "RightHandEnd", "Bip01 L Toe0Nub", "LeftToeBase_End"})
        EXPECT_TRUE(readName(end).isEnd) << end;
    for (const char* helper : {"__UpLeg_L", "LeftArmRoll", "hand_ik.L", "LeftForeArm_Twist"})
        EXPECT_TRUE(readName(helper).helper) << helper;
    EXPECT_FALSE(readName("LeftHand").isEnd);
    EXPECT_FALSE(readName("Bend").isEnd);
    EXPECT_FALSE(readName("LeftHand").helper);
}

TEST(JointWords, PlainNames) {
    EXPECT_EQ(plainName("mixamorig:Left_Up.Leg 01"), "leftupleg01");
    EXPECT_EQ(plainName("Tail-1"), plainName("tail1"));
}

}  // namespace
}  // namespace voledit
