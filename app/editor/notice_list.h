#pragma once
// Notices at the viewport's lower left: they go by themselves, problems stay until they are closed.

#include <cstddef>
#include <set>

#include "app/editor/workspace.h"

namespace voledit {

class NoticeList {
public:
    /// Draws what is to be seen now within the current frame.
    void draw(const Workspace& workspace);

private:
    bool drawOne(const Workspace& workspace, std::size_t index, float& bottom);
    std::set<std::size_t> closed_;  // indices into workspace.notices
};

}  // namespace voledit
