// `voledit pose`: where the joints of a motion are at a frame.

#include <CLI/App.hpp>
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "core/base/error.h"

namespace voledit {

namespace {

struct PoseArguments {
    std::string file;
    long long frame = 0;
    bool json = false;
};

void printJson(const Skeleton& skeleton, const std::vector<PosedJoint>& posed) {
    nlohmann::ordered_json joints = nlohmann::ordered_json::object();
    for (std::size_t j = 0; j < posed.size(); ++j) {
        const Vec3& at = posed[j].position;
        joints[skeleton.joints[j].name] = {at.x, at.y, at.z};
    }
    std::cout << nlohmann::ordered_json{{"joints", joints}}.dump(2) << "\n";
}

void printTable(const Skeleton& skeleton, const std::vector<PosedJoint>& posed) {
    std::size_t widest = 0;
    for (const Joint& joint : skeleton.joints) widest = std::max(widest, joint.name.size());
    for (std::size_t j = 0; j < posed.size(); ++j) {
        std::cout << std::left << std::setw(int(widest)) << skeleton.joints[j].name << std::right << std::fixed
                  << std::setprecision(6);
        for (int a = 0; a < 3; ++a) std::cout << std::setw(16) << posed[j].position[a];
        std::cout << "\n";
    }
}

int pose(const PoseArguments& arguments, const CommonArguments& common) {
    if (arguments.frame < 0) throw UsageError("--frame: frames are counted from 0");
    IoClient io;
    const Motion motion = *readMotionFile(io, arguments.file, common).motion;
    if (std::size_t(arguments.frame) >= motion.frames)
        throw Error(arguments.file, "has no frame " + std::to_string(arguments.frame),
                    motion.frames > 0 ? "its frames are 0 to " + std::to_string(motion.frames - 1)
                                      : std::string("it holds a rest pose alone"));
    const Skeleton skeleton = skeletonOf(motion);
    const auto posed = posedJoints(skeleton, poseOfFrame(motion, std::size_t(arguments.frame)));
    if (arguments.json)
        printJson(skeleton, posed);
    else
        printTable(skeleton, posed);
    return 0;
}

}  // namespace

Command addPoseCommand(CLI::App& command, const CommonArguments& common) {
    auto arguments = std::make_shared<PoseArguments>();
    command.add_option("motion", arguments->file, "A motion: .bvh .gltf .glb .fbx .dae")->required();
    command.add_option("--frame", arguments->frame, "Frame, counted from 0")->type_name("N");
    command.add_flag("--json", arguments->json, "As JSON");
    return [arguments, &common] { return pose(*arguments, common); };
}

}  // namespace voledit
