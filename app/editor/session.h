#pragma once
// One run of the editor: a platform, an editor, and who drives it.

#include <filesystem>
#include <memory>
#include <optional>

#include "app/editor/editor.h"
#include "app/editor/platform/platform.h"
#include "app/editor/replay.h"

namespace voledit {

/// Ties an editor to where it runs. An event file, a test, or the user at the window drive it frame by frame.
///
/// Headless, what a file opened by an event shows does not depend on how long it took: at the second frame, and before
/// any line that names a place or an action, loading is waited for (so `press Escape` right after it still cancels).
class Session final : public EventHost {
public:
    /// Opens options.file, or the welcome scene. Throws Error where the window cannot be opened, where the recording
    /// cannot be written, and headless where the file cannot be opened.
    explicit Session(const EditorOptions& options);
    ~Session() override;

    /// Runs until the user leaves.
    void runWindow();

    void frame(const std::vector<InputEvent>& events) override;
    bool inputWaits() const override { return editor_->inputWaits(); }
    Vec2 locate(const Place& place) override;
    void act(const std::string& action, const std::string& argument) override;
    void waitIdle() override;
    /// Waits for an animation that is rendered. Throws Error where it failed.
    void finishRendering();
    void saveScreenshot(const std::string& path) override;
    void saveState(const std::string& path) override;
    bool closed() const override { return editor_->finished(); }

    Editor& editor() { return *editor_; }

private:
    void openFirst(const std::filesystem::path& file);
    void drawFrame(FrameInput input);
    void finishLoading();
    void serveScreenshots();

    bool headless_;
    IoClient io_;
    std::unique_ptr<Platform> platform_;
    std::unique_ptr<Editor> editor_;
    std::unique_ptr<Recorder> recorder_;
    int loadingFrames_ = 0;
};

}  // namespace voledit
