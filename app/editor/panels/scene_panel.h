#pragma once
// What the scene holds: volumes and lattices.

#include "app/editor/workspace.h"

namespace voledit {

void drawScenePanel(Workspace& workspace);

}  // namespace voledit
