#pragma once
// Thin wrappers over ImGui: every widget is noted by name (widget_places.h), tells when an edit begins, goes on and
// ends, and explains itself in a tooltip.

#include <functional>
#include <span>
#include <string>

#include "app/editor/actions.h"
#include "app/editor/widget_places.h"
#include "core/base/types.h"
#include "core/scene/document.h"

namespace voledit {

/// What a widget did to its value in this frame.
struct Edit {
    bool changed = false;    // the value differs from what was passed: preview it
    bool finished = false;   // the user let go after a change: commit
    bool cancelled = false;  // Escape while it was active: restore

    Edit operator|(const Edit& other) const {
        return {changed || other.changed, finished || other.finished, cancelled || other.cancelled};
    }
};

/// Previews `change` while a widget is being edited, commits it as a step `name` at the end, restores on Escape.
void applyEdit(Document& document, const Edit& edit, const std::string& name,
               const std::function<void(Scene&)>& change);

/// How a number is shown and dragged.
struct NumberFormat {
    double min = -kInfinity, max = kInfinity;
    double speed = 0;  // value a pixel of dragging; 0: a hundredth of the range, or of the value
    int decimals = 2;
    const char* unit = "";     // shown behind the number: " mm"
    bool logarithmic = false;  // of sliders
};

namespace ui {

/// Starts a labelled row: the label in a dim column of one width, the next widget fills the rest. Every widget below
/// with a `label` begins such a row by itself; "##…" begins none.
void row(const char* label);
/// Where the fields of such rows begin, from the window's left edge.
float labelColumn();
/// Dim explanatory text, wrapped.
void note(const std::string& text);
/// The same in small letters.
void finePrint(const std::string& text);
/// A line with a warning sign.
void warning(const std::string& text);
/// Tooltip of the item drawn last; nothing for empty text.
void tooltip(const std::string& text);
/// Small dim heading within a panel.
void heading(const char* text);

bool button(const char* label, const std::string& help = {}, bool enabled = true);
/// A button as small as its icon; `name` is what it is noted as.
bool iconButton(const char* icon, const char* name, const std::string& help = {}, bool enabled = true);
/// A button of an action: its title, tooltip with shortcut, greyed out where it is not enabled; runs it when clicked.
/// With `icon` set, an icon button.
void actionButton(const Actions& actions, const std::string& id, const char* icon = nullptr);
/// A menu entry of an action, with its shortcut and tick.
void actionMenuItem(const Actions& actions, const std::string& id);

Edit checkbox(const char* label, bool& value, const std::string& help = {});
/// Index of the chosen one of `items`.
Edit combo(const char* label, int& index, std::span<const std::string> items, const std::string& help = {});
/// The field of a list that opens below it, with `shown` in it; while true the caller draws the list's rows and ends it
/// with ImGui::EndCombo. While false the field is ImGui's last item.
bool beginCombo(const char* label, const std::string& shown);
/// Buttons side by side, one of them on.
Edit choice(const char* label, int& index, std::span<const std::string> items, const std::string& help = {});
/// A number dragged sideways, or typed after a double click or Ctrl+click.
Edit number(const char* label, double& value, const NumberFormat& format = {}, const std::string& help = {});
Edit integer(const char* label, int& value, int min, int max, const std::string& help = {});
/// A bar from format.min to format.max.
Edit slider(const char* label, double& value, const NumberFormat& format, const std::string& help = {});
/// Three numbers with x, y, z beside each other; noted as "label X", "label Y", "label Z".
Edit vector(const char* label, Vec3& value, const NumberFormat& format = {}, const std::string& help = {});
Edit integers(const char* label, Index3& value, int min, int max, const std::string& help = {});
/// A swatch that opens a picker; RGB in [0, 1].
Edit color(const char* label, Vec3& value, const std::string& help = {});
/// `finished` on Enter or when the field is left.
Edit text(const char* label, std::string& value, const std::string& help = {});
/// A collapsing section within a panel; true while open.
bool section(const char* label, bool openAtFirst = true);

}  // namespace ui
}  // namespace voledit
