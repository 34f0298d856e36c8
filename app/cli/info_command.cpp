// `voledit info`: what a volume, a mesh, a motion or a scene holds.

#include <CLI/App.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/motion_text.h"
#include "core/fields/statistics.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Json toJson(const Box3& box) {
    return {{"min", toJson(box.min)}, {"max", toJson(box.max)}};
}

void addStatistics(Json& json, const VolumeStatistics& s) {
    json["min"] = s.min;
    json["max"] = s.max;
    json["mean"] = s.mean;
    json["histogram"] = s.histogram;
}

Json describe(const VolumeFile& file) {
    const Volume& volume = *file.volume;
    const VolumeGrid& grid = volume.grid();
    const Mat3 d = grid.direction();
    Json json;
    json["kind"] = "volume";
    json["format"] = file.format;
    json["size"] = {grid.size.x, grid.size.y, grid.size.z};
    json["spacing"] = toJson(grid.spacing());
    json["origin"] = toJson(grid.origin());
    json["direction"] = {d[0].x, d[1].x, d[2].x, d[0].y, d[1].y, d[2].y, d[0].z, d[1].z, d[2].z};
    json["component"] = nameOf(volume.type());
    json["channels"] = grid.channels;
    addStatistics(json, countedStatistics(volume));
    return json;
}

Json describe(MeshFile file) {
    Json json;
    json["kind"] = "mesh";
    json["format"] = file.format;
    // 64-bit integers count as what a volume makes of them.
    json["component"] = file.storedType.ends_with("int64") ? "double" : file.storedType;
    json["channels"] = file.mesh.channels;
    json["points"] = file.mesh.points.size();
    json["cell"] = file.mesh.hexahedra.empty() ? "tetrahedron" : "hexahedron";
    const Mesh mesh(std::move(file.mesh));
    json["cells"] = mesh.cells().cellCount();
    json["bounds"] = toJson(mesh.cells().bounds());
    addStatistics(json, file.statistics);
    return json;
}

Json describe(const OpenedScene& opened, const InputArguments& input) {
    const Scene& scene = opened.scene;
    const CompiledScene compiled = compileAt(opened, input, kNaN);
    Json json;
    json["kind"] = "scene";
    json["format"] = "voledit";
    json["assets"] = Json::object();
    for (const auto& [name, asset] : scene.assets) {
        json["assets"][name] = {{"path", asset.path}};
        const auto volume = opened.assets.volumes.find(name);
        if (volume != opened.assets.volumes.end()) {
            const VolumeGrid& grid = volume->second->grid();
            json["assets"][name]["size"] = {grid.size.x, grid.size.y, grid.size.z};
            json["assets"][name]["component"] = nameOf(volume->second->type());
        }
        const auto mesh = opened.assets.meshes.find(name);
        if (mesh != opened.assets.meshes.end()) json["assets"][name]["cells"] = mesh->second->cells().cellCount();
    }
    const auto names = [](const auto& map) {
        Json list = Json::array();
        for (const auto& entry : map) list.push_back(entry.first);
        return list;
    };
    json["objects"] = names(scene.objects);
    json["transfers"] = names(scene.transfers);
    json["lattices"] = latticeNames(scene);
    json["bounds"] = toJson(compiled.root->bounds);
    json["opacityDistance"] = compiled.opacityDistance;
    json["camera"] = {{"eye", toJson(compiled.camera.eye)},
                      {"target", toJson(compiled.camera.target)},
                      {"up", toJson(compiled.camera.up)},
                      {"fovY", compiled.camera.fovY}};
    json["timeline"] = {{"fps", scene.timeline.fps}, {"start", scene.timeline.start}, {"end", scene.timeline.end}};
    return json;
}

void printTable(const Json& json) {
    for (const auto& [name, value] : json.items())
        if (name != "histogram")
            std::cout << name << ": " << (value.is_string() ? value.get<std::string>() : value.dump()) << "\n";
}

int info(const InputArguments& input, bool asJson, const CommonArguments& common) {
    IoClient io;
    Json json;
    if (isMotionFile(input.file)) {
        const MotionFile file = readMotionFile(io, input.file, common);
        if (!asJson) return printMotion(file), 0;
        json = motionJson(file);
    } else if (isSceneFile(input.file)) {
        json = describe(open(io, input, common), input);
    } else {
        json =
            std::visit([](auto&& file) { return describe(std::move(file)); }, readVolumeOrMeshFile(io, input, common));
    }
    if (asJson)
        std::cout << json.dump(2) << "\n";
    else
        printTable(json);
    return 0;
}

}  // namespace

Command addInfoCommand(CLI::App& command, const CommonArguments& common) {
    auto input = std::make_shared<InputArguments>();
    auto json = std::make_shared<bool>(false);
    addInputArguments(command, *input, "file");
    command.add_flag("--json", *json, "As JSON");
    return [input, json, &common] { return info(*input, *json, common); };
}

}  // namespace voledit
