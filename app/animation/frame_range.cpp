#include "app/animation/frame_range.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/base/error.h"

namespace voledit {

namespace {

std::optional<int> wholeNumber(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || std::abs(double(value)) > 1e9) return std::nullopt;
    return value;
}

FrameRange checked(const FrameRange& range, const std::string& where) {
    if (double(range.last) - range.first + 1 > kMostFrames)
        throw Error(where, "more than " + std::to_string(kMostFrames) + " frames", "give a shorter range of frames");
    return range;
}

}  // namespace

FrameRange parseFrameRange(const std::string& text) {
    // A dash at the very start is a sign.
    const auto dash = text.find('-', 1);
    const auto first = wholeNumber(std::string_view(text).substr(0, dash));
    const auto last = dash == std::string::npos ? first : wholeNumber(std::string_view(text).substr(dash + 1));
    if (!first || !last || *first > *last)
        throw Error("frames " + text, "not a range of frames",
                    "give the first and the last frame's number, both included, e.g. 0-47");
    return checked({*first, *last}, "frames " + text);
}

FrameRange framesOf(const Timeline& timeline, double fps) {
    // Rounding must not add a frame: 48 / 24 · 30 is 60, not 60.000001.
    const auto firstNotBefore = [&](int frame) { return std::ceil(frame / timeline.fps * fps - 1e-6); };
    const double first = firstNotBefore(timeline.start), end = firstNotBefore(timeline.end);
    if (!(end > first))
        throw Error("timeline", "has no frame between its start and its end", "give --frames A-B, or a later end");
    if (!(std::abs(first) <= 1e9 && std::abs(end) <= 1e9))
        throw Error("timeline", "has frame numbers beyond 10⁹ at this rate", "give --frames A-B, or a smaller --fps");
    return checked({int(first), int(end) - 1}, "timeline");
}

}  // namespace voledit
