#include "app/editor/folder_listing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "app/editor/motion_import.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

}  // namespace

bool isOf(FileKinds kinds, const fs::path& path) {
    if (kinds == FileKinds::All) return true;
    if (kinds == FileKinds::Formulas) return lower(path.extension().string()) == ".stf";
    if (kinds == FileKinds::Motions) return isMotionFile(path);
    static constexpr std::array<const char*, 16> kEndings{".voledit", ".nrrd", ".nhdr", ".nii", ".nii.gz", ".mhd",
                                                          ".mha",     ".dcm",  ".ima",  ".tif", ".tiff",   ".png",
                                                          ".vdb",     ".vtk",  ".hdr",  ".img"};
    const std::string name = lower(path.filename().string());
    return std::any_of(kEndings.begin(), kEndings.end(), [&](const char* ending) { return name.ends_with(ending); });
}

std::vector<BrowserEntry> listFolder(const fs::path& folder, FileKinds kinds, std::string& problem) {
    std::vector<BrowserEntry> entries;
    problem.clear();
    std::error_code code;
    fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, code);
    for (; !code && at != fs::directory_iterator(); at.increment(code)) {
        BrowserEntry entry;
        entry.name = at->path().filename().string();
        std::error_code ignored;
        entry.folder = at->is_directory(ignored);
        if (!entry.folder) entry.bytes = at->is_regular_file(ignored) ? at->file_size(ignored) : 0;
        if (entry.name.starts_with('.') || (!entry.folder && !isOf(kinds, entry.name))) continue;
        entries.push_back(std::move(entry));
    }
    if (code) problem = folder.string() + ": " + code.message();
    std::sort(entries.begin(), entries.end(), [](const BrowserEntry& a, const BrowserEntry& b) {
        if (a.folder != b.folder) return a.folder;
        const std::string x = lower(a.name), y = lower(b.name);
        return x != y ? x < y : a.name < b.name;
    });
    return entries;
}

fs::path pathFromText(const std::string& text, const fs::path& folder) {
    fs::path path = text;
    if (text == "~" || text.starts_with("~/"))
        if (const char* home = std::getenv("HOME"))
            path = fs::path(home) / text.substr(std::min<std::size_t>(2, text.size()));
    if (path.is_relative()) path = folder / path;
    path = path.lexically_normal();
    return path.has_filename() || !path.has_relative_path() ? path : path.parent_path();
}

std::string completed(const std::string& text, const fs::path& folder, FileKinds kinds) {
    const auto slash = text.rfind('/');
    const std::string head = slash == text.npos ? "" : text.substr(0, slash + 1);
    const std::string tail = text.substr(head.size());
    std::string problem, shared;
    int matches = 0;
    bool intoFolder = false;
    for (const BrowserEntry& entry : listFolder(pathFromText(head.empty() ? "." : head, folder), kinds, problem)) {
        if (!entry.name.starts_with(tail)) continue;
        if (matches++ == 0) shared = entry.name;
        const auto end = std::mismatch(shared.begin(), shared.end(), entry.name.begin(), entry.name.end()).first;
        shared.erase(end, shared.end());
        intoFolder = entry.folder;
    }
    if (matches == 0) return text;
    return head + shared + (matches == 1 && intoFolder ? "/" : "");
}

std::string sizeText(std::uintmax_t bytes) {
    static constexpr std::array<const char*, 5> kUnits{"B", "KB", "MB", "GB", "TB"};
    double size = double(bytes);
    std::size_t unit = 0;
    while (size >= 1000 && unit + 1 < kUnits.size()) {
        size /= 1000;
        ++unit;
    }
    std::array<char, 32> text;
    std::snprintf(text.data(), text.size(), unit > 0 && size < 10 ? "%.1f %s" : "%.0f %s", size, kUnits[unit]);
    return text.data();
}

}  // namespace voledit
