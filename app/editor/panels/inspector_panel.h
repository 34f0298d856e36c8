#pragma once
// The selected node: what it is and all that can be changed about it.

#include "app/editor/panels/inspection.h"

namespace voledit {

class InspectorPanel {
public:
    void draw(Workspace& workspace);

private:
    InspectorState state_;
};

/// Whether there is something to inspect: a selected node that is no lattice (those have a panel of their own).
bool hasInspector(const Workspace& workspace);

}  // namespace voledit
