#include "app/editor/tools/lattice_tool.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/editor/tools/lattice_overlay.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

constexpr double kReach = 10;         // pixels from a point that still hit it, at scale 1
constexpr double kDragThreshold = 3;  // pixels that a press may wander and still be a click, at scale 1

std::optional<LatticeView> shownLattice(const ToolContext& context) {
    if (!context.compiled || !context.selection.showsLattice()) return std::nullopt;
    auto view = latticeView(context.document.scene(), context.compiled, context.selection.lattice);
    if (!view && !context.selection.lattice.empty()) view = latticeView(context.document.scene(), context.compiled, "");
    return view;
}

bool contains(const std::vector<std::size_t>& sorted, std::size_t value) {
    return std::binary_search(sorted.begin(), sorted.end(), value);
}

std::vector<std::size_t> merged(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
    std::vector<std::size_t> both;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
}

std::vector<std::size_t> toggled(std::vector<std::size_t> points, std::size_t point) {
    const auto at = std::lower_bound(points.begin(), points.end(), point);
    if (at != points.end() && *at == point)
        points.erase(at);
    else
        points.insert(at, point);
    return points;
}

/// Selected points of the shown lattice that it still has (undo may have taken some away).
std::vector<std::size_t> selectedPoints(const ToolContext& context, const LatticeView& view) {
    if (context.selection.lattice != view.name) return {};
    std::vector<std::size_t> points = context.selection.points;
    std::erase_if(points, [&](std::size_t p) { return p >= view.lattice.control.size(); });
    return points;
}

/// Points that have keys get one at the time that is shown.
When whenOf(const ToolContext& context) {
    return {context.compiled ? std::optional(context.compiled->time) : std::nullopt, context.autoKey};
}

std::string countOf(std::size_t points) {
    return points == 1 ? "control point" : std::to_string(points) + " control points";
}

}  // namespace

std::optional<std::size_t> controlPointAt(const LatticeView& view, const Camera& camera, Index2 size, const Vec2& at,
                                          double radius) {
    struct Hit {
        std::size_t point;
        double distance, depth;
    };
    std::vector<Hit> hits;
    double nearest = radius;
    for (std::size_t i = 0; i < view.lattice.control.size(); ++i) {
        const Vec3 pixel = project(camera, size, view.shown(i));
        const double distance = glm::distance(Vec2(pixel), at);
        if (!(pixel.z > 0) || !(distance <= radius)) continue;
        hits.push_back({i, distance, pixel.z});
        nearest = std::min(nearest, distance);
    }
    const Hit* best = nullptr;
    for (const Hit& hit : hits)
        if (hit.distance <= nearest + 1 && (!best || hit.depth < best->depth)) best = &hit;
    return best ? std::optional(best->point) : std::nullopt;
}

bool LatticeTool::pointer(ToolContext context, const PointerEvent& event) {
    pointer_ = event.at;
    switch (event.phase) {
        case PointerPhase::Down:
            return press(context, event);
        case PointerPhase::Move:
            return moved(context, event);
        case PointerPhase::Up:
            return release(context, event);
        case PointerPhase::Leave:
            if (idle()) hovered_.reset();
            return !idle();
        case PointerPhase::DoubleClick:
        case PointerPhase::Wheel:
            return !idle();
    }
    return false;
}

bool LatticeTool::press(ToolContext& context, const PointerEvent& event) {
    emptyClick_ = false;
    if (moving()) {
        if (event.button == PointerButton::Right) cancel(context);
        if (event.button == PointerButton::Left) finishMove(context);
        return true;
    }
    if (event.button != PointerButton::Left) {
        const bool armed = !idle();
        if (armed && event.button == PointerButton::Right) cancel(context);
        return armed;
    }
    const auto view = shownLattice(context);
    pressedAt_ = event.at;
    if (state_ == State::BoxArmed || (view && event.modifiers.ctrl)) {
        state_ = State::Boxing;
        return true;
    }
    if (event.modifiers.alt) return false;
    pressed_ =
        view ? controlPointAt(*view, context.camera, context.size, event.at, kReach * context.scale) : std::nullopt;
    emptyClick_ = !pressed_;
    if (!pressed_) return false;

    const std::vector<std::size_t> selected = selectedPoints(context, *view);
    wasSelected_ = contains(selected, *pressed_);
    if (!wasSelected_)
        context.selection = {view->name,
                             event.modifiers.shift ? merged(selected, {*pressed_}) : std::vector{*pressed_}};
    state_ = State::Pressed;
    return true;
}

bool LatticeTool::moved(ToolContext& context, const PointerEvent& event) {
    const bool far = glm::distance(event.at, pressedAt_) > kDragThreshold * context.scale;
    if (far) emptyClick_ = false;
    if (moving()) {
        move_->move.follow(event.at, event.modifiers.shift);
        previewMove(context);
    } else if (state_ == State::Pressed && far) {
        if (const auto view = shownLattice(context)) {
            pointer_ = pressedAt_;
            beginMove(context, *view, *pressed_);
            state_ = State::Dragging;
            pointer_ = event.at;
            move_->move.follow(event.at, event.modifiers.shift);
            previewMove(context);
        }
    } else if (idle()) {
        const auto view = shownLattice(context);
        hovered_ =
            view ? controlPointAt(*view, context.camera, context.size, event.at, kReach * context.scale) : std::nullopt;
    }
    return !idle();
}

bool LatticeTool::release(ToolContext& context, const PointerEvent& event) {
    if (event.button != PointerButton::Left) return !idle();
    if (idle() || state_ == State::Grabbing || state_ == State::BoxArmed) {
        if (idle() && emptyClick_ && !event.modifiers.shift) context.selection = {};
        emptyClick_ = false;
        return !idle();
    }
    if (state_ == State::Dragging) {
        finishMove(context);
    } else if (state_ == State::Boxing) {
        finishBox(context, event.modifiers.shift);
    } else if (wasSelected_) {
        const auto view = shownLattice(context);
        if (view && event.modifiers.shift)
            context.selection = {view->name, toggled(selectedPoints(context, *view), *pressed_)};
        else if (view)
            context.selection = {view->name, {*pressed_}};
    }
    state_ = State::Idle;
    return true;
}

void LatticeTool::beginMove(ToolContext& context, const LatticeView& view, std::size_t anchor) {
    move_.emplace(Moving{view, selectedPoints(context, view),
                         PointMove(view.shown(anchor), context.camera, context.size, pointer_)});
}

void LatticeTool::previewMove(ToolContext& context) {
    const Vec3 offset = glm::inverse(Mat3(move_->view.shownFromLattice)) * move_->move.offset();
    try {
        context.document.preview(
            [&](Scene& scene) { moveControlPoints(scene, move_->view.name, move_->points, offset, whenOf(context)); });
    } catch (...) {
        cancel(context);
        throw;
    }
}

void LatticeTool::finishMove(ToolContext& context) {
    const std::string name = "Move " + countOf(move_->points.size());
    move_.reset();
    state_ = State::Idle;
    context.document.commit(name);
}

void LatticeTool::finishBox(ToolContext& context, bool add) {
    state_ = State::Idle;
    const auto view = shownLattice(context);
    if (!view) return;
    const Vec2 low = glm::min(pressedAt_, pointer_), high = glm::max(pressedAt_, pointer_);
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < view->lattice.control.size(); ++i) {
        const Vec3 pixel = project(context.camera, context.size, view->shown(i));
        if (pixel.z > 0 && pixel.x >= low.x && pixel.y >= low.y && pixel.x <= high.x && pixel.y <= high.y)
            inside.push_back(i);
    }
    context.selection = {view->name, add ? merged(selectedPoints(context, *view), inside) : inside};
}

bool LatticeTool::grab(ToolContext context) {
    const auto view = shownLattice(context);
    if (!idle() || !view) return false;
    const std::vector<std::size_t> points = selectedPoints(context, *view);
    if (points.empty()) return false;
    // The one nearest to the pointer leads: the others keep their distance to it.
    const auto distance = [&](std::size_t p) {
        const Vec3 pixel = project(context.camera, context.size, view->shown(p));
        return pixel.z > 0 ? glm::distance(Vec2(pixel), pointer_) : kInfinity;
    };
    const std::size_t anchor = *std::min_element(
        points.begin(), points.end(), [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    if (distance(anchor) == kInfinity) return false;
    beginMove(context, *view, anchor);
    state_ = State::Grabbing;
    return true;
}

void LatticeTool::armBox() {
    if (idle()) state_ = State::BoxArmed;
}

void LatticeTool::cancel(ToolContext context) {
    if (moving()) context.document.cancel();
    move_.reset();
    pressed_.reset();
    emptyClick_ = false;
    state_ = State::Idle;
}

bool LatticeTool::key(ToolContext context, const KeyEvent& event) {
    if (idle()) return false;
    if (event.key == "Escape") {
        cancel(context);
    } else if (moving() && !event.modifiers.ctrl && !event.modifiers.alt) {
        if (event.key == "Enter" || event.key == "KeypadEnter")
            finishMove(context);
        else if (move_->move.key(event.key))
            previewMove(context);
    }
    // While something is going on no shortcut may change the scene below it.
    return true;
}

std::optional<std::pair<Vec2, Vec2>> LatticeTool::box() const {
    if (state_ != State::Boxing) return std::nullopt;
    return std::pair(pressedAt_, pointer_);
}

std::string LatticeTool::readout() const {
    return moving() ? "Move " + move_->move.readout() : "";
}

std::string LatticeTool::hint(const ToolContext& context) const {
    switch (state_) {
        case State::Dragging:
            return "X/Y/Z: lock axis  ·  digits: distance  ·  Shift: precise  ·  release: confirm  ·  Esc: cancel";
        case State::Grabbing:
            return "X/Y/Z: lock axis  ·  digits: distance  ·  Shift: precise  ·  Enter or click: confirm  ·  Esc: "
                   "cancel";
        case State::BoxArmed:
        case State::Boxing:
            return "Drag a box over control points  ·  Shift: add  ·  Esc: cancel";
        case State::Pressed:
            return "Drag: move";
        case State::Idle:
            break;
    }
    const auto view = shownLattice(context);
    if (!view) return "";
    if (hovered_) return "Click: select  ·  Shift+click: add or take away  ·  Drag: move";
    if (!selectedPoints(context, *view).empty()) return "G: move  ·  Ctrl+drag or B: select by a box";
    return "Drag a control point: move  ·  Ctrl+drag or B: select by a box";
}

void LatticeTool::fillOverlay(const ToolContext& context, Overlay& overlay) {
    const auto view = shownLattice(context);
    if (!view) return;
    appendLattice(*view,
                  {selectedPoints(context, *view), folded_.of(view->map), hovered_, context.camera, context.scale},
                  overlay);
}

}  // namespace voledit
