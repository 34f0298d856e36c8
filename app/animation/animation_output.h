#pragma once
// Where an animation goes: what OUT names, and the files that belong to it.

#include <filesystem>
#include <string>

#include "app/animation/frame_range.h"

namespace voledit {

enum class AnimationKind : unsigned char { PngFrames, ExrFrames, Mp4, Webm, Gif };

/// OUT of `voledit animate`, checked.
class AnimationOutput {
public:
    /// `out`: a video (.mp4, .webm, .gif) or numbered pictures: a .png or .exr whose name has exactly one %d or %0Nd
    /// (N from 1 to 12) and no other %; folders are taken as they stand. Throws std::invalid_argument saying what is
    /// expected.
    explicit AnimationOutput(const std::filesystem::path& out);

    const std::filesystem::path& path() const { return path_; }  // absolute
    AnimationKind kind() const { return kind_; }
    bool isVideo() const { return kind_ != AnimationKind::PngFrames && kind_ != AnimationKind::ExrFrames; }

    /// The file of frame n: for videos a PNG in `frameFolder`.
    std::filesystem::path frameFile(int frame) const;
    /// Where frames are written: OUT.frames/ of a video, the pattern's own folder of numbered pictures.
    std::filesystem::path frameFolder() const;
    /// Where the record of finished frames is kept: in OUT.frames/ of a video; for numbered pictures, whose folder is
    /// to hold them alone, among the user's cached files ($XDG_CACHE_HOME, else ~/.cache), by the pattern's path. Empty
    /// where there is no such folder.
    std::filesystem::path recordFile() const;
    /// Whether a file of this name could be one of the frames.
    bool isFrameName(const std::string& name) const;

private:
    std::filesystem::path path_;
    AnimationKind kind_;
    std::string before_, after_;  // the name around the number
    int digits_ = 1;
};

}  // namespace voledit
