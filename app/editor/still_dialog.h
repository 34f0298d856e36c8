#pragma once
// The dialog of File ▸ Render Still.

#include <optional>
#include <string>

#include "app/editor/file_browser.h"
#include "app/editor/still_job.h"

namespace voledit {

/// A modal dialog: where to, size, supersampling, transparency, renderer. Its widgets are "Render still/Path",
/// "…/Browse", "…/Width", "…/Height", "…/Supersampling 2×", "…/Transparent", "…/Renderer Slices", "…/Render" and
/// "…/Cancel".
class StillDialog {
public:
    /// Opens it in the next frame; the size is first the viewport's, what was chosen before stays.
    void show(const Workspace& workspace);
    bool visible() const { return visible_; }

    /// Draws it within the current frame. The request, in the frame in which the user chose Render.
    std::optional<StillRequest> draw(const Workspace& workspace);

private:
    void drawPath(const Workspace& workspace);
    void drawFields();
    StillRequest request() const;

    bool visible_ = false, opening_ = false;
    FileBrowser browser_;
    std::string path_;
    int width_ = 0, height_ = 0, samples_ = 0, renderer_ = 0;
    bool transparent_ = false;
};

}  // namespace voledit
