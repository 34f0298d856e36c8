#pragma once
// Outputs are written beside their place and renamed when complete: nothing half-written is ever seen or left.

#include <filesystem>
#include <string>
#include <vector>

namespace voledit {

/// A hidden folder beside the file that is to be written; removed with all in it on destruction. While one is there, an
/// interrupt or a request to end that nobody handles waits for that.
class OutputFolder {
public:
    /// Throws Error where `target` cannot be written: its folder is missing or closed, or it is no regular file.
    /// A symbolic link is followed: what it leads to is replaced.
    explicit OutputFolder(const std::filesystem::path& target);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Where to write: the target's own name, within the hidden folder.
    std::filesystem::path file() const { return folder_ / target_.filename(); }

    /// Moves the files `names` to beside the target, in this order (a header that points to others comes last).
    /// Throws Error.
    void publish(const std::vector<std::string>& names) const;

private:
    std::filesystem::path target_, folder_;
};

}  // namespace voledit
