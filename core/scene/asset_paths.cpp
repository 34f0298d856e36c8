#include "core/scene/asset_paths.h"

#include <algorithm>

#include "core/base/paths.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

/// Absolute, links followed as far as the path exists.
fs::path canonicalOf(const fs::path& path) {
    std::error_code failure;
    fs::path canonical = fs::weakly_canonical(fs::absolute(path), failure);
    if (failure) canonical = fs::absolute(path).lexically_normal();
    return canonical.has_filename() ? canonical : canonical.parent_path();
}

bool liesIn(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

AssetRules::AssetRules(const fs::path& sceneFile, bool allowOutside)
    : folder_(canonicalOf(fs::absolute(sceneFile).parent_path())), reach_(folder_), allowOutside_(allowOutside) {
    const fs::path resources = canonicalOf(resourceFolder());
    inResources_ = liesIn(folder_, resources);
    if (inResources_) reach_ = resources;
}

std::string AssetRules::whatIsWrongWith(const std::string& path) const {
    if (path.find('\0') != std::string::npos) return "holds a zero byte, which no path can";
    if (allowOutside_) return "";
    const fs::path asset(path);
    if (asset.is_absolute()) return "is an absolute path; a scene's assets lie at or below its folder";
    const bool climbs = std::find(asset.begin(), asset.end(), "..") != asset.end();
    if (climbs && !inResources_) return "leads out of the scene's folder by `..`; a scene's assets lie at or below it";
    if (!liesIn(canonicalOf(folder_ / asset), reach_))
        return climbs ? "leads out of voledit's resources" : "is a link that leads out of the scene's folder";
    return "";
}

fs::path assetPath(const Asset& asset, const fs::path& sceneFolder) {
    return (sceneFolder / fs::path(asset.path)).lexically_normal();
}

}  // namespace voledit
