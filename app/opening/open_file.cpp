#include "app/opening/open_file.h"

#include "app/opening/formula_files_of.h"
#include "core/base/error.h"
#include "core/scene/appearance.h"
#include "core/scene/edits.h"

namespace voledit {

namespace fs = std::filesystem;

bool isSceneFile(const fs::path& path) {
    return path.extension() == ".voledit" || path.extension() == ".json";
}

namespace {

/// What a file of kind volume holds: one of the two.
struct VolumeOrMesh {
    std::shared_ptr<const Volume> volume;
    std::shared_ptr<const Mesh> mesh;
};

VolumeOrMesh readVolumeOrMesh(IoClient& io, const fs::path& path, const OpenOptions& options,
                              std::vector<std::string>& warnings, Progress* progress) {
    auto file = io.readVolumeOrMesh(path, options.read, progress);
    std::visit([&](auto& any) { warnings.insert(warnings.end(), any.warnings.begin(), any.warnings.end()); }, file);
    if (auto* mesh = std::get_if<MeshFile>(&file))
        return {nullptr, std::make_shared<const Mesh>(std::move(mesh->mesh))};
    return {std::get<VolumeFile>(file).volume, nullptr};
}

}  // namespace

LoadedAssets readAssets(IoClient& io, const Scene& scene, const fs::path& folder, const OpenOptions& options,
                        std::vector<std::string>& warnings, Progress* progress) {
    LoadedAssets loaded;
    std::map<std::string, VolumeOrMesh> byPath;
    for (const auto& [name, asset] : scene.assets) {
        if (asset.kind != AssetKind::Volume) continue;
        const fs::path path = assetPath(asset, folder);
        VolumeOrMesh& file = byPath[path.string()];
        if (!file.volume && !file.mesh) {
            try {
                file = readVolumeOrMesh(io, path, options, warnings, progress);
            } catch (const Error& error) {
                throw Error("asset \"" + name + "\" (/assets/" + name + "/path): " + error.what());
            }
        }
        if (file.volume) loaded.volumes[name] = file.volume;
        if (file.mesh) loaded.meshes[name] = file.mesh;
    }
    for (const std::string& file : formulaFilesOf(scene))
        loaded.transfers[file] = TransferDefinition::load(folder / file);
    return loaded;
}

OpenedScene openFile(IoClient& io, const fs::path& path, const OpenOptions& options, Progress* progress) {
    OpenedScene opened;
    if (isSceneFile(path)) {
        opened.scene = loadScene(path, options.scene);
        opened.folder = fs::absolute(path).parent_path();
        opened.path = path;
        try {
            opened.assets = readAssets(io, opened.scene, opened.folder, options, opened.warnings, progress);
        } catch (const Error& error) {
            throw Error(path.string() + ": " + error.what());
        }
        return opened;
    }
    const VolumeOrMesh file = readVolumeOrMesh(io, path, options, opened.warnings, progress);
    const fs::path absolute = fs::absolute(path).lexically_normal();
    const fs::path named = absolute.has_filename() ? absolute : absolute.parent_path();
    std::string name = named.filename().string();
    name = name.substr(0, name.find('.', 1));
    opened.folder = named.parent_path();
    opened.scene = sceneOfVolume(named.filename().string(), name, file.volume ? suggestedPreset(*file.volume) : "");
    if (file.volume) opened.assets.volumes[name] = file.volume;
    if (file.mesh) opened.assets.meshes[name] = file.mesh;
    return opened;
}

}  // namespace voledit
