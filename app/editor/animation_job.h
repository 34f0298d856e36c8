#pragma once
// An animation that `voledit animate` renders while the editor goes on.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/scene_process.h"

namespace voledit {

/// What is to be rendered.
struct AnimationRequest {
    std::filesystem::path out;  // as `voledit animate -o`
    Index2 size{960, 720};
    std::string frames;    // "A-B"; empty: the whole timeline
    double fps = 0;        // 0: the timeline's
    std::string renderer;  // "slices", "rays"; empty: slices, or rays where those cannot
    int crf = -1;          // quality of the video; below 0: the usual
    bool resume = false;

    bool operator==(const AnimationRequest&) const = default;
};

/// "PATH [WxH] [A-B] [slices|rays] [resume]", as `file.render-animation` takes it; PATH may have spaces. Throws Error
/// for a path that names no video and no pattern of pictures, and for other words behind it.
AnimationRequest parseAnimationRequest(const std::string& argument);

/// One `voledit animate` in the background, on a copy of the scene. Stopped with the editor; finished frames stay.
class AnimationJob {
public:
    /// Throws Error: it is rendering already, or the copy cannot be written.
    void start(const AnimationRequest& request, const Workspace& workspace);
    bool running() const { return process_.running(); }
    /// What is rendered, or was last.
    const AnimationRequest& request() const { return request_; }
    double fraction() const;  // 0…1
    /// "12 of 48 frames, about 2 min left".
    std::string progressText() const;
    /// Asks it to stop; poll() tells when it has.
    void cancel() { process_.cancel(); }

    struct Ended {
        Notice::Kind kind = Notice::Kind::Info;
        std::string text;                   // what the user is told
        std::vector<std::string> warnings;  // what the command warned of
    };
    /// Takes in what the process said; once a frame. What became of it, once it has ended.
    std::optional<Ended> poll();
    /// Blocks until there is news for poll(), or nothing is running.
    void wait() const { process_.wait(); }

private:
    AnimationRequest request_;
    SceneProcess process_;
    int done_ = 0, total_ = 0;
    double secondsLeft_ = -1;
    bool encoding_ = false;
};

}  // namespace voledit
