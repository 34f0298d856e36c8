#include "app/editor/node_actions.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "core/base/error.h"
#include "core/scene/node_edits.h"

namespace voledit {

namespace {

std::vector<SceneRow> rowsOf(const Workspace& workspace) {
    return sceneRows(workspace.document.scene(), workspace.tree.closed);
}

/// Every row, those below closed ones too.
std::vector<SceneRow> allRows(const Workspace& workspace) {
    return sceneRows(workspace.document.scene(), {});
}

std::optional<SceneRow> selectedRow(const Workspace& workspace) {
    if (workspace.selection.node.empty()) return std::nullopt;
    const std::vector<SceneRow> rows = allRows(workspace);
    const SceneRow* row = rowAt(rows, workspace.selection.node);
    return row ? std::optional(*row) : std::nullopt;
}

SceneRow needRow(const Workspace& workspace, const char* action) {
    const auto row = selectedRow(workspace);
    if (!row) throw Error(action, "no node is selected", "click one in the Scene panel");
    return *row;
}

/// Opens the rows around `path`, so that it is seen.
void reveal(Workspace& workspace, const std::string& path) {
    const std::vector<SceneRow> rows = allRows(workspace);
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const SceneRow& row) { return row.path == path; });
    if (at == rows.end()) return;
    int depth = at->depth;
    for (auto row = at; row != rows.begin(); --row)
        if (const SceneRow& above = *(row - 1); above.depth < depth) {
            workspace.tree.closed.erase(above.path);
            depth = above.depth;
        }
    workspace.tree.reveal = path;
}

// ---- Selecting ----------------------------------------------------------------------------------------------------

void step(Workspace& workspace, int by) {
    const std::vector<SceneRow> rows = rowsOf(workspace);
    if (rows.empty()) return;
    const auto at = std::find_if(rows.begin(), rows.end(),
                                 [&](const SceneRow& row) { return row.path == workspace.selection.node; });
    const int last = int(rows.size()) - 1;
    const int now = at == rows.end() ? (by > 0 ? -1 : last + 1) : int(at - rows.begin());
    selectAndReveal(workspace, rows[std::size_t(std::clamp(now + by, 0, last))].path);
}

void openRow(Workspace& workspace) {
    const std::vector<SceneRow> rows = rowsOf(workspace);
    const SceneRow* row = rowAt(rows, workspace.selection.node);
    if (!row || !row->parent) return;
    if (!workspace.tree.closed.erase(row->path)) step(workspace, 1);
}

void closeRow(Workspace& workspace) {
    const std::vector<SceneRow> rows = rowsOf(workspace);
    const SceneRow* row = rowAt(rows, workspace.selection.node);
    if (!row) return;
    if (row->parent && row->open) {
        workspace.tree.closed.insert(row->path);
        return;
    }
    for (const SceneRow* above = row; above-- != rows.data();)
        if (above->depth < row->depth) return selectAndReveal(workspace, above->path);
}

void selectAction(Workspace& workspace, const std::string& argument) {
    const std::vector<SceneRow> rows = allRows(workspace);
    if (argument.empty() || rowAt(rows, argument)) return selectAndReveal(workspace, argument);
    // By name, as it stands in the tree.
    for (const SceneRow& row : rows)
        if (row.name == argument || row.widget == argument || row.target == argument)
            return selectAndReveal(workspace, row.path);
    throw Error("node.select", "the scene has no node \"" + argument + "\"",
                "name one by its path, such as /root/of, or by its name in the Scene panel");
}

// ---- Changing -----------------------------------------------------------------------------------------------------

void deleteAction(Workspace& workspace) {
    const SceneRow row = needRow(workspace, "node.delete");
    // Of something shared only this use goes; with the last use goes what it names.
    const std::vector<SceneRow> rows = allRows(workspace);
    const auto uses = std::count_if(rows.begin(), rows.end(),
                                    [&](const SceneRow& other) { return other.link && other.target == row.target; });
    const std::string path = row.link && uses > 1 ? row.path : row.target;
    const auto at =
        std::find_if(rows.begin(), rows.end(), [&](const SceneRow& other) { return other.path == row.path; });
    const std::string next = at != rows.begin() ? (at - 1)->path : "";
    workspace.document.apply("Delete " + row.label, [&](Scene& scene) { removeNode(scene, path); });
    selectNode(workspace, next);
    settleSelection(workspace);
}

/// An actor has a name of its own, unless it is an entry of the scene's objects: then that is its name.
bool isActor(const Scene& scene, const SceneRow& row) {
    const Object* object = findObjectAt(scene, row.target);
    return object && std::holds_alternative<ActorObject>(object->kind) &&
           (row.target == kRootPath || !parentOf(scene, row.target).empty());
}

void renameAction(Workspace& workspace, const std::string& argument) {
    const SceneRow row = needRow(workspace, "node.rename");
    if (argument.empty()) {
        workspace.tree.renaming = row.path;
        workspace.tree.typed = row.name;
        workspace.tree.beginTyping = true;
        return;
    }
    if (argument == row.name) return;
    const bool named = parentOf(workspace.document.scene(), row.target).empty() && row.target != kRootPath;
    std::string target = row.target;
    workspace.document.apply("Rename " + row.label, [&](Scene& scene) {
        if (row.kind == SceneRow::Kind::Transfer && named) {
            renameTransfer(scene, row.name, argument);
            target = transferPath(argument);
        } else if (row.kind == SceneRow::Kind::Transfer) {
            editTransferAt(scene, row.target, [&](Transfer& transfer) { transfer.name = argument; });
        } else if (isActor(workspace.document.scene(), row)) {
            editObjectAt(scene, row.target,
                         [&](Object& object) { std::get<ActorObject>(object.kind).name = argument; });
        } else if (row.kind == SceneRow::Kind::Object && named) {
            renameObject(scene, row.name, argument);
            target = objectPath(argument);
        } else if (row.kind == SceneRow::Kind::Displacement && named) {
            renameDisplacement(scene, row.name, argument);
            target = displacementPath(argument);
        } else {
            throw Error("node.rename", "\"" + row.label + "\" has no name in the scene", {});
        }
    });
    workspace.selection = {};
    selectTarget(workspace, target);
}

bool canRename(const Workspace& workspace) {
    const auto row = selectedRow(workspace);
    if (!row) return false;
    return row->kind == SceneRow::Kind::Transfer || isActor(workspace.document.scene(), *row) ||
           (parentOf(workspace.document.scene(), row->target).empty() && row->target != kRootPath);
}

void enableAction(Workspace& workspace, const std::string& argument) {
    const SceneRow row = needRow(workspace, "node.enable");
    if (row.on) enableNode(workspace, row, switchArgument("node.enable", argument, *row.on));
}

/// Joints are selected of the actor that is selected, and of no other node; those it has lost are dropped.
void settleJoints(Workspace& workspace, const std::string& target) {
    std::vector<std::string>& joints = workspace.selection.joints;
    if (joints.empty()) return;
    const Object* object = findObjectAt(workspace.document.scene(), target);
    if (!object || !std::holds_alternative<ActorObject>(object->kind)) joints.clear();
    for (const auto& actor : workspace.compiled.actors)
        if (actor->path == target)
            std::erase_if(joints, [&](const std::string& name) { return actor->skeleton.find(name) < 0; });
}

std::optional<ListPlace> movable(const Workspace& workspace) {
    const auto row = selectedRow(workspace);
    if (!row || row->kind != SceneRow::Kind::Transfer) return std::nullopt;
    return listPlace(row->path);
}

void moveAction(Workspace& workspace, int by) {
    const auto place = movable(workspace);
    if (!place) return;
    moveTransferTo(workspace, workspace.selection.node, std::size_t(std::max(0, int(place->index) + by)));
}

bool canMove(const Workspace& workspace, int by) {
    const auto place = movable(workspace);
    if (!place || int(place->index) + by < 0) return false;
    const std::string next = place->list + "/" + std::to_string(int(place->index) + by);
    return findTransferAt(workspace.document.scene(), next) != nullptr;
}

// ---- The registry -------------------------------------------------------------------------------------------------

void addSelectActions(Actions& actions, Workspace& workspace) {
    const auto open = [&workspace] { return workspace.open; };
    const auto any = [&workspace] { return !workspace.selection.node.empty(); };
    actions.add({"node.select", "Select Node…", "", "PATH", "Selects a node by its path or its name in the Scene panel",
                 [&](const std::string& argument) { selectAction(workspace, argument); }, open});
    actions.add({"node.next",
                 "Next Row",
                 "Down",
                 "",
                 "Selects the next row of the scene's tree",
                 [&](const std::string&) { step(workspace, 1); },
                 open,
                 {},
                 KeyRegion::Panels});
    actions.add({"node.previous",
                 "Previous Row",
                 "Up",
                 "",
                 "Selects the row before",
                 [&](const std::string&) { step(workspace, -1); },
                 open,
                 {},
                 KeyRegion::Panels});
    actions.add({"node.open",
                 "Open Row",
                 "Right",
                 "",
                 "Shows what is below the selected row",
                 [&](const std::string&) { openRow(workspace); },
                 any,
                 {},
                 KeyRegion::Panels});
    actions.add({"node.close",
                 "Close Row",
                 "Left",
                 "",
                 "Hides what is below the selected row, or goes up to its parent",
                 [&](const std::string&) { closeRow(workspace); },
                 any,
                 {},
                 KeyRegion::Panels});
}

void addChangeActions(Actions& actions, Workspace& workspace) {
    const auto any = [&workspace] { return !workspace.selection.node.empty(); };
    actions.add({"node.rename", "Rename", "F2", "NAME", "Gives the selected node another name",
                 [&](const std::string& argument) { renameAction(workspace, argument); },
                 [&workspace] { return canRename(workspace); }});
    // With control points or joints selected the key must not take the whole lattice or actor away.
    actions.add({"node.delete", "Delete", "Delete", "", "Takes the selected node away; also X",
                 [&](const std::string&) { deleteAction(workspace); },
                 [&workspace, any] {
                     return any() && workspace.selection.points.empty() && workspace.selection.joints.empty();
                 }});
    actions.add({"node.enable", "Enable", "H", "on|off", "Switches the selected deformation on or off",
                 [&](const std::string& argument) { enableAction(workspace, argument); },
                 [&workspace] {
                     const auto row = selectedRow(workspace);
                     return row && row->on;
                 },
                 [&workspace] {
                     const auto row = selectedRow(workspace);
                     return row && row->on && *row->on;
                 }});
    actions.add({"node.move-up", "Move Up", "Alt+Up", "", "Applies the selected deformation earlier",
                 [&](const std::string&) { moveAction(workspace, -1); },
                 [&workspace] { return canMove(workspace, -1); }});
    actions.add({"node.move-down", "Move Down", "Alt+Down", "", "Applies the selected deformation later",
                 [&](const std::string&) { moveAction(workspace, 1); },
                 [&workspace] { return canMove(workspace, 1); }});
}

}  // namespace

void addNodeActions(Actions& actions, Workspace& workspace) {
    addSelectActions(actions, workspace);
    addChangeActions(actions, workspace);
}

void selectNode(Workspace& workspace, const std::string& path) {
    if (workspace.selection.node != path) workspace.selection = {"", {}, path};
    settleSelection(workspace);
}

void settleSelection(Workspace& workspace) {
    Selection& selection = workspace.selection;
    if (selection.empty()) return;
    const Scene& scene = workspace.document.scene();
    const std::vector<SceneRow> rows = allRows(workspace);
    if (selection.node.empty()) {
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const SceneRow& candidate) {
            return candidate.kind == SceneRow::Kind::Transfer && candidate.name == selection.lattice;
        });
        if (row == rows.end()) {
            selection = {};
            return;
        }
        selection.node = row->path;
    }
    const std::string target = followedUse(scene, selection.node);
    const SceneRow* row = rowAt(rows, selection.node);
    if (target.empty() || !row) {
        selection = {};
        return;
    }
    const Transfer* transfer = findTransferAt(scene, target);
    const auto* ffd = transfer ? std::get_if<FfdTransfer>(&transfer->kind) : nullptr;
    const std::string lattice = ffd ? row->name : "";
    if (lattice != selection.lattice) selection = {lattice, {}, selection.node};
    const std::size_t count = ffd ? std::size_t(ffd->points.x) * ffd->points.y * ffd->points.z : 0;
    std::erase_if(selection.points, [&](std::size_t point) { return point >= count; });
    settleJoints(workspace, target);
}

void selectAndReveal(Workspace& workspace, const std::string& path) {
    selectNode(workspace, path);
    reveal(workspace, path);
}

void selectTarget(Workspace& workspace, const std::string& target) {
    for (const SceneRow& row : allRows(workspace))
        if (row.target == target) return selectAndReveal(workspace, row.path);
}

void enableNode(Workspace& workspace, const SceneRow& row, bool on) {
    workspace.document.apply((on ? "Enable " : "Disable ") + row.label, [&](Scene& scene) {
        editTransferAt(scene, row.target, [&](Transfer& transfer) { transfer.enabled = on; });
    });
}

void moveTransferTo(Workspace& workspace, const std::string& path, std::size_t to) {
    std::string moved;
    workspace.document.apply("Move deformation",
                             [&](Scene& scene) { moved = moveTransferInList(scene, path, int(to)); });
    selectAndReveal(workspace, moved);
}

std::optional<ListPlace> listPlace(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == path.npos || slash == 0) return std::nullopt;
    std::size_t index = 0;
    const char* end = path.data() + path.size();
    const auto [at, problem] = std::from_chars(path.data() + slash + 1, end, index);
    if (problem != std::errc{} || at != end) return std::nullopt;
    return ListPlace{path.substr(0, slash), index};
}

}  // namespace voledit
