#pragma once
// Scene files: JSON to a scene value and back (scene-format.md §1).

#include <filesystem>
#include <string>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace voledit {

struct SceneFileOptions {
    /// Allows absolute paths and `..` in assets. Saving keeps such paths as they are.
    bool allowOutside = false;
};

/// A scene names a file outside its folder and `allowOutside` was not set: a user may be asked and try again.
class OutsideFolderError : public Error {
public:
    using Error::Error;
};

/// Parses and checks `text` against resources/scene.schema.json and the rules that a schema cannot say (names that
/// `use` finds, cycles, finite numbers, control points within the lattice, cell counts). `path` names the file in
/// errors and is where asset paths start. Throws Error with file, JSON pointer, what was found, what was expected; a
/// type of the contract that is not built yet is an Error that says so.
Scene sceneFromJson(const std::string& text, const std::filesystem::path& path, const SceneFileOptions& options = {});

/// The scene as JSON text, indented, in the member order of scene-format.md; `sceneFromJson` gives an equal scene back.
std::string sceneToJson(const Scene& scene);

/// Reads a scene file (at most 256 MiB). Throws Error as above, and when the file cannot be read.
Scene loadScene(const std::filesystem::path& path, const SceneFileOptions& options = {});

/// Writes beside `path` and renames, so that a failure leaves the old file. Paths of assets and formula
/// files, which are relative to `folderNow`, are rewritten relative to the new file's folder. Throws Error.
void saveScene(const Scene& scene, const std::filesystem::path& path, const std::filesystem::path& folderNow);

/// The asset's file: `asset.path` seen from the scene file's folder.
std::filesystem::path assetPath(const Asset& asset, const std::filesystem::path& sceneFolder);

}  // namespace voledit
