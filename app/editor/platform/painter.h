#pragma once
// From an editor's frame to pixels.

#include <optional>
#include <set>
#include <string>

#include "app/editor/editor.h"
#include "app/editor/platform/imgui_renderer.h"
#include "app/editor/platform/viewport_picture.h"
#include "core/base/picture.h"

namespace voledit {

/// Needs a current context, the same one for every call and for destruction.
class Painter {
public:
    /// `headless`: pictures do not depend on time.
    explicit Painter(bool headless);

    /// Lets the viewport's picture follow the editor's last frame, `restMs` of whose budget something else takes. True
    /// where the window shows something new. A problem of the renderer becomes a notice.
    bool update(Editor& editor, double restMs);
    /// Draws the window of the editor's last frame into `framebuffer` (of the window's size).
    void draw(Editor& editor, GLuint framebuffer);
    /// The same to full quality, as a picture of the window.
    Picture screenshot(Editor& editor);

    const PictureSchedule& picture() const { return picture_.schedule(); }

private:
    void clear() const;
    void drawPicture(Editor& editor, GLuint framebuffer);
    void tellNotices(Editor& editor);
    void guarded(Editor& editor, const std::function<void()>& draw);

    ShaderLibrary shaders_;
    ImGuiRenderer interface_;
    ViewportPicture picture_;
    int fontsBuilt_ = 0;
    std::string problem_;          // told last, so that it is told once
    std::set<std::string> noted_;  // what pictures lack that was told
};

}  // namespace voledit
