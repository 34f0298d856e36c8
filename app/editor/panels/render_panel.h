#pragma once
// How the picture is made.

#include "app/editor/workspace.h"

namespace voledit {

void drawRenderPanel(Workspace& workspace);

}  // namespace voledit
