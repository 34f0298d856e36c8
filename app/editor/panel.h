#pragma once
// The panels at the window's right side, as the editor lays them out.

#include <string>
#include <vector>

#include "app/editor/workspace.h"

namespace voledit {

/// One panel: the editor draws it in a collapsing header `title`, within a WidgetScope of the title.
struct Panel {
    std::string title;
    void (*draw)(Workspace& workspace);
    bool (*shown)(const Workspace& workspace) = nullptr;  // null: always
};

/// All panels from top to bottom. In app/editor/panels/panels.cpp.
std::vector<Panel> makePanels();

}  // namespace voledit
