#pragma once
// Where the editor runs: in a window, or offscreen.

#include <memory>

#include "app/editor/editor.h"
#include "app/editor/run_editor.h"
#include "core/base/picture.h"

namespace voledit {

class Platform {
public:
    virtual ~Platform() = default;

    /// Pixels a design pixel that suits the display.
    virtual float displayScale() const = 0;
    /// The window's size in pixels.
    virtual Index2 size() const = 0;
    /// The input since the call before. A window waits for some where `busy` is false, no longer than `atMost` seconds.
    virtual FrameInput nextFrame(bool busy, double atMost = kInfinity) = 0;
    /// Shows the editor's last frame.
    virtual void show(Editor& editor) = 0;
    /// True while the shown picture is not at full quality.
    virtual bool refining() const = 0;
    /// What the window shows, to full quality. Throws Error.
    virtual Picture screenshot(Editor& editor) = 0;
};

/// A GLFW window. Throws Error where there is no display or no OpenGL 4.5.
std::unique_ptr<Platform> makeWindow(const EditorOptions& options);
/// Draws offscreen, and only when a screenshot is wanted: until then no OpenGL is needed. A frame is 1/60 s.
std::unique_ptr<Platform> makeOffscreen(const EditorOptions& options);

}  // namespace voledit
