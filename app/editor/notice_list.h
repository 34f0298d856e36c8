#pragma once
// Notices at the viewport's lower left, or over the panels while the viewport is to be seen bare: they go by
// themselves, problems stay until they are closed.

#include <cstddef>
#include <set>

#include "app/editor/layout.h"
#include "app/editor/workspace.h"

namespace voledit {

class NoticeList {
public:
    /// Draws what is to be seen now within the current frame, upwards from the lower left of `area`.
    void draw(const Workspace& workspace, const PixelRect& area);

private:
    bool drawOne(const Workspace& workspace, const PixelRect& area, std::size_t index, float& bottom);
    std::set<std::size_t> closed_;  // indices into workspace.notices
};

}  // namespace voledit
