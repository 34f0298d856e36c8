// `voledit sample`: values of a volume, a mesh or a scene at points.

#include <CLI/App.hpp>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "core/eval/term_path.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

struct SampleArguments {
    InputArguments input;
    std::vector<std::string> at;
    bool json = false;
    double time = kNaN;
};

Json toJson(const Vec3& v) {
    return isDefined(v) ? Json{v.x, v.y, v.z} : Json(nullptr);
}
Json toJson(double v) {
    return v == v ? Json(v) : Json(nullptr);
}

/// values[channel] of each point.
Json samplesOf(const std::vector<Vec3>& points, const std::vector<std::vector<double>>& values) {
    Json samples = Json::array();
    for (std::size_t i = 0; i < points.size(); ++i) {
        Json value;
        if (values.size() == 1) {
            value = toJson(values[0][i]);
        } else if (values[0][i] == values[0][i]) {
            for (const auto& channel : values) value.push_back(toJson(channel[i]));
        }
        samples.push_back({{"at", toJson(points[i])}, {"value", value}});
    }
    return samples;
}

Json sampleFile(const VolumeFile& file, const std::vector<Vec3>& points) {
    const int channels = file.volume->grid().channels;
    std::vector<std::vector<double>> values(std::size_t(channels), std::vector<double>(points.size()));
    for (int c = 0; c < channels; ++c) file.volume->sample(points, values[std::size_t(c)], c);
    return samplesOf(points, values);
}

Json sampleFile(MeshFile file, const std::vector<Vec3>& points) {
    const auto mesh = std::make_shared<const Mesh>(std::move(file.mesh));
    std::vector<std::vector<double>> values(std::size_t(mesh->channels()), std::vector<double>(points.size()));
    for (int c = 0; c < mesh->channels(); ++c) MeshField(mesh, c).sample(points, values[std::size_t(c)]);
    return samplesOf(points, values);
}

Json pathOf(const Term& root, const Vec3& p) {
    Json path = Json::array();
    for (const PathPoint& entry : pathThrough(root, p))
        path.push_back({{"name", entry.name}, {"point", toJson(entry.point)}});
    return path;
}

Json sampleScene(const CompiledScene& scene, const std::vector<Vec3>& points) {
    std::vector<ObjectSample> found(points.size());
    sample(*scene.root, points, found, false);
    Json samples = Json::array();
    for (std::size_t i = 0; i < points.size(); ++i)
        samples.push_back({{"at", toJson(points[i])},
                           {"opacity", found[i].opacity},
                           {"color", toJson(found[i].opacity > 0 ? found[i].color : Vec3(0))},
                           {"path", pathOf(*scene.root, points[i])}});
    return samples;
}

int sampleCommand(const SampleArguments& a, const CommonArguments& common) {
    std::vector<Vec3> points;
    for (const std::string& text : a.at) {
        const auto v = parseNumbers(text, 3, "--at");
        points.push_back({v[0], v[1], v[2]});
    }
    IoClient io;
    Json json;
    if (isSceneFile(a.input.file)) {
        const OpenedScene opened = open(io, a.input, common);
        json["samples"] = sampleScene(compileAt(opened, a.input, a.time), points);
    } else {
        json["samples"] = std::visit([&](auto&& file) { return sampleFile(std::move(file), points); },
                                     readVolumeOrMeshFile(io, a.input, common));
    }
    if (a.json) {
        std::cout << json.dump(2) << "\n";
    } else {
        for (const Json& s : json["samples"]) std::cout << s.dump() << "\n";
    }
    return 0;
}

}  // namespace

Command addSampleCommand(CLI::App& command, const CommonArguments& common) {
    auto a = std::make_shared<SampleArguments>();
    addInputArguments(command, a->input, "file");
    command.add_option("--at", a->at, "World point; give it again for more")
        ->required()
        ->allow_extra_args(false)
        ->type_name("x,y,z");
    command.add_flag("--json", a->json, "As JSON");
    command.add_option("--time", a->time, "Time in seconds (the timeline's start)")->type_name("S");
    return [a, &common] { return sampleCommand(*a, common); };
}

}  // namespace voledit
