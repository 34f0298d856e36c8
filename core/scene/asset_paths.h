#pragma once
// Where the assets of a scene may lie.

#include <filesystem>
#include <string>

namespace voledit {

/// The rule of scene-format.md: at or below the scene file's folder; for scenes in resources/, anywhere in resources/;
/// anywhere if `allowOutside`. A symbolic link counts as what it leads to.
class AssetRules {
public:
    AssetRules(const std::filesystem::path& sceneFile, bool allowOutside);

    /// What is wrong with `path`, as the end of a sentence that starts with it; "" where it is right. The file need not
    /// exist.
    std::string whatIsWrongWith(const std::string& path) const;

private:
    std::filesystem::path folder_, reach_;  // of the scene, and all that it may reach; canonical
    bool allowOutside_, inResources_;
};

}  // namespace voledit
