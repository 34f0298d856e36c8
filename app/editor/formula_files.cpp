#include "app/editor/formula_files.h"

#include <algorithm>
#include <system_error>

#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostRecent = 10;

fs::path fileOf(const std::string& written, const fs::path& folder) {
    const fs::path path = written;
    return path.is_absolute() ? path : folder / path;
}

}  // namespace

FormulaFiles::Known FormulaFiles::look(const fs::path& file) {
    Known known;
    std::error_code problem;
    known.time = fs::last_write_time(file, problem);
    known.there = !problem;
    if (known.there) known.bytes = fs::file_size(file, problem);
    return known;
}

void FormulaFiles::read(const std::string& written, const fs::path& folder, LoadedAssets& assets) {
    const fs::path file = fileOf(written, folder);
    Known& known = known_[written] = look(file);
    try {
        assets.transfers[written] = TransferDefinition::load(file);
    } catch (const Error& error) {
        known.problem = error.what();
        if (!assets.transfers[written]) assets.transfers.erase(written);
        throw;
    }
}

std::vector<FormulaFiles::News> FormulaFiles::refresh(const Scene& scene, const fs::path& folder, LoadedAssets& assets,
                                                      bool always) {
    std::vector<News> news;
    for (const std::string& written : formulaFilesOf(scene)) {
        const bool loaded = assets.transfers.contains(written);
        const Known now = look(fileOf(written, folder));
        const auto before = known_.find(written);
        if (before == known_.end() && loaded && !always) {
            known_[written] = now;  // read when the scene was opened
            continue;
        }
        const bool same = before != known_.end() && before->second.time == now.time &&
                          before->second.bytes == now.bytes && before->second.there == now.there;
        if (same && !always) continue;
        try {
            read(written, folder, assets);
            if (loaded) news.push_back({false, "Read " + written + " again."});
        } catch (const Error& error) {
            const bool kept = assets.transfers.contains(written);
            news.push_back({true, error.what()});
            if (kept) news.back().text = "The last good version is kept. " + news.back().text;
        }
    }
    return news;
}

const std::string& FormulaFiles::problem(const std::string& written) const {
    static const std::string none;
    const auto known = known_.find(written);
    return known == known_.end() ? none : known->second.problem;
}

void FormulaFiles::remember(const fs::path& file) {
    const fs::path path = fs::absolute(file).lexically_normal();
    std::erase(recent_, path);
    recent_.insert(recent_.begin(), path);
    if (recent_.size() > kMostRecent) recent_.resize(kMostRecent);
}

std::vector<fs::path> formulaFilesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code problem;
    for (fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, problem);
         !problem && at != fs::directory_iterator(); at.increment(problem))
        if (at->path().extension() == ".stf") files.push_back(at->path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string writtenPath(const fs::path& file, const fs::path& folder) {
    const fs::path absolute = fs::absolute(file).lexically_normal();
    if (folder.empty()) return absolute.string();
    const fs::path relative = absolute.lexically_relative(fs::absolute(folder).lexically_normal());
    if (relative.empty() || *relative.begin() == "..") return absolute.string();
    return relative.string();
}

}  // namespace voledit
