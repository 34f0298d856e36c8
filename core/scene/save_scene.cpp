// Writing a scene file so that it is there whole or not at all.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/scene/asset_paths.h"
#include "core/scene/scene_children.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace {

namespace fs = std::filesystem;

/// A file beside its place, removed unless it is renamed there.
class FileBeside {
public:
    explicit FileBeside(const fs::path& place) : place_(place), name_(place.string() + ".XXXXXX") {
        file_ = mkstemp(name_.data());
        if (file_ < 0) fail("cannot be written");
    }
    ~FileBeside() {
        if (file_ >= 0) close(file_);
        if (!name_.empty()) unlink(name_.c_str());
    }
    FileBeside(const FileBeside&) = delete;
    FileBeside& operator=(const FileBeside&) = delete;

    void write(const std::string& text) {
        for (std::size_t done = 0; done < text.size();) {
            const ssize_t n = ::write(file_, text.data() + done, text.size() - done);
            if (n < 0 && errno != EINTR) fail("cannot be written");
            if (n > 0) done += std::size_t(n);
        }
    }

    /// With the permissions of the file that it replaces, or those of any new file.
    void putInPlace() {
        struct stat old {};
        const mode_t mask = umask(0);
        umask(mask);
        const mode_t mode = stat(place_.c_str(), &old) == 0 ? old.st_mode & 0777 : 0666 & ~mask;
        if (fchmod(file_, mode) != 0 || fsync(file_) != 0) fail("cannot be written");
        if (rename(name_.c_str(), place_.c_str()) != 0) fail("cannot be replaced");
        name_.clear();
    }

private:
    [[noreturn]] void fail(const std::string& what) {
        const std::string cause = std::strerror(errno);
        throw Error(place_.string(), what + " (" + cause + ")", "check the folder, its permissions and the free space");
    }

    fs::path place_;
    std::string name_;
    int file_ = -1;
};

/// `path`, seen from `folderNow`, as seen from the folder of `target`: relative where the rules for scene files let it
/// be read again, else absolute.
std::string movedPath(const std::string& path, const fs::path& folderNow, const fs::path& target) {
    const fs::path folder = fs::absolute(target).parent_path();
    const fs::path asset = fs::absolute(folderNow / path).lexically_normal();
    std::error_code failure;
    if (fs::equivalent(folder, fs::absolute(folderNow), failure)) return path;
    const std::string relative = asset.lexically_relative(folder.lexically_normal()).string();
    const bool reachable = !relative.empty() && AssetRules(target, false).whatIsWrongWith(relative).empty();
    return reachable ? relative : asset.string();
}

}  // namespace

void saveScene(const Scene& scene, const fs::path& path, const fs::path& folderNow) {
    std::error_code failure;
    // A link stays a link: what it leads to is replaced.
    const fs::path target = fs::exists(path, failure) ? fs::canonical(path, failure) : fs::absolute(path);
    if (failure) throw Error(path.string(), failure.message(), "check the path");
    if (fs::is_directory(target, failure)) throw Error(path.string(), "it is a folder", "name a file in it");
    if (!fs::is_directory(target.parent_path(), failure))
        throw Error(path.string(), "its folder does not exist", "make it, or choose another");
    Scene moved = scene;
    for (auto& [name, asset] : moved.assets) asset.path = movedPath(asset.path, folderNow, target);
    rewriteNodes(moved, [&]<class Node>(const Node& node) -> std::optional<Node> {
        if constexpr (std::is_same_v<Node, Transfer>) {
            const auto* library = std::get_if<LibraryTransfer>(&node.kind);
            if (!library || !library->isFile) return std::nullopt;
            const std::string now = movedPath(library->definition, folderNow, target);
            if (now == library->definition) return std::nullopt;
            Transfer transfer = node;
            std::get<LibraryTransfer>(transfer.kind).definition = now;
            return transfer;
        }
        return std::nullopt;
    });
    const std::string text = sceneToJson(moved);
    FileBeside file(target);
    file.write(text);
    file.putInPlace();
}

}  // namespace voledit
