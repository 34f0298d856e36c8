#pragma once
// Selecting and moving control points in the viewport: a state machine without a window.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/editor/tools/folded_points.h"
#include "app/editor/tools/lattice_view.h"
#include "app/editor/tools/point_move.h"
#include "app/editor/tools/tool_context.h"
#include "app/editor/tools/tool_events.h"
#include "render/overlay.h"

namespace voledit {

/// Left button on a point: click selects it (Shift toggles), dragging moves the selection in the plane of the view
/// through the grabbed point, which stays under the pointer. Ctrl+drag, or B and a drag, selects by a box (Shift adds).
/// A click on empty space selects nothing. While points move: X, Y, Z lock to a world axis (the same key again frees),
/// digits type a distance, Shift slows down tenfold, Enter, a click or a release commits one undo step, Escape or the
/// right button restores. `grab` moves the selection without a button, as Blender's G.
class LatticeTool {
public:
    /// True if the tool took the event: navigation must not act on it.
    bool pointer(ToolContext context, const PointerEvent& event);
    /// True if the tool took the key. Idle it takes none: those are actions (tools/tool_actions.h).
    bool key(ToolContext context, const KeyEvent& event);

    /// Starts moving the selection with the pointer, no button held. False where nothing is selected.
    bool grab(ToolContext context);
    /// The next drag selects by a box.
    void armBox();
    /// Ends whatever is going on and restores the scene.
    void cancel(ToolContext context);

    bool idle() const { return state_ == State::Idle; }
    /// True while points follow the pointer.
    bool moving() const { return move_.has_value(); }
    /// What the mouse and keys would do now, for the status line.
    std::string hint(const ToolContext& context) const;
    /// "Move X  12.5" while moving; else empty. To be shown beside the pointer.
    std::string readout() const;
    /// Opposite corners of the selection box in viewport pixels while one is drawn.
    std::optional<std::pair<Vec2, Vec2>> box() const;
    /// The control point under the pointer, of the shown lattice.
    std::optional<std::size_t> hovered() const { return hovered_; }

    /// Appends the shown lattice: the box at rest, edges, points (selected, hovered, folding).
    void fillOverlay(const ToolContext& context, Overlay& overlay);

private:
    enum class State : std::uint8_t { Idle, Pressed, Dragging, Grabbing, BoxArmed, Boxing };

    bool press(ToolContext& context, const PointerEvent& event);
    bool moved(ToolContext& context, const PointerEvent& event);
    bool release(ToolContext& context, const PointerEvent& event);
    void beginMove(ToolContext& context, const LatticeView& view, std::size_t anchor);
    void previewMove(ToolContext& context);
    void finishMove(ToolContext& context);
    void finishBox(ToolContext& context, bool add);

    State state_ = State::Idle;
    std::optional<std::size_t> hovered_;
    std::optional<std::size_t> pressed_;  // the point that the button went down on
    bool wasSelected_ = false;            // before it went down
    bool emptyClick_ = false;             // the button went down on empty space and has not moved since
    Vec2 pointer_{0};
    Vec2 pressedAt_{0};

    struct Moving {
        LatticeView view;  // as it was when the move began
        std::vector<std::size_t> points;
        PointMove move;
    };
    std::optional<Moving> move_;
    FoldedPoints folded_;
};

/// The control point of `view` nearest to pixel `at` and no further than `radius` pixels; of several as near (within a
/// pixel) the one nearest to the eye.
std::optional<std::size_t> controlPointAt(const LatticeView& view, const Camera& camera, Index2 size, const Vec2& at,
                                          double radius);

}  // namespace voledit
