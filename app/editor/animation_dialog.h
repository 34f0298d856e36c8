#pragma once
// The dialog of File ▸ Render Animation.

#include <optional>
#include <string>

#include "app/editor/animation_job.h"
#include "app/editor/file_browser.h"

namespace voledit {

/// A modal dialog: where to, size, frames, rate, renderer, quality. Its widgets are "Render animation/Path",
/// "…/Browse", "…/Width", "…/Height", "…/First frame", "…/Last frame", "…/Frame rate", "…/Renderer Slices", "…/Quality
/// Good", "…/Resume", "…/Render" and "…/Cancel".
class AnimationDialog {
public:
    /// Opens it in the next frame, for the scene as it is; what was chosen before stays, frames and rate follow the
    /// timeline.
    void show(const Workspace& workspace);
    bool visible() const { return visible_; }

    /// Draws it within the current frame. The request, in the frame in which the user chose Render.
    std::optional<AnimationRequest> draw(const Workspace& workspace);

private:
    void drawPath(const Workspace& workspace);
    void drawFields();
    AnimationRequest request() const;

    bool visible_ = false, opening_ = false;
    FileBrowser browser_;
    std::string path_;
    int width_ = 960, height_ = 720, first_ = 0, last_ = 47, renderer_ = 0, quality_ = 1;
    double fps_ = 24;
    bool resume_ = false;
};

}  // namespace voledit
