#pragma once
// The panels at the window's right side, as the editor lays them out.

#include <functional>
#include <string>
#include <vector>

#include "app/editor/workspace.h"

namespace voledit {

/// One panel: the editor draws it in a collapsing header `title`, within a WidgetScope of the title.
struct Panel {
    std::string title;
    std::function<void(Workspace& workspace)> draw;              // may hold the panel's own state
    std::function<bool(const Workspace& workspace)> shown = {};  // null: always
    const char* icon = "";                                       // of icons.h
    bool openAtFirst = true;
};

/// All panels from top to bottom. In app/editor/panels/panels.cpp.
std::vector<Panel> makePanels();

}  // namespace voledit
