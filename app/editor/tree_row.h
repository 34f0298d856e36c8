#pragma once
// One row of a tree: arrow, icon, name, and what stands at its right end.

#include <optional>
#include <string>

namespace voledit {

/// How a row looks. Rows are all of one height and as wide as their window.
struct TreeRow {
    std::string
        name;  // what it is noted as: NAME, "Open NAME", "Show NAME"; also its ImGui id, so it must be the only one
    std::string label;   // what is shown
    std::string detail;  // dim, behind the label; what does not fit is cut
    const char* icon = "";
    int depth = 0;
    bool parent = false;  // has rows below it, hence an arrow
    bool open = true;     // of parents
    bool selected = false;
    bool link = false;              // shared: a link mark behind its label
    bool wrong = false;             // a warning mark behind its label
    std::optional<bool> on;         // an eye at the right end; off is drawn dim
    std::string help;               // tooltip
    std::string eyeHelp;            // tooltip of the eye
    bool scrollTo = false;          // brings it into view
    std::string* edited = nullptr;  // the name that is being typed in the label's place
    bool focus = false;             // begins typing in this frame
};

/// What the user did to it.
struct TreeRowEvents {
    bool clicked = false;
    bool doubleClicked = false;
    bool menu = false;         // right click
    bool arrow = false;        // open or close
    bool eye = false;          // switch
    bool nameDone = false;     // Enter, or the field was left
    bool nameDropped = false;  // Escape
};

namespace ui {
/// Draws it. The row itself is the last item, so that drag and drop sources and targets may follow.
TreeRowEvents treeRow(const TreeRow& row);
/// Height of a row with its gap, pixels.
float treeRowHeight();
}  // namespace ui

}  // namespace voledit
