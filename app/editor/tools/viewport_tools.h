#pragma once
// All that pointer and keys do in the viewport: the lattice tool first, navigation with what it leaves.

#include <string>

#include "app/editor/navigation.h"
#include "app/editor/tools/lattice_tool.h"

namespace voledit {

/// Middle drag, or left drag on empty space, or Alt+left drag: orbit. Shift+middle, or Shift+left on empty space: pan.
/// Ctrl+middle drag: zoom. Wheel: zoom towards the pointer. A click on empty space selects nothing.
class ViewportTools {
public:
    /// Feeds one event; changes document, selection and camera through the context.
    void pointer(ToolContext context, const PointerEvent& event);
    /// True if a tool took the key; else it is looked up among the actions' shortcuts.
    bool key(ToolContext context, const KeyEvent& event);
    /// Ends what is going on and restores the scene: a lost window focus, a scene closed.
    void cancel(ToolContext context);

    LatticeTool& lattice() { return lattice_; }
    const LatticeTool& lattice() const { return lattice_; }

    /// True while the picture is moving under the user's hand: draw fast rather than fine.
    bool active() const { return drag_ != Drag::None || lattice_.moving(); }
    /// True while a button is held that went down in the viewport: moves outside it are ours too.
    bool capturing() const { return captured_ != PointerButton::None; }
    /// What mouse and keys do now, for the status line.
    std::string hint(const ToolContext& context) const;

private:
    enum class Drag : std::uint8_t { None, Orbit, Pan, Zoom };
    void startDrag(const PointerEvent& event);
    void navigate(ToolContext& context, const PointerEvent& event);

    LatticeTool lattice_;
    Drag drag_ = Drag::None;
    PointerButton captured_ = PointerButton::None;
    Vec2 last_{0};
};

}  // namespace voledit
