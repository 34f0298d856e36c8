#pragma once
// The dope sheet: a row a value, a mark a key; selecting, moving, copying and removing keys by the mouse.

#include <imgui.h>

#include <optional>
#include <vector>

#include "app/editor/timeline/dope_rows.h"
#include "app/editor/timeline/key_move.h"
#include "app/editor/workspace.h"

namespace voledit {

/// Click selects (Shift or Ctrl adds or takes away), a drag of a key moves the selected ones by whole frames (Shift:
/// free; Ctrl: copies), a drag on nothing selects by a box, a double click puts a key, a right click opens a menu.
/// Shapes say how a value goes on: a diamond in a line, a round one smoothly, a square not at all until the next.
class DopeSheet {
public:
    /// Draws the rows in a child of the current window from `min` to `max` (screen pixels), the times within `range`.
    void draw(Workspace& workspace, const TimelineRange& range, const ImVec2& min, const ImVec2& max);
    /// Keys follow the mouse, or a box is drawn: all keys and clicks are for it.
    bool busy() const { return move_.has_value() || box_.has_value(); }
    void cancel(Workspace& workspace);

private:
    struct Hit {
        ImVec2 at;
        std::size_t row = 0, mark = 0;
    };
    void refreshRows(const Workspace& workspace);
    void drawRow(Workspace& workspace, std::size_t row, const ImVec2& min, const ImVec2& max);
    void drawLabel(Workspace& workspace, DopeRow& row, const ImVec2& min, const ImVec2& max);
    void drawMarks(Workspace& workspace, std::size_t row, float y);
    void drawBackground(const Workspace& workspace, const ImVec2& min, const ImVec2& max) const;
    void noteKeys(Workspace& workspace, const DopeRow& row, float y, const ImVec2& min, const ImVec2& max) const;
    void scroll() const;
    void interact(Workspace& workspace, bool hovered);
    void press(Workspace& workspace, const Hit* hit);
    void follow(Workspace& workspace);
    void release(Workspace& workspace);
    void selectBox(Workspace& workspace);
    void doubleClick(Workspace& workspace);
    void drawMenu(Workspace& workspace);
    void drawTooltip(const Workspace& workspace, const Hit& hit) const;
    const Hit* hitAt(const ImVec2& at) const;
    std::optional<std::size_t> rowAt(float y) const;
    double frameUnderMouse() const;

    std::vector<DopeRow> rows_;
    std::optional<Scene> rowsOf_;  // what they were made of
    std::vector<std::string> rowsClosed_;
    std::size_t motions_ = 0;

    TimelineRange range_;
    float scale_ = 1, rowHeight_ = 20, top_ = 0;  // pixels; where the first row begins
    std::vector<Hit> hits_;                       // of this frame

    std::optional<KeyMove> move_;
    bool held_ = false;  // by the left button; else by G until a click
    std::optional<Hit> pressed_;
    bool wasSelected_ = false;  // what was pressed
    ImVec2 pressedAt_{};
    std::optional<ImVec2> box_;  // where a box began
};

}  // namespace voledit
