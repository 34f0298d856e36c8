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

using Motions = std::map<std::string, std::shared_ptr<const Motion>>;  // by path

/// The motion of a file, read once.
std::shared_ptr<const Motion> motion(IoClient& io, const fs::path& path, Motions& known,
                                     std::vector<std::string>& warnings, Progress* progress) {
    auto& motion = known[path.string()];
    if (!motion) {
        MotionFile file = io.readMotion(path, progress);
        warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
        motion = std::move(file.motion);
    }
    return motion;
}

/// Does `read`; an Error is given the asset's name.
template <class Function>
void ofAsset(const std::string& name, const Function& read) {
    try {
        read();
    } catch (const Error& error) {
        throw Error("asset \"" + name + "\" (/assets/" + name + "/path): " + error.what());
    }
}

}  // namespace

LoadedAssets readAssets(IoClient& io, const Scene& scene, const fs::path& folder, const OpenOptions& options,
                        std::vector<std::string>& warnings, Progress* progress) {
    LoadedAssets loaded;
    std::map<std::string, VolumeOrMesh> byPath;
    Motions motions;
    for (const auto& [name, asset] : scene.assets) {
        const fs::path path = assetPath(asset, folder);
        if (asset.kind == AssetKind::Motion)
            ofAsset(name, [&] { loaded.motions[name] = motion(io, path, motions, warnings, progress); });
        if (asset.kind != AssetKind::Volume) continue;
        VolumeOrMesh& file = byPath[path.string()];
        if (!file.volume && !file.mesh)
            ofAsset(name, [&] { file = readVolumeOrMesh(io, path, options, warnings, progress); });
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
    if (isMotionFile(path))
        throw Error(path.string(), "holds a motion, which shows nothing by itself",
                    "open a scene with an actor and import the motion there; voledit info says what it holds");
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
