#pragma once
// A picture that `voledit render` makes while the editor goes on.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/scene_process.h"

namespace voledit {

/// What is to be rendered.
struct StillRequest {
    std::filesystem::path out;  // .png or .exr
    Index2 size{960, 720};
    int supersampling = 1;     // 1…4: so many times the pixels along each side, averaged
    bool transparent = false;  // with the picture's transparency, without the background
    std::string renderer;      // "slices", "rays"; empty: slices, or rays where those cannot

    bool operator==(const StillRequest&) const = default;
};

/// "PATH [WxH] [N] [transparent] [slices|rays]", as `file.render-still` takes it; PATH may have spaces. Throws Error
/// for a path that names no picture.
StillRequest parseStillRequest(const std::string& argument);
/// Why `path` names no picture that can be rendered; empty where it does.
std::string problemOfStill(const std::filesystem::path& path);

/// One `voledit render` in the background, on a copy of the scene at the time shown. Stopped with the editor.
class StillJob {
public:
    /// Throws Error: it is rendering already, or the copy cannot be written.
    void start(const StillRequest& request, const Workspace& workspace);
    bool running() const { return process_.running(); }
    /// What is rendered, or was last.
    const StillRequest& request() const { return request_; }
    double fraction() const { return fraction_; }  // 0…1
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
    StillRequest request_;
    SceneProcess process_;
    double fraction_ = 0;
};

}  // namespace voledit
