#include "app/animation/animation_files.h"

#include <algorithm>
#include <vector>

#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::error_code failed;
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder, failed)) entries.push_back(entry.path());
    return entries;
}

/// A folder of core/io/output_folder.h that holds a frame of this animation, or nothing.
bool isLeftover(const AnimationOutput& output, const fs::path& path) {
    std::error_code failed;
    if (!path.filename().string().starts_with(".voledit-") || !fs::is_directory(fs::symlink_status(path, failed)))
        return false;
    const auto inside = entriesOf(path);
    if (inside.empty()) return output.isVideo();
    return std::all_of(inside.begin(), inside.end(),
                       [&](const fs::path& file) { return output.isFrameName(file.filename().string()); });
}

}  // namespace

void makeFrameFolder(const AnimationOutput& output) {
    if (!output.isVideo()) return;
    const fs::path folder = output.frameFolder();
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed || !fs::is_directory(folder, failed))
        throw Error(folder.string(), "cannot be made, and frames are kept there until the video is finished",
                    "remove what has this name, or choose another place");
}

void removeLeftovers(const AnimationOutput& output) {
    std::error_code ignored;
    for (const fs::path& path : entriesOf(output.frameFolder()))
        if (isLeftover(output, path)) fs::remove_all(path, ignored);
}

void removeFrames(const AnimationOutput& output) {
    if (!output.isVideo()) return;
    removeLeftovers(output);
    std::error_code ignored;
    for (const fs::path& path : entriesOf(output.frameFolder())) {
        const std::string name = path.filename().string();
        if (output.isFrameName(name) || path == output.recordFile() || name == "palette.png" || path.stem() == "video")
            fs::remove(path, ignored);
    }
    fs::remove(output.frameFolder(), ignored);
}

}  // namespace voledit
