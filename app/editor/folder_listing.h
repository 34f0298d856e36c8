#pragma once
// What the file dialog shows of folders, and how it understands typed paths.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voledit {

/// One row of the list.
struct BrowserEntry {
    std::string name;
    bool folder = false;
    std::uintmax_t bytes = 0;

    bool operator==(const BrowserEntry&) const = default;
};

/// Which files are shown: all, scenes and volumes, formula files (.stf), motions.
enum class FileKinds : unsigned char { All, Openable, Formulas, Motions };

/// True if the name's ending is one of `kinds`.
bool isOf(FileKinds kinds, const std::filesystem::path& path);
/// Folders first, then files of `kinds`, each by name without regard to case; hidden ones left out. Empty where the
/// folder cannot be read; `problem` then says why.
std::vector<BrowserEntry> listFolder(const std::filesystem::path& folder, FileKinds kinds, std::string& problem);
/// `text` as a path: `~` is the home folder, a relative one starts at `folder`; dots are resolved, no slash at its end.
std::filesystem::path pathFromText(const std::string& text, const std::filesystem::path& folder);
/// The longest way to go on from `text` that all matching entries share; a slash follows a folder (Tab in the path
/// field).
std::string completed(const std::string& text, const std::filesystem::path& folder, FileKinds kinds);
/// "12 KB", "3.4 MB".
std::string sizeText(std::uintmax_t bytes);

}  // namespace voledit
