#include "core/io/output_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const fs::path& target) : target_(fs::absolute(target)) {
    std::error_code failed;
    if (fs::is_symlink(target_, failed)) target_ = fs::weakly_canonical(target_, failed);
    if (!target_.has_filename()) throw Error(target.string(), "names a folder", "name a file to write");
    const fs::file_status there = fs::status(target_, failed);
    if (fs::exists(there) && !fs::is_regular_file(there))
        throw Error(target.string(), "is there already and is no ordinary file", "choose another name");
    std::string name = (target_.parent_path() / ".voledit-XXXXXX").string();
    if (!mkdtemp(name.data()))
        throw Error(target.string(), "cannot write in its folder (" + std::string(std::strerror(errno)) + ")",
                    "make the folder, or choose one that you may write to");
    folder_ = name;
}

OutputFolder::~OutputFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void OutputFolder::publish(const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
        // A name is the parser's word: it must not lead elsewhere.
        if (fs::path(name).filename() != fs::path(name) || name == "." || name == "..")
            throw Error("voledit-io wrote a file of an impossible name, " + name);
        std::error_code failed;
        fs::rename(folder_ / name, target_.parent_path() / name, failed);
        if (failed)
            throw Error((target_.parent_path() / name).string(), "cannot be put in place (" + failed.message() + ")",
                        "check that nothing else uses the name");
    }
}

}  // namespace voledit
