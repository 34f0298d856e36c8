#pragma once
// A `voledit` command that works on a copy of the scene while the editor goes on.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/animation/child_process.h"
#include "app/editor/workspace.h"

namespace voledit {

/// The scene as it would be saved now: committed steps, with the view as its camera unless the scene's own moves.
Scene sceneToRender(const Workspace& workspace);

/// One process at a time, at low priority; it is stopped with the editor.
class SceneProcess {
public:
    SceneProcess() = default;
    ~SceneProcess();
    SceneProcess(const SceneProcess&) = delete;
    SceneProcess& operator=(const SceneProcess&) = delete;

    /// `arguments` of the command, given where the copy lies. Throws Error where the copy cannot be written.
    void start(const Scene& scene, const std::filesystem::path& folder,
               const std::function<std::vector<std::string>(const std::filesystem::path&)>& arguments);
    bool running() const { return process_ != nullptr; }
    /// Asks it to stop.
    void cancel();
    bool cancelled() const { return cancelled_; }
    /// The next line that it has said.
    std::optional<std::string> readLine() { return process_ ? process_->readLine() : std::nullopt; }

    struct Ended {
        bool done = false;                  // its status was 0
        std::string problem;                // else why
        std::vector<std::string> warnings;  // that it gave
    };
    /// What became of it, once, after its last line was read.
    std::optional<Ended> poll();
    /// Blocks until there is news, or nothing is running.
    void wait() const;

private:
    void removeCopy();

    std::filesystem::path folder_;  // with the copy of the scene
    std::unique_ptr<ChildProcess> process_;
    bool cancelled_ = false;
};

}  // namespace voledit
