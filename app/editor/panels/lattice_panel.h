#pragma once
// The active lattice: its shape, its strength, its selected control points.

#include "app/editor/tools/folded_points.h"
#include "app/editor/workspace.h"

namespace voledit {

/// Numbers of the selected points, folds, amount, basis, degree, cells.
class LatticePanel {
public:
    void draw(Workspace& workspace);

private:
    FoldedPoints folded_;
};

}  // namespace voledit
