#include "app/animation/animation_output.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "app/animation/fingerprint.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

AnimationKind kindOf(const fs::path& out) {
    std::string ending = out.extension().string();
    for (char& c : ending) c = char(std::tolower(static_cast<unsigned char>(c)));
    constexpr std::array<std::pair<const char*, AnimationKind>, 5> kEndings{{{".png", AnimationKind::PngFrames},
                                                                             {".exr", AnimationKind::ExrFrames},
                                                                             {".mp4", AnimationKind::Mp4},
                                                                             {".webm", AnimationKind::Webm},
                                                                             {".gif", AnimationKind::Gif}}};
    for (const auto& [name, kind] : kEndings)
        if (ending == name) return kind;
    throw std::invalid_argument(out.string() +
                                ": name a video (.mp4, .webm, .gif) or numbered pictures (frame-%04d.png or .exr)");
}

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}

}  // namespace

AnimationOutput::AnimationOutput(const fs::path& out) : kind_(kindOf(out)) {
    path_ = fs::absolute(out);
    if (isVideo()) {
        before_ = "frame-";
        after_ = ".png";
        digits_ = 6;
        return;
    }
    const std::string name = path_.filename().string();
    const auto fail = [&] {
        throw std::invalid_argument(out.string() +
                                    ": the pictures' name needs exactly one place for the number, "
                                    "%d or %0Nd as in frame-%04d.png, and no other %");
    };
    const auto percent = name.find('%');
    if (percent == std::string::npos || name.find('%', percent + 1) != std::string::npos) fail();
    const auto d = name.find_first_not_of("0123456789", percent + 1);
    if (d == std::string::npos || name[d] != 'd') fail();
    const std::string width = name.substr(percent + 1, d - percent - 1);
    if (!width.empty()) {
        if (width.size() < 2 || width.size() > 3 || width[0] != '0') fail();
        digits_ = std::atoi(width.c_str());
        if (digits_ < 1 || digits_ > 12) fail();
    }
    before_ = name.substr(0, percent);
    after_ = name.substr(d + 1);
}

fs::path AnimationOutput::frameFile(int frame) const {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%0*d", digits_, frame);
    return frameFolder() / (before_ + number.data() + after_);
}

fs::path AnimationOutput::frameFolder() const {
    return isVideo() ? fs::path(path_.string() + ".frames") : path_.parent_path();
}

fs::path AnimationOutput::recordFile() const {
    if (isVideo()) return frameFolder() / "frames.record";
    fs::path cache;
    if (const char* set = std::getenv("XDG_CACHE_HOME"); set && *set)
        cache = set;
    else if (const char* home = std::getenv("HOME"); home && *home)
        cache = fs::path(home) / ".cache";
    if (!cache.is_absolute()) return {};
    std::error_code failed;
    const fs::path canonical = fs::weakly_canonical(path_, failed);
    Fingerprint name;
    name.add(failed ? path_.string() : canonical.string());
    return cache / "voledit" / "animations" / (name.text() + ".record");
}

bool AnimationOutput::isFrameName(const std::string& name) const {
    if (name.size() <= before_.size() + after_.size() || !name.starts_with(before_) || !name.ends_with(after_))
        return false;
    std::string number = name.substr(before_.size(), name.size() - before_.size() - after_.size());
    if (number.size() > 1 && number[0] == '-') number.erase(0, 1);
    return std::all_of(number.begin(), number.end(), isDigit);
}

}  // namespace voledit
