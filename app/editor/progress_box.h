#pragma once
// The box over the picture while long work goes on.

#include <string>

#include "app/editor/layout.h"

namespace voledit {

/// Draws it in the middle of `area` within the current frame: what goes on, how far it is (0…1), Cancel. Widgets are
/// noted as "scope/Cancel". True where Cancel was clicked.
bool drawProgressBox(const char* scope, const std::string& text, double fraction, const PixelRect& area, float scale);

}  // namespace voledit
