#include "app/cli/output.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace fs = std::filesystem;

void checkWritable(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
        throw Error(path.string(), "its folder " + folder.string() + " is not there", "make the folder first");
    if (fs::is_directory(path)) throw Error(path.string(), "is a folder", "name a file");
    if (access(folder.c_str(), W_OK) != 0)
        throw Error(path.string(), "its folder cannot be written to", "choose another place or change its permissions");
}

void checkVolumeWritable(const fs::path& path) {
    std::string name = path.filename().string();
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto isEnding = [&](const char* ending) { return name.ends_with(ending); };
    constexpr std::array kEndings{".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd", ".vdb"};
    if (std::none_of(kEndings.begin(), kEndings.end(), isEnding))
        throw Error(path.string(), "its ending names no format that voledit writes",
                    "end it in .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd or .vdb");
    checkWritable(path);
}

void writeTextFile(const fs::path& path, const std::string& text) {
    checkWritable(path);
    const fs::path beside = path.string() + ".part" + std::to_string(getpid());
    bool written = false;
    {
        std::ofstream out(beside, std::ios::binary);
        out << text;
        out.close();
        written = out.good();
    }
    if (written && std::rename(beside.c_str(), path.c_str()) == 0) return;
    const std::string cause = std::strerror(errno);
    std::error_code ignored;
    fs::remove(beside, ignored);
    throw Error(path.string(), "could not be written (" + cause + ")", "check the disk's space and permissions");
}

Camera readCamera(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw Error(path.string(), "cannot be read", "check the name");
    std::string text(1 << 20, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) throw Error(path.string(), "is not a JSON object", "give eye, target, up and fovY");
    // The scene reader checks it, so that there is one set of rules for cameras.
    nlohmann::json scene = {{"voledit", 1},
                            {"assets", {{"v", {{"kind", "volume"}, {"path", "v.nrrd"}}}}},
                            {"root", {{"type", "volume"}, {"asset", "v"}}},
                            {"camera", json.contains("camera") ? json["camera"] : json}};
    return *sceneFromJson(scene.dump(), path).camera;
}

}  // namespace voledit
