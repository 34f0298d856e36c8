#pragma once
// Tools: what the mouse does in the viewport, and what is drawn over the picture.

#include <memory>
#include <string>
#include <vector>

#include "app/editor/view_input.h"
#include "app/editor/workspace.h"
#include "render/overlay.h"

struct ImDrawList;

namespace voledit {

/// One way of working in the viewport. The editor calls `update` once a frame, the topmost tool first; the input that
/// no tool takes navigates.
class Tool {
public:
    virtual ~Tool() = default;

    /// Handles one frame of input: previews edits in `workspace.document` while a button is held, commits on release,
    /// cancels on Escape. True where the input was taken.
    virtual bool update(Workspace& workspace, const ViewInput& input) = 0;
    /// True between press and release (or while a modal operation runs): keys then come here before the shortcuts.
    virtual bool busy() const = 0;
    /// Drops what is going on, without an undo step (the document was replaced, the window lost the mouse).
    virtual void cancel(Workspace& workspace) = 0;

    /// Lines and points over the picture, world units; drawn only while overlays are on.
    virtual void fillOverlay(const Workspace& workspace, Overlay& overlay) const = 0;
    /// Things in pixels over the picture (a selection box, numbers beside the mouse). `origin` is the viewport's upper
    /// left in screen pixels.
    virtual void drawOver(const Workspace& workspace, ImDrawList& list, const Vec2& origin) const = 0;
    /// What keys and buttons do now, for the status bar: "Drag: move · X/Y/Z: axis · Esc: cancel"; may be empty.
    virtual std::string hint(const Workspace& workspace) const = 0;
};

/// All tools, the topmost first; made once for each editor. In app/editor/tools/tools.cpp.
std::vector<std::unique_ptr<Tool>> makeTools();
/// Adds the tools' actions (lattice.add, select.all, …). `workspace` outlives `actions`. In app/editor/tools/tools.cpp.
void addToolActions(Actions& actions, Workspace& workspace);
/// Where control point `point` of lattice `name` is shown, world units (after the transfers outside it); nullopt where
/// there is no such lattice or point. In app/editor/tools/tools.cpp; "@point(NAME,i,j,k)" finds it by this.
std::optional<Vec3> shownControlPoint(const Workspace& workspace, const std::string& name, const Index3& point);

/// One panel at the window's right side: a title with an icon, and what draws it within a section of that name.
struct Panel {
    std::string title;
    void (*draw)(Workspace& workspace);
    bool (*shown)(const Workspace& workspace) = nullptr;  // null: always
};
/// All panels from top to bottom. In app/editor/panels/panels.cpp. The editor draws each in a collapsing header within
/// a WidgetScope of the title.
std::vector<Panel> makePanels();

}  // namespace voledit
