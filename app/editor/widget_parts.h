#pragma once
// What the wrappers of widgets.h and parameter_widgets.h are made of. For those files, and the timeline's row of
// fields.

#include <string>

#include "app/editor/widgets.h"
#include "core/base/interval.h"

namespace voledit::ui {

/// What stands before "##".
std::string shownPart(const char* label);
/// An ImGui label that shows nothing.
std::string hidden(const char* label);

/// Notes, explains and judges the item drawn last.
Edit finish(const char* label, bool changed, const std::string& help);

/// A number dragged sideways, of the current item width; `label` with "##".
bool dragField(const char* label, double& value, const NumberFormat& format);
/// A bar from format.min to format.max, of the current item width. What is typed is kept within `allowed`.
bool barField(const char* label, double& value, const NumberFormat& format, const Interval& allowed);
/// Two-state buttons of one row: `on[i]` is drawn pressed. The one clicked, or -1.
int buttonRow(const char* label, std::span<const std::string> items, const std::function<bool(int)>& on,
              const std::string& help);

/// The coloured mark of axis `a` at the left end of the item drawn last.
void axisMark(int a);
/// The width of each of `count` fields beside each other in what is left of the row.
float shareOfRow(int count);

}  // namespace voledit::ui
