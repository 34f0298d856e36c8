// Scene files: reading them and laying their text through schema and reader.
#include "core/scene/scene_json.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/error.h"
#include "core/base/paths.h"
#include "core/scene/asset_paths.h"
#include "core/scene/json_schema.h"
#include "core/scene/limits.h"
#include "core/scene/scene_reader.h"

namespace voledit {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const JsonSchema& sceneSchema() {
    static const JsonSchema schema = [] {
        const fs::path path = resourceFolder() / "scene.schema.json";
        std::ifstream file(path);
        if (!file)
            throw Error(path.string(), "cannot be read", "set VOLEDIT_RESOURCES to the folder of voledit's resources");
        try {
            return JsonSchema(nlohmann::ordered_json::parse(file));
        } catch (const json::exception& error) {
            throw Error(path.string(), error.what(), "install voledit again");
        }
    }();
    return schema;
}

void checkVersion(const json& scene, const std::string& file) {
    if (!scene.is_object())
        throw Error(file + ": /", "found " + described(scene) + ", expected a scene object",
                    "a scene starts with { \"voledit\": 1, … }");
    if (!scene.contains("voledit"))
        throw Error(file + ": /", "\"voledit\": 1 is missing, so this is no voledit scene",
                    "name a scene, or add the member");
    const json& version = scene["voledit"];
    if (!version.is_number() || version != 1)
        throw Error(file + ": /voledit", "found format version " + described(version) + "; this voledit understands 1",
                    "open it with the voledit that wrote it");
}

}  // namespace

Scene sceneFromJson(const std::string& text, const fs::path& path, const SceneFileOptions& options) {
    const std::string file = path.string();
    const json scene = parseJson(text, file);
    checkVersion(scene, file);
    if (const auto mistake = sceneSchema().check(scene))
        throw Error(file + ": " + mistake->pointer, mistake->what, mistake->remedy);
    const AssetRules rules(path, options.allowOutside);
    return SceneReader(file, [&](const std::string& asset) { return rules.whatIsWrongWith(asset); }).read(scene);
}

Scene loadScene(const fs::path& path, const SceneFileOptions& options) {
    std::error_code failure;
    const auto status = fs::status(path, failure);
    if (status.type() == fs::file_type::not_found)
        throw Error(path.string(), "there is no such file", "check its name and folder");
    if (failure) throw Error(path.string(), failure.message(), "check the path");
    if (!fs::is_regular_file(status)) throw Error(path.string(), "it is not a file", "name a scene file (*.voledit)");
    const auto size = fs::file_size(path, failure);
    if (failure) throw Error(path.string(), failure.message(), "check that it may be read");
    if (size > kLargestSceneFile)
        throw Error(path.string(),
                    "it has " + std::to_string(size >> 20) + " MiB; a scene file has at most " +
                        std::to_string(kLargestSceneFile >> 20),
                    "keep large data in volume files");
    std::ifstream file(path, std::ios::binary);
    std::string text(size, '\0');
    if (!file || !file.read(text.data(), std::streamsize(size)))
        throw Error(path.string(), "it cannot be read", "check its permissions");
    return sceneFromJson(text, path, options);
}

}  // namespace voledit
