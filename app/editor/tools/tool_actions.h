#pragma once
// The tools' named actions, and the way from the workspace to the tools.

#include <optional>
#include <string>

#include "app/editor/tools/viewport_tools.h"
#include "app/editor/workspace.h"

namespace voledit {

/// What the tools see of `workspace`; valid as long as it is.
ToolContext toolContext(Workspace& workspace);

/// Adds lattice.add, lattice.remove, lattice.reset, lattice.toggle, select.all, select.none, select.box, tool.grab …
/// `workspace` and `tools` outlive `actions`.
void addToolActions(Actions& actions, Workspace& workspace, ViewportTools& tools);

/// The lattice that tools and panels work on: the selected one, else the outermost; "" where the scene has none.
std::string activeLattice(const Workspace& workspace);

/// Where control point `point` of lattice `name` is shown, world units (after the transfers outside it); nullopt where
/// there is no such lattice or point. "@point(NAME,i,j,k)" of recorded events finds it by this.
std::optional<Vec3> shownControlPoint(const Workspace& workspace, const std::string& name, const Index3& point);

}  // namespace voledit
