#pragma once
// Users' formula files (.stf): reading them, and reading them again when they change on disk.

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/opening/formula_files_of.h"
#include "core/scene/compile.h"

namespace voledit {

/// Knows what the formula files of a scene look like on disk. A plain value of the workspace.
class FormulaFiles {
public:
    explicit FormulaFiles(std::vector<std::filesystem::path> recent = {}) : recent_(std::move(recent)) {}

    /// Something to tell the user: a file that was read again, or one that is wrong.
    struct News {
        bool problem = false;
        std::string text;
    };

    /// Reads `file` as `assets.transfers[written]`, the path as the scene writes it, relative to `folder`. Throws
    /// Error, FormulaError; what was read before stays then.
    void read(const std::string& written, const std::filesystem::path& folder, LoadedAssets& assets);
    /// Reads what `scene` names and `assets` lack, and what changed on disk since it was read (all of it with
    /// `always`). A file that is wrong keeps its last good definition.
    std::vector<News> refresh(const Scene& scene, const std::filesystem::path& folder, LoadedAssets& assets,
                              bool always = false);

    /// Why the file that the scene writes as `written` cannot be read as it is now; "" where it can.
    const std::string& problem(const std::string& written) const;

    /// Files added since the editor was started, the last one first, at most ten.
    const std::vector<std::filesystem::path>& recent() const { return recent_; }
    void remember(const std::filesystem::path& file);

private:
    struct Known {
        std::filesystem::file_time_type time;  // of the file when it was looked at last
        std::uintmax_t bytes = 0;
        bool there = false;
        std::string problem;
        bool operator==(const Known&) const = default;
    };
    static Known look(const std::filesystem::path& file);
    std::map<std::string, Known> known_;  // by path as written
    std::vector<std::filesystem::path> recent_;
};

/// The formula files that lie in `folder` itself, sorted.
std::vector<std::filesystem::path> formulaFilesIn(const std::filesystem::path& folder);
/// How a scene in `folder` writes `file`: relative where it lies at or below the folder, else absolute.
std::string writtenPath(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace voledit
