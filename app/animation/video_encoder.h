#pragma once
// From finished frames to a video, by ffmpeg.

#include <filesystem>
#include <string>
#include <vector>

#include "app/animation/animation_output.h"
#include "core/base/progress.h"
#include "core/base/types.h"

namespace voledit {

struct VideoSettings {
    Index2 size{0};  // of the frames; odd sizes are padded by a copy of the last column or row
    double fps = 24;
    int crf = -1;  // constant rate factor: 0 best … 51 (mp4), 63 (webm); negative: 18 and 30
};

/// Encodes PNG frames to a video with the same bytes every time: H.264 in .mp4, VP9 in .webm, a palette of 256 colours
/// made from all frames in .gif.
class VideoEncoder {
public:
    /// Tries the encoder on one black frame, so that what is missing is known before anything is drawn. Throws Error:
    /// ffmpeg is not installed, lacks the encoder, or cannot encode this size.
    VideoEncoder(AnimationKind kind, const VideoSettings& settings);

    /// Writes `frames`, whole PNG files in order, to `target`, made in `folder` (on the same disk) and renamed. Throws
    /// Error, Cancelled.
    void encode(const std::vector<std::filesystem::path>& frames, const std::filesystem::path& folder,
                const std::filesystem::path& target, Progress* progress) const;

private:
    std::vector<std::string> encoding() const;

    AnimationKind kind_;
    VideoSettings settings_;
};

}  // namespace voledit
