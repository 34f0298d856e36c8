#pragma once
// The steps that undo and redo go through.

#include "app/editor/workspace.h"

namespace voledit {

void drawHistoryPanel(Workspace& workspace);

}  // namespace voledit
