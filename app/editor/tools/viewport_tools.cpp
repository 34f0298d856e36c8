#include "app/editor/tools/viewport_tools.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace voledit {

namespace {

double sceneSize(const ToolContext& context) {
    if (context.compiled && context.compiled->root && !context.compiled->root->bounds.empty())
        return glm::length(context.compiled->root->bounds.size());
    return glm::distance(context.camera.eye, context.camera.target);
}

}  // namespace

bool ViewportTools::toTools(ToolContext& context, const PointerEvent& event) {
    if (!joints_.idle()) return joints_.pointer(context, event);
    if (!lattice_.idle()) return lattice_.pointer(context, event);
    // The lattice learns of every move, so that what is under the pointer is known when a button goes down.
    if (event.phase == PointerPhase::Move && lattice_.pointer(context, event)) return true;
    if (lattice_.hovered()) {
        joints_.pointer(context, {PointerPhase::Leave, event.at, PointerButton::None, {}, 0});
        return event.phase != PointerPhase::Move && lattice_.pointer(context, event);
    }
    if (joints_.pointer(context, event)) return true;
    return event.phase != PointerPhase::Move && lattice_.pointer(context, event);
}

void ViewportTools::pointer(ToolContext context, const PointerEvent& event) {
    const bool taken = toTools(context, event);
    if (event.phase == PointerPhase::Down && captured_ == PointerButton::None) {
        captured_ = event.button;
        if (!taken) startDrag(event);
    } else if (event.phase == PointerPhase::Up && event.button == captured_) {
        captured_ = PointerButton::None;
        drag_ = Drag::None;
    } else if (!taken) {
        navigate(context, event);
    }
    last_ = event.at;
}

void ViewportTools::startDrag(const PointerEvent& event) {
    const Modifiers& with = event.modifiers;
    if (event.button == PointerButton::Left)
        drag_ = with.shift ? Drag::Pan : Drag::Orbit;
    else if (event.button == PointerButton::Middle)
        drag_ = with.shift ? Drag::Pan : with.ctrl ? Drag::Zoom : Drag::Orbit;
}

void ViewportTools::navigate(ToolContext& context, const PointerEvent& event) {
    Camera& camera = context.camera;
    if (event.phase == PointerPhase::Wheel) {
        camera = zoomed(camera, context.size, event.at, zoomFactor(event.wheel), sceneSize(context));
        return;
    }
    if (event.phase != PointerPhase::Move) return;
    switch (drag_) {
        case Drag::None:
            break;
        case Drag::Orbit:
            camera = orbitedByDrag(camera, context.size, event.at - last_);
            break;
        case Drag::Pan:
            camera = panned(camera, context.size, last_, event.at, camera.target);
            break;
        case Drag::Zoom: {
            const double factor = std::pow(4.0, (event.at.y - last_.y) / std::max(1, context.size.y) * 2);
            camera = zoomed(camera, context.size, 0.5 * Vec2(context.size), factor, sceneSize(context));
            break;
        }
    }
}

bool ViewportTools::key(ToolContext context, const KeyEvent& event) {
    return joints_.key(context, event) || lattice_.key(context, event);
}

void ViewportTools::cancel(ToolContext context) {
    lattice_.cancel(context);
    joints_.cancel(context);
    drag_ = Drag::None;
    captured_ = PointerButton::None;
}

std::string ViewportTools::hint(const ToolContext& context) const {
    const bool joints = !joints_.idle() || (lattice_.idle() && !lattice_.hovered() && joints_.hoversAny());
    if (joints && drag_ == Drag::None) return joints_.hint(context);
    const std::string lattice = lattice_.hint(context);
    if (!lattice_.idle() || (lattice_.hovered() && drag_ == Drag::None)) return lattice;
    const std::string tool = lattice.empty() ? joints_.hint(context) : lattice;
    switch (drag_) {
        case Drag::Orbit:
            return "Orbit about the target";
        case Drag::Pan:
            return "Pan";
        case Drag::Zoom:
            return "Zoom: drag up or down";
        case Drag::None:
            break;
    }
    const std::string navigation = "Drag: orbit  ·  Shift+drag: pan  ·  Wheel: zoom";
    return tool.empty() ? navigation : tool + "  ·  " + navigation;
}

}  // namespace voledit
