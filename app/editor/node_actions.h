#pragma once
// The named actions of the scene's tree: selecting, removing, naming, ordering nodes.

#include <optional>
#include <string>

#include "app/editor/actions.h"
#include "app/editor/scene_tree.h"
#include "app/editor/workspace.h"

namespace voledit {

/// Adds node.select, node.next, node.rename, node.delete, node.enable, node.move-up … `workspace` outlives `actions`.
void addNodeActions(Actions& actions, Workspace& workspace);

/// Selects the node at `path` ("": none); where it is a lattice, that.
void selectNode(Workspace& workspace, const std::string& path);
/// The same, and opens the rows around it so that it is seen.
void selectAndReveal(Workspace& workspace, const std::string& path);
/// Selects the first row that shows what stands at `target`; nothing where there is none.
void selectTarget(Workspace& workspace, const std::string& target);
/// Makes node and lattice of the selection agree, and drops what the scene does not hold any more. Once a frame.
void settleSelection(Workspace& workspace);

/// Switches the STF of `row` on or off, as one step.
void enableNode(Workspace& workspace, const SceneRow& row, bool on);
/// Moves the STF at `path` to place `to` of its list, as one step, and selects it there.
void moveTransferTo(Workspace& workspace, const std::string& path, std::size_t to);

/// The list that a path is an element of, and where in it; nullopt for others.
struct ListPlace {
    std::string list;  // path of the list: "/root/by"
    std::size_t index = 0;
};
std::optional<ListPlace> listPlace(const std::string& path);

}  // namespace voledit
