#include "app/opening/open_file.h"

#include "core/base/error.h"
#include "core/scene/appearance.h"
#include "core/scene/edits.h"

namespace voledit {

namespace fs = std::filesystem;

bool isSceneFile(const fs::path& path) {
    return path.extension() == ".voledit" || path.extension() == ".json";
}

LoadedVolumes readVolumes(IoClient& io, const Scene& scene, const fs::path& folder, const OpenOptions& options,
                          std::vector<std::string>& warnings, Progress* progress) {
    LoadedVolumes volumes;
    std::map<std::string, std::shared_ptr<const Volume>> byPath;
    for (const auto& [name, asset] : scene.assets) {
        if (asset.kind != AssetKind::Volume) continue;
        const fs::path path = assetPath(asset, folder);
        auto& volume = byPath[path.string()];
        if (!volume) {
            try {
                VolumeFile file = io.readVolume(path, options.read, progress);
                volume = file.volume;
                warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
            } catch (const Error& error) {
                throw Error("asset \"" + name + "\" (/assets/" + name + "/path): " + error.what());
            }
        }
        volumes[name] = volume;
    }
    return volumes;
}

OpenedScene openFile(IoClient& io, const fs::path& path, const OpenOptions& options, Progress* progress) {
    OpenedScene opened;
    if (isSceneFile(path)) {
        opened.scene = loadScene(path, options.scene);
        opened.folder = fs::absolute(path).parent_path();
        opened.path = path;
        try {
            opened.volumes = readVolumes(io, opened.scene, opened.folder, options, opened.warnings, progress);
        } catch (const Error& error) {
            throw Error(path.string() + ": " + error.what());
        }
        return opened;
    }
    VolumeFile file = io.readVolume(path, options.read, progress);
    const fs::path absolute = fs::absolute(path).lexically_normal();
    const fs::path named = absolute.has_filename() ? absolute : absolute.parent_path();
    std::string name = named.filename().string();
    name = name.substr(0, name.find('.', 1));
    opened.folder = named.parent_path();
    opened.scene = sceneOfVolume(named.filename().string(), name, suggestedPreset(*file.volume));
    opened.volumes[name] = file.volume;
    opened.warnings = std::move(file.warnings);
    return opened;
}

}  // namespace voledit
