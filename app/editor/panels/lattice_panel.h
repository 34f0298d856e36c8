#pragma once
// The active lattice: its shape, its strength, its selected control points.

#include "app/editor/workspace.h"

namespace voledit {

void drawLatticePanel(Workspace& workspace);

}  // namespace voledit
