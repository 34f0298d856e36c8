#pragma once
// Selecting, dragging and turning the joints of actors in the viewport: a state machine without a window.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/editor/tools/actor_overlay.h"
#include "app/editor/tools/actor_view.h"
#include "app/editor/tools/joint_turn.h"
#include "app/editor/tools/point_move.h"
#include "app/editor/tools/region_handles.h"
#include "app/editor/tools/tool_context.h"
#include "app/editor/tools/tool_events.h"
#include "core/scene/actor_edits.h"

namespace voledit {

/// Left button on a joint or bone: a click selects it (Shift toggles); dragging a joint brings it under the pointer, in
/// the plane of the view: by IK while posing, a root by moving; while the rig is edited, by moving its rest position,
/// snapped to the medial axis unless Ctrl is held, and the dots on a selected region's faces pull these. Dragging a
/// bone points it. Dragging a ring of the selected joint
/// turns it about that axis of its own, the outer ring about the view. `grab` and `turn` do so without a button, as
/// Blender's G and R. Meanwhile X, Y, Z lock an axis, digits type a distance or degrees, Shift slows down tenfold, Ctrl
/// turns by steps; Enter, a click or a release makes one undo step, Escape or the right button restores.
class JointTool {
public:
    /// True if the tool took the event.
    bool pointer(ToolContext context, const PointerEvent& event);
    /// True if the tool took the key; idle it takes none.
    bool key(ToolContext context, const KeyEvent& event);

    /// The selected joint follows the pointer; turns with it. False where no joint is selected.
    bool grab(ToolContext context);
    bool turn(ToolContext context);
    /// Ends whatever is going on and restores the scene.
    void cancel(ToolContext context);

    bool idle() const { return state_ == State::Idle; }
    /// True while joints follow the pointer.
    bool moving() const { return state_ == State::Dragging || state_ == State::Following; }
    std::string hint(const ToolContext& context) const;
    /// "Rotate X 12.5°" while something goes on; else empty.
    std::string readout() const;
    /// Whether a joint, a bone, a ring or a region's handle is under the pointer.
    bool hoversAny() const { return hovered_ || hoveredRing_ || hoveredFace_; }
    /// Name of the joint under the pointer, for a tooltip; empty where none is.
    std::string hoveredName() const;

    /// Appends the actors, with what is selected and under the pointer.
    void fillOverlay(const ToolContext& context, Overlay& overlay) const;

private:
    enum class State : std::uint8_t { Idle, Pressed, Dragging, Following };
    /// What is dragged: joints, to a place; a bone, to point there; joints, about an axis; a face of a region,
    /// outwards.
    enum class Grip : std::uint8_t { Place, Bone, Ring, Face };
    struct FacePull {
        RegionHandle handle;
        HandlePlace place;      // where it began
        Vec2 last{0}, path{0};  // pointer; pixels from the start, slowed down where asked
    };
    struct Going {
        ActorPtr actor;           // as it was when it began
        double time = 0;          // and when that was, on the scene's clock
        std::vector<int> joints;  // the leading one last
        int to = -1;              // of a bone
        std::variant<PointMove, JointTurn, FacePull> by;
    };

    bool press(ToolContext& context, const PointerEvent& event);
    bool moved(ToolContext& context, const PointerEvent& event);
    bool release(ToolContext& context, const PointerEvent& event);
    void hover(const ToolContext& context, const Vec2& at);
    void select(ToolContext& context, const JointRef& joint, bool toggle);
    void beginMove(const ToolContext& context, const Vec2& at);
    void beginTurn(const ToolContext& context, const ActorPtr& actor, const Vec2& at, std::optional<int> axis);
    void beginPull(const ToolContext& context, const Vec2& at);
    void follow(ToolContext& context, const PointerEvent& event);
    void preview(ToolContext& context);
    Pose wantedPose(const ToolContext& context) const;
    void moveRest(Scene& scene, const ToolContext& context) const;
    std::string stepName(const ToolContext& context) const;
    void finish(ToolContext& context);

    State state_ = State::Idle;
    Grip grip_ = Grip::Place;
    std::optional<JointHit> hovered_, pressed_;
    std::optional<RingHit> hoveredRing_, pressedRing_;
    std::optional<RegionHandle> hoveredFace_, pressedFace_;
    bool wasSelected_ = false;  // before the button went down
    bool toggling_ = false;     // it went down with Shift
    bool snap_ = true;          // to the medial axis
    Vec2 pointer_{0}, pressedAt_{0};
    std::optional<Going> going_;
};

}  // namespace voledit
