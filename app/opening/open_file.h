#pragma once
// Opening what a user names: a scene file or any volume. Shared by the command line and the editor.

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/io_client.h"
#include "core/scene/compile.h"
#include "core/scene/scene_json.h"

namespace voledit {

/// A scene with its files read.
struct OpenedScene {
    Scene scene;
    LoadedAssets assets;
    std::filesystem::path folder;  // what asset paths are relative to
    std::filesystem::path path;    // the scene file; empty where a volume or a mesh was opened
    std::vector<std::string> warnings;
};

struct OpenOptions {
    SceneFileOptions scene;
    ReadOptions read;
};

/// True if `path` is named as a scene (.voledit, .json).
bool isSceneFile(const std::filesystem::path& path);

/// Opens a scene, or a volume or mesh as a new scene with the appearance that suits it. Throws Error, Cancelled.
OpenedScene openFile(IoClient& io, const std::filesystem::path& path, const OpenOptions& options,
                     Progress* progress = nullptr);

/// Reads the volumes, meshes and motions of `scene`'s assets, each file once, and the formula files that its STFs name.
/// Appends warnings. Throws Error that names the asset or the formula file.
LoadedAssets readAssets(IoClient& io, const Scene& scene, const std::filesystem::path& folder,
                        const OpenOptions& options, std::vector<std::string>& warnings, Progress* progress = nullptr);

}  // namespace voledit
