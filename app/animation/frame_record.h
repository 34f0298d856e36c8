#pragma once
// Which frames of an animation are finished, and what they show: what `--resume` may keep.

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "app/animation/animation_output.h"
#include "core/base/types.h"
#include "core/io/channel.h"

namespace voledit {

/// All that a frame's pixels follow from, beside its number.
struct FrameSettings {
    std::string scene;   // fingerprint of the scene and its files
    std::string camera;  // fingerprint of a camera file; empty without one
    std::string renderer;
    Index2 size{0};
    double fps = 24;   // frame n is at n / fps seconds
    double step = -1;  // as `--step`; negative: the scene's
    int supersample = 1;
    bool operator==(const FrameSettings&) const = default;
};

/// A file that was written whole.
struct FinishedFrame {
    int frame = 0;
    std::uintmax_t bytes = 0;
    std::string fingerprint;  // of the file's bytes
    bool operator==(const FinishedFrame&) const = default;
};

/// The file of a finished frame as it is on the disk now. Throws Error where it cannot be read.
FinishedFrame finishedFrame(int frame, const std::filesystem::path& file);

/// What is known of the frames on the disk: one line of settings, then one line a frame,
/// appended when the frame's file is in place. Held by one program at a time.
class FrameRecord {
public:
    /// Opens or makes the record. Without a place for one (an empty `recordFile()`, or a closed cache folder), nothing
    /// is recorded. Throws Error where another program draws the same animation, or the file cannot be made beside a
    /// video's frames.
    explicit FrameRecord(const AnimationOutput& output);

    /// What an earlier run left: why its frames cannot go with `settings` ("the scene changed", …), or empty where they
    /// can, or where there was no record.
    std::string mismatch(const FrameSettings& settings) const;
    /// True if there is a record of an earlier run.
    bool known() const { return known_; }
    /// The frame is recorded and its file is the very one.
    bool holds(int frame, const std::filesystem::path& file) const;

    /// Starts anew for `settings`, keeping what is recorded where `keep`. Throws Error.
    void begin(const FrameSettings& settings, bool keep);
    /// Appends. Throws Error.
    void add(const FinishedFrame& frame);

private:
    void read();
    void write(const std::string& line);

    std::filesystem::path path_;
    FileDescriptor file_;
    bool known_ = false;
    FrameSettings settings_;
    std::map<int, FinishedFrame> frames_;
};

}  // namespace voledit
