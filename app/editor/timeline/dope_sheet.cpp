#include "app/editor/timeline/dope_sheet.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/editor/theme.h"
#include "app/editor/timeline/dope_marks.h"
#include "app/editor/timeline/keying.h"
#include "app/editor/widgets.h"

namespace voledit {

namespace {

// Design pixels.
constexpr float kRowHeight = 21, kReach = 8, kDragThreshold = 3;

void toggle(std::vector<KeyRef>& keys, const std::vector<KeyRef>& some) {
    const bool all = std::all_of(some.begin(), some.end(), [&](const KeyRef& key) { return contains(keys, key); });
    for (const KeyRef& key : some) {
        if (all)
            std::erase_if(keys, [&](const KeyRef& k) { return k.path == key.path && sameTime(k.time, key.time); });
        else if (!contains(keys, key))
            keys.push_back(key);
    }
}

bool selected(const std::vector<KeyRef>& keys, const DopeMark& mark) {
    return std::all_of(mark.keys.begin(), mark.keys.end(), [&](const KeyRef& key) { return contains(keys, key); });
}

float distance(const ImVec2& a, const ImVec2& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

void DopeSheet::refreshRows(const Workspace& workspace) {
    const Scene& scene = workspace.document.scene();
    const TimelineState& state = workspace.timeline;
    if (rowsOf_ && *rowsOf_ == scene && rowsClosed_ == state.closed && motions_ == workspace.assets.motions.size())
        return;
    rows_ = dopeRows(scene, workspace.assets, state.closed);
    rowsOf_ = scene;
    rowsClosed_ = state.closed;
    motions_ = workspace.assets.motions.size();
}

void DopeSheet::draw(Workspace& workspace, const TimelineRange& range, const ImVec2& min, const ImVec2& max) {
    refreshRows(workspace);
    range_ = range;
    scale_ = workspace.scale;
    rowHeight_ = std::round(kRowHeight * scale_);
    hits_.clear();
    workspace.timeline.shownKeys.clear();
    ImGui::SetCursorScreenPos(min);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    const bool visible = ImGui::BeginChild("##rows", ImVec2(max.x - min.x, max.y - min.y), false,
                                           ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar(2);
    if (visible) {
        top_ = min.y - ImGui::GetScrollY();
        drawBackground(workspace, min, max);
        const float right = min.x + ImGui::GetContentRegionAvail().x;
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            const float y = top_ + float(row) * rowHeight_;
            drawRow(workspace, row, ImVec2(min.x, y), ImVec2(right, y + rowHeight_));
        }
        // The keys of the time that is shown stand before its line.
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.PushClipRect(ImVec2(float(range_.left), min.y), ImVec2(right, max.y), true);
        const double now = workspace.time * workspace.document.scene().timeline.fps;
        drawPlayhead(list, range_.pixelOf(now), min.y, max.y, 0.75f * scale_);
        for (std::size_t row = 0; row < rows_.size(); ++row)
            drawMarks(workspace, row, std::round(top_ + (float(row) + 0.5f) * rowHeight_));
        list.PopClipRect();
        const bool hovered = ImGui::IsWindowHovered() && ImGui::GetIO().MousePos.x >= range_.left;
        interact(workspace, hovered);
        drawMenu(workspace);
        scroll();
        ImGui::SetCursorScreenPos(ImVec2(min.x, top_ + float(rows_.size()) * rowHeight_));
        ImGui::Dummy(ImVec2(1, 1));
    }
    ImGui::EndChild();
}

// The wheel zooms over the keys and scrolls over the names, or with Shift.
void DopeSheet::scroll() const {
    const ImGuiIO& io = ImGui::GetIO();
    if (io.MouseWheel == 0 || !ImGui::IsWindowHovered() || (io.MousePos.x >= range_.left && !io.KeyShift)) return;
    ImGui::SetScrollY(ImGui::GetScrollY() - 3 * rowHeight_ * io.MouseWheel);
}

// ---- What is drawn ------------------------------------------------------------------------------------------------

void DopeSheet::drawBackground(const Workspace& workspace, const ImVec2& min, const ImVec2& max) const {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Timeline& timeline = workspace.document.scene().timeline;
    list.AddRectFilled(ImVec2(float(range_.left), min.y), max, packed(theme::kField));
    const auto pixel = [&](double frame) {
        return float(std::clamp(range_.pixelOf(frame), range_.left, double(max.x)));
    };
    list.AddRectFilled(ImVec2(pixel(timeline.start), min.y), ImVec2(pixel(timeline.end), max.y),
                       packed(theme::kPanel, 0.75f));
}

void DopeSheet::drawRow(Workspace& workspace, std::size_t index, const ImVec2& min, const ImVec2& max) {
    const ImVec2 clipMin = ImGui::GetWindowPos();
    const float clipBottom = clipMin.y + ImGui::GetWindowHeight();
    DopeRow& row = rows_[index];
    const float middle = std::round(0.5f * (min.y + max.y));
    noteKeys(workspace, row, middle, clipMin, ImVec2(max.x, clipBottom));
    if (workspace.timeline.reveal == row.id && row.kind == DopeRow::Kind::Value && !row.id.empty()) {
        const float top = float(index) * rowHeight_;
        const float scroll = ImGui::GetScrollY(), height = ImGui::GetWindowHeight();
        if (top < scroll) ImGui::SetScrollY(top);
        if (top + rowHeight_ > scroll + height) ImGui::SetScrollY(top + rowHeight_ - height);
        workspace.timeline.reveal.clear();
    }
    if (max.y < clipMin.y || min.y > clipBottom) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (row.kind == DopeRow::Kind::Summary || row.kind == DopeRow::Kind::Node)
        list.AddRectFilled(min, max, packed(theme::kHeader, row.kind == DopeRow::Kind::Summary ? 0.9f : 0.55f));
    list.AddRectFilled(ImVec2(min.x, max.y - 1), max, packed(theme::kLine, 0.5f));
    drawLabel(workspace, row, min, ImVec2(float(range_.left), max.y));
    if (row.kind != DopeRow::Kind::Motion) return;
    list.PushClipRect(ImVec2(float(range_.left), min.y), max, true);
    drawStrip(list, row, range_, workspace, min.y, max.y);
    list.PopClipRect();
}

void DopeSheet::drawLabel(Workspace& workspace, DopeRow& row, const ImVec2& min, const ImVec2& max) {
    const bool node = row.kind == DopeRow::Kind::Node;
    ImGui::PushID(row.id.c_str());
    ImGui::PushID(int(row.kind));
    ImGui::SetCursorScreenPos(min);
    const bool clicked = ImGui::InvisibleButton("##label", ImVec2(max.x - min.x, max.y - min.y));
    const bool hovered = ImGui::IsItemHovered();
    noteWidget(row.label);
    ImGui::PopID();
    ImGui::PopID();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (hovered) list.AddRectFilled(min, max, packed(theme::kText, 0.05f));
    drawRowLabel(list, row, ImVec4(min.x, min.y, max.x, max.y), scale_);
    if (!clicked) return;
    std::vector<std::string>& closed = workspace.timeline.closed;
    if (node && ImGui::GetIO().MousePos.x < min.x + 24 * scale_) {
        if (row.open)
            closed.push_back(row.id);
        else
            std::erase(closed, row.id);
        return;
    }
    // All keys of what the row stands for.
    std::vector<KeyRef> keys;
    for (const DopeMark& mark : row.marks) keys.insert(keys.end(), mark.keys.begin(), mark.keys.end());
    const ImGuiIO& io = ImGui::GetIO();
    if (!io.KeyShift && !io.KeyCtrl) workspace.timeline.keys.clear();
    toggle(workspace.timeline.keys, keys);
}

void DopeSheet::drawMarks(Workspace& workspace, std::size_t index, float y) {
    const DopeRow& row = rows_[index];
    const float top = ImGui::GetWindowPos().y;
    if (y + rowHeight_ < top || y - rowHeight_ > top + ImGui::GetWindowHeight()) return;
    const Timeline& timeline = workspace.document.scene().timeline;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    ImVec2 last{};
    for (std::size_t n = 0; n < row.marks.size(); ++n) {
        const DopeMark& mark = row.marks[n];
        const ImVec2 at(std::round(float(range_.pixelOf(mark.time * timeline.fps))), y);
        const bool held = n > 0 && row.marks[n - 1].interpolation == Track::Interpolation::Step;
        if (n > 0 && !held && row.kind == DopeRow::Kind::Value) drawSpan(list, last, at, scale_);
        last = at;
        if (at.x < range_.left - 20 || at.x > range_.left + range_.width + 20) continue;
        hits_.push_back({at, index, n});
    }
    for (const Hit& hit : hits_) {
        if (hit.row != index) continue;
        const DopeMark& mark = row.marks[hit.mark];
        MarkLook look{.selected = selected(workspace.timeline.keys, mark),
                      .hovered = !busy() && distance(hit.at, mouse) <= kReach * scale_,
                      .small = row.kind != DopeRow::Kind::Value,
                      .interpolation = mark.mixed ? Track::Interpolation::Linear : mark.interpolation};
        drawMark(list, hit.at, look, scale_);
    }
}

// Also what is scrolled out of sight, and the values of closed rows: for event files.
void DopeSheet::noteKeys(Workspace& workspace, const DopeRow& row, float y, const ImVec2& min,
                         const ImVec2& max) const {
    if (row.kind != DopeRow::Kind::Value) return;
    const Timeline& timeline = workspace.document.scene().timeline;
    int index = 0;
    for (const DopeMark& mark : row.marks) {
        const Vec2 at(std::round(range_.pixelOf(mark.time * timeline.fps)), y);
        const bool visible = at.x >= range_.left && at.x < max.x && at.y >= min.y && at.y < max.y;
        workspace.timeline.shownKeys.push_back({row.id, index++, at, visible});
    }
}

void DopeSheet::drawTooltip(const Workspace& workspace, const Hit& hit) const {
    const DopeRow& row = rows_[hit.row];
    ImGui::BeginTooltip();
    const std::string text = textOf(row, row.marks[hit.mark], workspace.document.scene());
    ImGui::TextUnformatted(text.c_str());
    ImGui::EndTooltip();
}

// ---- Mouse --------------------------------------------------------------------------------------------------------

const DopeSheet::Hit* DopeSheet::hitAt(const ImVec2& at) const {
    const Hit* best = nullptr;
    for (const Hit& hit : hits_)
        if (distance(hit.at, at) <= kReach * scale_ && (!best || distance(hit.at, at) < distance(best->at, at)))
            best = &hit;
    return best;
}

std::optional<std::size_t> DopeSheet::rowAt(float y) const {
    const auto row = std::ptrdiff_t(std::floor((y - top_) / rowHeight_));
    if (row < 0 || row >= std::ptrdiff_t(rows_.size())) return std::nullopt;
    return std::size_t(row);
}

double DopeSheet::frameUnderMouse() const {
    return range_.frameAt(ImGui::GetIO().MousePos.x);
}

void DopeSheet::cancel(Workspace& workspace) {
    if (move_) workspace.timeline.keys = move_->cancel(workspace.document);
    move_.reset();
    box_.reset();
    pressed_.reset();
}

void DopeSheet::interact(Workspace& workspace, bool hovered) {
    TimelineState& state = workspace.timeline;
    const ImGuiIO& io = ImGui::GetIO();
    const auto grab = std::exchange(state.grabWanted, TimelineState::Grab::None);
    if (grab != TimelineState::Grab::None && !busy() && !state.keys.empty()) {
        held_ = false;
        move_.emplace(state.keys, state.keys.front().time, frameUnderMouse(), grab == TimelineState::Grab::Copy);
    }
    if (busy() && (ImGui::IsKeyPressed(int(Key::Escape), false) || ImGui::IsMouseClicked(ImGuiMouseButton_Right)))
        return cancel(workspace);
    if (move_ && !held_) {
        follow(workspace);
        const bool done = ImGui::IsMouseClicked(ImGuiMouseButton_Left) || ImGui::IsKeyPressed(int(Key::Enter), false) ||
                          ImGui::IsKeyPressed(int(Key::KeypadEnter), false);
        if (done) release(workspace);
        return;
    }
    const Hit* hit = hovered ? hitAt(io.MousePos) : nullptr;
    if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !hit)
        doubleClick(workspace);
    else if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        press(workspace, hit);
    if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        if (hit && !selected(state.keys, rows_[hit->row].marks[hit->mark]))
            state.keys = rows_[hit->row].marks[hit->mark].keys;
        ImGui::OpenPopup("##keys");
    }
    if (pressed_ || box_) {
        follow(workspace);
        if (!io.MouseDown[ImGuiMouseButton_Left]) release(workspace);
    } else if (hit) {
        drawTooltip(workspace, *hit);
    }
}

void DopeSheet::press(Workspace& workspace, const Hit* hit) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool add = io.KeyShift || io.KeyCtrl;
    std::vector<KeyRef>& keys = workspace.timeline.keys;
    pressedAt_ = io.MousePos;
    if (!hit) {
        box_ = io.MousePos;
        return;
    }
    const DopeMark& mark = rows_[hit->row].marks[hit->mark];
    wasSelected_ = selected(keys, mark);
    if (!wasSelected_) {
        if (!add) keys.clear();
        toggle(keys, mark.keys);
    }
    pressed_ = *hit;
}

void DopeSheet::follow(Workspace& workspace) {
    const ImGuiIO& io = ImGui::GetIO();
    std::vector<KeyRef>& keys = workspace.timeline.keys;
    if (pressed_ && !move_ && distance(io.MousePos, pressedAt_) > kDragThreshold * scale_) {
        const double anchor = rows_[pressed_->row].marks[pressed_->mark].time;
        held_ = true;
        move_.emplace(keys, anchor, range_.frameAt(pressedAt_.x), io.KeyCtrl);
    }
    if (move_) keys = move_->follow(workspace.document, frameUnderMouse(), io.KeyShift);
    if (box_) drawBox(*ImGui::GetWindowDrawList(), *box_, io.MousePos, scale_);
}

void DopeSheet::release(Workspace& workspace) {
    const ImGuiIO& io = ImGui::GetIO();
    std::vector<KeyRef>& keys = workspace.timeline.keys;
    if (move_) {
        move_->finish(workspace.document);
    } else if (box_) {
        selectBox(workspace);
    } else if (pressed_ && wasSelected_ && pressed_->row < rows_.size() &&
               pressed_->mark < rows_[pressed_->row].marks.size()) {
        const std::vector<KeyRef> mark = rows_[pressed_->row].marks[pressed_->mark].keys;
        if (io.KeyShift || io.KeyCtrl)
            toggle(keys, mark);
        else
            keys = mark;
    }
    move_.reset();
    box_.reset();
    pressed_.reset();
}

void DopeSheet::selectBox(Workspace& workspace) {
    const ImGuiIO& io = ImGui::GetIO();
    std::vector<KeyRef>& keys = workspace.timeline.keys;
    if (!io.KeyShift && !io.KeyCtrl) keys.clear();
    if (distance(*box_, io.MousePos) <= kDragThreshold * scale_) return;
    const ImRect box(ImMin(*box_, io.MousePos), ImMax(*box_, io.MousePos));
    for (const Hit& hit : hits_) {
        if (!box.Contains(hit.at)) continue;
        for (const KeyRef& key : rows_[hit.row].marks[hit.mark].keys)
            if (!contains(keys, key)) keys.push_back(key);
    }
}

void DopeSheet::doubleClick(Workspace& workspace) {
    const auto row = rowAt(ImGui::GetIO().MousePos.y);
    if (!row || rows_[*row].values.empty()) return;
    const std::vector<ValuePath> values = rows_[*row].values;
    box_.reset();
    insertKeys(workspace, values, timeOfFrame(std::round(frameUnderMouse()), workspace.document.scene().timeline));
}

void DopeSheet::drawMenu(Workspace& workspace) {
    if (std::exchange(workspace.timeline.menuWanted, false)) ImGui::OpenPopup("##keys");
    if (!ImGui::BeginPopup("##keys")) return;
    const WidgetScope scope("Keys");
    const Actions& actions = workspace.actions;
    const auto run = [&](const char* label, const char* id, const char* argument) {
        const Action* action = actions.find(id);
        if (ImGui::MenuItem(label, nullptr, false, action && action->isEnabled())) actions.run(id, argument);
        noteWidget(label);
    };
    run("Step", "key.interpolation", "step");
    run("Linear", "key.interpolation", "linear");
    run("Smooth", "key.interpolation", "smooth");
    ImGui::Separator();
    for (const char* id : {"key.duplicate", "key.delete"}) ui::actionMenuItem(actions, id);
    ImGui::Separator();
    for (const char* id : {"key.select-all", "timeline.frame-all"}) ui::actionMenuItem(actions, id);
    ImGui::EndPopup();
}

}  // namespace voledit
