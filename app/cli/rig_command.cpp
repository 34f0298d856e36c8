// `voledit rig`: a skeleton laid into an object by its shape, with limbs fitted to it.

#include <CLI/App.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "core/base/error.h"
#include "core/rigging/body_frame.h"
#include "core/rigging/rig.h"
#include "core/scene/actor_edits.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

namespace fs = std::filesystem;

struct RigArguments {
    InputArguments input;
    std::string output, rig = "auto", motion, report;
    RigOptions options;
};

/// Opacity from which on a voxel counts: all that can be seen, as what no region holds vanishes from the picture.
constexpr double kVisible = 0.02;

struct FoundRig {
    RigTemplate like = RigTemplate::Chain;
    Rig rig;
    Coverage coverage;
    BodyFrame frame;
};

FoundRig findRig(const Term& object, const RigArguments& a, Progress* progress) {
    const OpaqueVoxels voxels = opaqueVoxels(object, kVisible, 256, progress);
    FoundRig found;
    found.like = a.rig == "auto" ? suitedTemplate(voxels, a.options) : rigTemplateOf(a.rig);
    found.rig = fittedRig(voxels, found.like, a.options);
    found.frame = bodyFrame(voxels, found.like == RigTemplate::Quadruped);
    const Skeleton& skeleton = found.rig.skeleton;
    found.coverage = coverageOf(voxels, found.rig.limbs, posedJoints(skeleton, restPose(skeleton)), {});
    return found;
}

nlohmann::ordered_json reportOf(const FoundRig& found) {
    nlohmann::ordered_json report;
    const Coverage& c = found.coverage;
    report["template"] = nameOf(found.like);
    report["opaque"] = c.opaque;
    report["covered"] = c.covered();
    report["uncovered"] = c.uncovered;
    report["doubly"] = c.doubly;
    for (std::size_t l = 0; l < found.rig.limbs.size(); ++l) {
        const Limb& limb = found.rig.limbs[l];
        const auto& joints = found.rig.skeleton.joints;
        report["limbs"].push_back({{"name", limb.name},
                                   {"from", joints[std::size_t(limb.from)].name},
                                   {"to", joints[std::size_t(limb.to)].name},
                                   {"voxels", c.ofLimb[l]}});
    }
    for (const Joint& joint : found.rig.skeleton.joints)
        report["joints"][joint.name] = {joint.at.x, joint.at.y, joint.at.z};
    return report;
}

std::string percent(std::size_t part, std::size_t whole) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f %%", whole ? 100 * double(part) / double(whole) : 0.0);
    return text;
}

void say(const FoundRig& found, Verbosity verbosity) {
    if (verbosity == Verbosity::Quiet) return;
    const Coverage& c = found.coverage;
    std::cerr << "voledit: " << nameOf(found.like) << ", " << found.rig.skeleton.joints.size() << " joints, "
              << found.rig.limbs.size() << " limbs\n"
              << "voledit: " << c.opaque << " opaque voxels: " << percent(c.opaque - c.uncovered, c.opaque)
              << " covered, " << c.uncovered << " uncovered, " << c.doubly << " (" << percent(c.doubly, c.opaque)
              << ") in two regions or more\n";
    for (std::size_t l = 0; l < found.rig.limbs.size(); ++l)
        std::cerr << "voledit:   " << found.rig.limbs[l].name << ": " << c.ofLimb[l] << " voxels\n";
}

void addMotion(IoClient& io, OpenedScene& opened, const NodePath& actor, const fs::path& file) {
    const MotionFile read = io.readMotion(file);
    printWarnings(read.warnings);
    const fs::path& folder = opened.folder;
    const fs::path absolute = fs::absolute(file).lexically_normal();
    const fs::path relative = absolute.lexically_relative(fs::absolute(folder).lexically_normal());
    const bool isInside = !relative.empty() && *relative.begin() != "..";
    const std::string asset =
        addMotionAsset(opened.scene, file.stem().string(), isInside ? relative.string() : absolute.string());
    setMotion(opened.scene, actor, asset, *read.motion);
    opened.assets.motions[asset] = read.motion;
}

int rig(const RigArguments& a, const CommonArguments& common) {
    if (a.rig != "auto" && a.rig != "biped" && a.rig != "quadruped" && a.rig != "chain")
        throw UsageError("--template " + a.rig + ": there are auto, biped, quadruped and chain");
    if (!(a.options.thinness >= 0)) throw UsageError("--thinness: give a number from 0 on");
    if (a.options.chain < 1 || a.options.chain > 1000) throw UsageError("--bones: give a number from 1 to 1000");
    if (!isSceneFile(a.output)) throw UsageError("-o " + a.output + ": a scene's name ends in .voledit");
    checkWritable(a.output);
    if (!a.report.empty()) checkWritable(a.report);
    IoClient io;
    OpenedScene opened = open(io, a.input, common);
    const CompiledScene compiled = compileAt(opened, a.input, kNaN);
    FoundRig found;
    withProgress("Rigging", common.verbosity(),
                 [&](Progress* progress) { found = findRig(*compiled.root, a, progress); });
    Scene& scene = opened.scene;
    const NodePath actor = addActor(scene, kRootPath, "Actor", found.rig);
    if (!scene.camera && found.like != RigTemplate::Chain)
        setCamera(scene, fittingCamera(compiled.root->bounds, 4.0 / 3.0, found.frame.axes[2], found.frame.axes[1]));
    if (!a.motion.empty()) addMotion(io, opened, actor, a.motion);
    saveScene(withDefaultsWrittenOut(scene, opened.assets), a.output, opened.folder);
    if (!a.report.empty()) writeTextFile(a.report, reportOf(found).dump(2) + "\n");
    say(found, common.verbosity());
    return 0;
}

}  // namespace

Command addRigCommand(CLI::App& command, const CommonArguments& common) {
    auto a = std::make_shared<RigArguments>();
    addInputArguments(command, a->input, "file");
    command.add_option("-o,--output", a->output, "Scene to write (.voledit)")->required();
    command.add_option("--template", a->rig, "auto, biped, quadruped or chain")->capture_default_str();
    command.add_option("--bones", a->options.chain, "Limbs of a chain")->capture_default_str()->type_name("N");
    command.add_option("--motion", a->motion, "A motion (BVH, FBX, glTF, Collada) that drives it")->type_name("FILE");
    command.add_option("--thinness", a->options.thinness, "Of the curve skeleton: larger has fewer branches")
        ->capture_default_str()
        ->type_name("F");
    command.add_option("--report", a->report, "Write joints, limbs and coverage as JSON")->type_name("FILE.json");
    return [a, &common] { return rig(*a, common); };
}

}  // namespace voledit
