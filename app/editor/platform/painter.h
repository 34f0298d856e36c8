#pragma once
// From an editor's frame to pixels.

#include <optional>

#include "app/editor/editor.h"
#include "app/editor/platform/imgui_renderer.h"
#include "app/editor/platform/viewport_picture.h"
#include "core/base/picture.h"

namespace voledit {

/// Needs a current context, the same one for every call and for destruction.
class Painter {
public:
    Painter();

    /// Draws the editor's last frame into `framebuffer` (of the window's size); the picture previews or refines for
    /// `budgetMs`. A problem of the renderer becomes a notice.
    void paint(Editor& editor, GLuint framebuffer, double budgetMs);
    /// The same to full quality, as a picture of the window.
    Picture screenshot(Editor& editor);

    const ViewportPicture& picture() const { return picture_; }

private:
    void drawWindow(Editor& editor, GLuint framebuffer);
    void guarded(Editor& editor, const std::function<void()>& draw);

    ShaderLibrary shaders_;
    ImGuiRenderer interface_;
    ViewportPicture picture_;
    int fontsBuilt_ = 0;
    std::string problem_;  // told last, so that it is told once
};

}  // namespace voledit
