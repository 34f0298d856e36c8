#pragma once
// All that pointer and keys do in the viewport: the lattice and joint tools first, navigation with what they leave.

#include <string>

#include "app/editor/navigation.h"
#include "app/editor/tools/joint_tool.h"
#include "app/editor/tools/lattice_tool.h"

namespace voledit {

/// Middle drag, or left drag on empty space, or Alt+left drag: orbit. Shift+middle, or Shift+left on empty space: pan.
/// Ctrl+middle drag: zoom. Wheel: zoom towards the pointer. A click on empty space selects nothing. Where a control
/// point and a joint lie under the pointer, the control point is meant.
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
    JointTool& joints() { return joints_; }
    const JointTool& joints() const { return joints_; }

    /// True while the picture is moving under the user's hand: draw fast rather than fine.
    bool active() const { return drag_ != Drag::None || moving(); }
    /// True while something of the scene follows the pointer.
    bool moving() const { return lattice_.moving() || joints_.moving(); }
    /// How far, while it does; else empty.
    std::string readout() const { return lattice_.readout() + joints_.readout(); }
    /// True while a button is held that went down in the viewport: moves outside it are ours too.
    bool capturing() const { return captured_ != PointerButton::None; }
    /// What mouse and keys do now, for the status line.
    std::string hint(const ToolContext& context) const;

private:
    enum class Drag : std::uint8_t { None, Orbit, Pan, Zoom };
    void startDrag(const PointerEvent& event);
    void navigate(ToolContext& context, const PointerEvent& event);

    bool toTools(ToolContext& context, const PointerEvent& event);

    LatticeTool lattice_;
    JointTool joints_;
    Drag drag_ = Drag::None;
    PointerButton captured_ = PointerButton::None;
    Vec2 last_{0};
};

}  // namespace voledit
