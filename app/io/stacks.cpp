#include "app/io/stacks.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>

#include "app/io/check_png.h"
#include "app/io/check_tiff.h"
#include "app/io/checks.h"
#include "app/io/header_text.h"
#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostFiles = 100000;
constexpr int kDeepest = 6;  // DICOMDIR media nest patient, study and series

/// Ordinary files below `folder`, at most `depth` levels down, by name.
std::vector<Source> filesIn(const Source& folder, int depth) {
    std::vector<Source> files;
    std::error_code failed;
    auto walk = fs::recursive_directory_iterator(folder.path, fs::directory_options::skip_permission_denied, failed);
    if (failed) throw Error(folder.name, "cannot be listed (" + failed.message() + ")", "check its permissions");
    for (; walk != fs::recursive_directory_iterator(); walk.increment(failed)) {
        if (failed) break;
        if (walk.depth() >= depth) walk.disable_recursion_pending();
        if (!walk->is_regular_file(failed)) continue;
        if (files.size() == kMostFiles)
            throw Error(folder.name, "holds more than 100000 files", "name a folder with one volume");
        files.push_back(
            {walk->path(), (fs::path(folder.name) / walk->path().lexically_relative(folder.path)).string()});
    }
    std::ranges::sort(files, {}, &Source::path);
    return files;
}

/// Orders "slice9" before "slice10": stretches of digits count as numbers.
bool naturallyBefore(const std::string& a, const std::string& b) {
    const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (!digit(a[i]) || !digit(b[j])) {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i, ++j;
            continue;
        }
        const auto number = [&](const std::string& text, std::size_t& at) {
            while (at + 1 < text.size() && text[at] == '0' && digit(text[at + 1])) ++at;
            const std::size_t start = at;
            while (at < text.size() && digit(text[at])) ++at;
            return text.substr(start, at - start);
        };
        const std::string x = number(a, i), y = number(b, j);
        if (x != y) return std::pair(x.size(), x) < std::pair(y.size(), y);
    }
    return std::pair(a.size() - i, a) < std::pair(b.size() - j, b);
}

std::optional<Format> pictureFormat(const Source& file) {
    const std::string ending = lowered(file.path.extension().string());
    if (ending == ".png") return Format::Png;
    if (ending == ".tif" || ending == ".tiff") return Format::Tiff;
    return std::nullopt;
}

Vec3 checkedSpacing(const std::optional<Vec3>& spacing) {
    if (spacing) checkSpacing("--spacing", *spacing);
    return spacing.value_or(Vec3(1));
}

/// A file name as text, number, text, number, …, text.
std::vector<std::string> partsOf(const std::string& name) {
    std::vector<std::string> parts(1);
    for (const char c : name) {
        const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        if (digit == (parts.size() % 2 == 1)) parts.emplace_back();
        parts.back() += c;
    }
    if (parts.size() % 2 == 0) parts.emplace_back();
    return parts;
}

/// The one part, a number, in which the names differ; nullopt where they differ in others, or in texts.
std::optional<std::size_t> countingPart(const std::vector<std::vector<std::string>>& names) {
    std::optional<std::size_t> counting;
    for (const auto& parts : names) {
        if (parts.size() != names[0].size()) return std::nullopt;
        for (std::size_t n = 0; n < parts.size(); ++n) {
            if (parts[n] == names[0][n] || n == counting) continue;
            if (n % 2 == 0 || counting) return std::nullopt;
            counting = n;
        }
    }
    return counting;
}

/// Warns where the numbers in the names of files, in natural order, have a gap. They may count in steps.
void warnOfGaps(const std::string& name, const std::vector<Source>& files, VolumeSink& sink) {
    std::vector<std::vector<std::string>> names;
    for (const Source& file : files) names.push_back(partsOf(file.path.filename().string()));
    const auto part = countingPart(names);
    if (!part) return;
    std::vector<std::uint64_t> numbers;
    for (const auto& parts : names) {
        if (parts[*part].size() > 18) return;  // no numbers, but a mark of some kind
        numbers.push_back(std::stoull(parts[*part]));
    }
    std::uint64_t step = files.size() > 2 ? 0 : 1;
    for (std::size_t i = 1; i < numbers.size(); ++i) step = std::gcd(step, numbers[i] - numbers[i - 1]);
    for (std::size_t i = 1; i < numbers.size(); ++i)
        if (numbers[i] > numbers[i - 1] + step)
            return sink.warn(name + ": number " + std::to_string(numbers[i - 1] + step) + " is missing behind " +
                             files[i - 1].path.filename().string() + "; the " + std::to_string(files.size()) +
                             " slices there are were stacked without gaps");
}

/// A stack of files in natural order, each checked.
SliceStack stackOf(const std::string& name, std::vector<Source> files, Format format,
                   const std::optional<Vec3>& spacing, VolumeSink& sink) {
    if (files.size() == 1) {
        SliceStack stack = stackOfFile(files.front(), format, spacing, sink);
        stack.name = name;
        return stack;
    }
    std::ranges::sort(files, naturallyBefore, [](const Source& s) { return s.path.filename().string(); });
    warnOfGaps(name, files, sink);
    for (const Source& file : files) {
        if (format == Format::Png) {
            checkPng(file);
        } else if (checkTiff(file, sink).size() > 1) {
            throw Error(file.name, "has several pages, beside other files",
                        "name the one file, or a pattern of files of one page each");
        }
    }
    return {name, format == Format::Png ? "png" : "tiff", std::move(files), {}, checkedSpacing(spacing)};
}

/// True if `name` is `pattern` with "*" standing for anything and "%d", "%03d" … for a number.
bool matches(std::string_view pattern, std::string_view name) {
    if (pattern.empty()) return name.empty();
    if (pattern.front() == '*') {
        for (std::size_t n = 0; n <= name.size(); ++n)
            if (matches(pattern.substr(1), name.substr(n))) return true;
        return false;
    }
    if (pattern.front() == '%') {
        const auto end = pattern.find_first_not_of("0123456789", 1);
        if (end != std::string_view::npos && (pattern[end] == 'd' || pattern[end] == 'i')) {
            std::size_t digits = 0;
            while (digits < name.size() && std::isdigit(static_cast<unsigned char>(name[digits]))) ++digits;
            return digits > 0 && matches(pattern.substr(end + 1), name.substr(digits));
        }
    }
    return !name.empty() && name.front() == pattern.front() && matches(pattern.substr(1), name.substr(1));
}

}  // namespace

DicomFiles dicomFilesIn(const Source& folder) {
    DicomFiles found{folder.name, {}, std::nullopt};
    for (const int depth : {0, kDeepest}) {
        for (Source& file : filesIn(folder, depth))
            if (file.path.filename() != "DICOMDIR" && looksLikeDicom(file)) found.files.push_back(std::move(file));
        if (!found.files.empty()) break;
        if (depth == 0)  // slices here are a stack: nothing below is looked at
            for (const Source& file : filesIn(folder, 0))
                if (pictureFormat(file)) return found;
    }
    return found;
}

DicomFiles seriesOfFile(const Source& file) {
    const Source folder{file.path.parent_path(), fs::path(file.name).parent_path().string()};
    DicomFiles found{file.name, {}, file};
    for (Source& other : filesIn(folder, 0))
        if (other.path == file.path || looksLikeDicom(other)) found.files.push_back(std::move(other));
    return found;
}

SliceStack stackOfFile(const Source& file, Format format, const std::optional<Vec3>& spacing, VolumeSink& sink) {
    SliceStack stack{file.name, format == Format::Png ? "png" : "tiff", {file}, {0}, checkedSpacing(spacing)};
    if (format == Format::Png)
        checkPng(file);
    else
        stack.pages = checkTiff(file, sink);
    return stack;
}

SliceStack stackInFolder(const Source& folder, const std::optional<Vec3>& spacing, VolumeSink& sink) {
    std::map<Format, std::vector<Source>> byFormat;
    for (Source& file : filesIn(folder, 0))
        if (const auto format = pictureFormat(file)) byFormat[*format].push_back(std::move(file));
    if (byFormat.empty())
        throw Error(folder.name, "is a folder without a DICOM series, TIFF or PNG slices",
                    "name a volume file, or a folder of slices");
    const auto most = std::ranges::max_element(byFormat, {}, [](const auto& entry) { return entry.second.size(); });
    if (byFormat.size() > 1)
        sink.warn(folder.name + ": holds PNG and TIFF files; the " + std::to_string(most->second.size()) + " " +
                  (most->first == Format::Png ? "PNG" : "TIFF") + " files were read");
    return stackOf(folder.name, most->second, most->first, spacing, sink);
}

SliceStack stackOfPattern(const Source& pattern, const std::optional<Vec3>& spacing, VolumeSink& sink) {
    const std::string form = pattern.path.filename().string();
    if (std::ranges::count(form, '*') > 4) throw Error(pattern.name, "has more than four *", "write a simpler pattern");
    const Source folder{pattern.path.parent_path(), fs::path(pattern.name).parent_path().string()};
    std::vector<Source> files;
    for (Source& file : filesIn(folder, 0))
        if (pictureFormat(file) && matches(form, file.path.filename().string())) files.push_back(std::move(file));
    if (files.empty()) throw Error(pattern.name, "matches no TIFF or PNG file", "check the pattern and its folder");
    const Format format = *pictureFormat(files.front());
    if (!std::ranges::all_of(files, [&](const Source& file) { return pictureFormat(file) == format; }))
        throw Error(pattern.name, "matches TIFF and PNG files", "name the ending in the pattern");
    return stackOf(pattern.name, std::move(files), format, spacing, sink);
}

}  // namespace voledit
