#include "app/editor/tools/tool_actions.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <sstream>

#include "app/editor/tools/actor_view.h"
#include "core/base/error.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

/// "1,2.5,-3" as three numbers. Throws Error for anything else; `id` names the action in it.
Vec3 threeNumbers(const std::string& id, const std::string& text) {
    Vec3 numbers{0};
    const char* at = text.data();
    const char* end = at + text.size();
    for (int a = 0; a < 3; ++a) {
        const auto [next, failed] = std::from_chars(at, end, numbers[a]);
        const bool last = a == 2;
        if (failed != std::errc{} || (last ? next != end : next == end || *next != ','))
            throw Error(id, "\"" + text + "\" are no three numbers", "write them as 1,2,3");
        at = next + 1;
    }
    return numbers;
}

std::optional<LatticeView> activeView(const Workspace& workspace) {
    return latticeView(workspace.document.scene(), &workspace.compiled, activeLattice(workspace));
}

bool hasPoints(const Workspace& workspace) {
    return !workspace.selection.points.empty() && !activeLattice(workspace).empty();
}

/// The object's box, which a new lattice is laid about. Throws Error where there is nothing yet.
Frame frameOfScene(const Workspace& workspace) {
    if (!workspace.compiled.root || workspace.compiled.root->bounds.empty())
        throw Error("lattice.add", "nothing is loaded that a lattice could be laid about", "open a volume first");
    return frameOf(workspace.compiled.root->bounds);
}

void addLatticeAction(Workspace& workspace) {
    const Frame frame = frameOfScene(workspace);
    std::string name;
    workspace.document.apply("Add lattice",
                             [&](Scene& scene) { name = addLattice(scene, "lattice", FfdTransfer{}, frame); });
    workspace.selection = {name, {}};
}

void removeLatticeAction(Workspace& workspace) {
    const std::string name = activeLattice(workspace);
    workspace.document.apply("Remove lattice", [&](Scene& scene) { removeTransfer(scene, name); });
    workspace.selection = {};
}

void resetAction(Workspace& workspace) {
    const std::string name = activeLattice(workspace);
    const bool all = workspace.selection.points.empty();
    workspace.document.apply(all ? "Reset lattice" : "Reset control points",
                             [&](Scene& scene) { resetLattice(scene, name, workspace.selection.points); });
}

void moveAction(Workspace& workspace, const std::string& argument) {
    const auto view = activeView(workspace);
    if (!view) return;
    const Vec3 offset = glm::inverse(Mat3(view->shownFromLattice)) * threeNumbers("lattice.move", argument);
    const std::size_t count = workspace.selection.points.size();
    const std::string name = count == 1 ? "Move control point" : "Move " + std::to_string(count) + " control points";
    workspace.document.apply(name, [&](Scene& scene) {
        moveControlPoints(scene, view->name, workspace.selection.points, offset, workspace.when());
    });
}

/// "i,j,k i,j,k …"
void selectPointsAction(Workspace& workspace, const std::string& argument) {
    const auto view = activeView(workspace);
    if (!view) return;
    Selection selection{view->name, {}};
    std::istringstream words(argument);
    for (std::string word; words >> word;) {
        const Index3 at(threeNumbers("select.points", word));
        for (int a = 0; a < 3; ++a)
            if (at[a] < 0 || at[a] >= view->lattice.points[a])
                throw Error("select.points", "lattice \"" + view->name + "\" has no control point " + word,
                            "points are counted from 0");
        selection.points.push_back(view->lattice.indexOf(at));
    }
    std::sort(selection.points.begin(), selection.points.end());
    selection.points.erase(std::unique(selection.points.begin(), selection.points.end()), selection.points.end());
    workspace.selection = selection;
}

ActorPtr activeActor(const Workspace& workspace) {
    if (!workspace.open || !workspace.compiled.root) return nullptr;
    return activeActor(workspace.document.scene(), &workspace.compiled, workspace.selection);
}

void selectAllJoints(Workspace& workspace) {
    const ActorPtr actor = activeActor(workspace);
    if (!actor) return;
    workspace.selection = {"", {}, workspace.selection.node.empty() ? actor->path : workspace.selection.node, {}};
    for (const Joint& joint : actor->skeleton.joints) workspace.selection.joints.push_back(joint.name);
}

void selectAllAction(Workspace& workspace) {
    const auto view = activeView(workspace);
    if (!view) return selectAllJoints(workspace);
    workspace.selection = {view->name, std::vector<std::size_t>(view->lattice.control.size())};
    std::iota(workspace.selection.points.begin(), workspace.selection.points.end(), std::size_t(0));
}

void selectInvertAction(Workspace& workspace) {
    const auto view = activeView(workspace);
    if (!view) return;
    const std::vector<std::size_t> before = workspace.selection.points;
    if (activeLattice(workspace).empty()) return;
    selectAllAction(workspace);
    std::erase_if(workspace.selection.points,
                  [&](std::size_t p) { return std::binary_search(before.begin(), before.end(), p); });
}

void toggleAction(Workspace& workspace, const std::string& argument) {
    const std::string name = activeLattice(workspace);
    const Transfer* transfer = findTransfer(workspace.document.scene(), name);
    if (!transfer) return;
    const bool on = switchArgument("lattice.enable", argument, transfer->enabled);
    workspace.document.apply(on ? "Enable lattice" : "Disable lattice",
                             [&](Scene& scene) { setTransferEnabled(scene, name, on); });
}

void addLatticeActions(Actions& actions, Workspace& workspace) {
    const auto any = [&workspace] { return !activeLattice(workspace).empty(); };
    const auto some = [&workspace] { return hasPoints(workspace); };
    actions.add({"lattice.add", "Add Lattice", "Ctrl+L", "", "Lays a 4×4×4 lattice about the object, to bend it by",
                 [&](const std::string&) { addLatticeAction(workspace); }, [&workspace] { return workspace.open; }});
    actions.add({"lattice.remove", "Remove Lattice", "Ctrl+Delete", "", "Takes the lattice and its deformation away",
                 [&](const std::string&) { removeLatticeAction(workspace); }, any});
    actions.add({"lattice.reset", "Reset to Rest", "Alt+G", "",
                 "Puts the selected control points (with none selected: all) back to rest",
                 [&](const std::string&) { resetAction(workspace); }, any});
    actions.add({"lattice.enable", "Enable Lattice", "", "on|off", "Switches the lattice's deformation on or off",
                 [&](const std::string& argument) { toggleAction(workspace, argument); }, any,
                 [&workspace] {
                     const Transfer* transfer = findTransfer(workspace.document.scene(), activeLattice(workspace));
                     return transfer && transfer->enabled;
                 }});
    actions.add({"lattice.move", "Move Control Points by…", "", "DX,DY,DZ",
                 "Moves the selected control points by an offset in world units",
                 [&](const std::string& argument) { moveAction(workspace, argument); }, some});
}

void addSelectActions(Actions& actions, Workspace& workspace, ViewportTools& tools) {
    const auto any = [&workspace] { return !activeLattice(workspace).empty(); };
    const auto some = [&workspace] { return hasPoints(workspace); };
    actions.add({"select.all", "Select All", "A", "",
                 "Selects every control point of the lattice, every joint of the actor",
                 [&](const std::string&) { selectAllAction(workspace); },
                 [&workspace, any] { return any() || activeActor(workspace); }});
    actions.add({"select.none", "Select None", "Alt+A", "", "Clears the selection",
                 [&](const std::string&) {
                     workspace.selection.points.clear();
                     workspace.selection.joints.clear();
                 },
                 [&workspace, any] { return any() || !workspace.selection.joints.empty(); }});
    actions.add({"select.invert", "Invert Selection", "Ctrl+I", "", "Selects what is not selected, and only that",
                 [&](const std::string&) { selectInvertAction(workspace); }, any});
    actions.add({"select.points", "Select Control Points…", "", "I,J,K…", "Selects control points by their indices",
                 [&](const std::string& argument) { selectPointsAction(workspace, argument); }, any});
    actions.add({"select.box", "Select by a Box", "B", "", "The next drag selects the control points in a rectangle",
                 [&](const std::string&) { tools.lattice().armBox(); }, any});
    actions.add(
        {"tool.grab", "Move Selection", "G", "",
         "The selected control points or joint follow the mouse until a click; X, Y, Z lock an axis, digits type a "
         "distance",
         [&](const std::string&) {
             const ToolContext context = toolContext(workspace);
             if (!tools.lattice().grab(context)) tools.joints().grab(context);
         },
         [&workspace, some] { return some() || !workspace.selection.joints.empty(); }});
}

}  // namespace

ToolContext toolContext(Workspace& workspace) {
    return {workspace.document,
            workspace.selection,
            workspace.camera,
            workspace.viewSize,
            workspace.compiled.root ? &workspace.compiled : nullptr,
            workspace.scale,
            &workspace.actors,
            workspace.timeline.autoKey};
}

void addToolActions(Actions& actions, Workspace& workspace, ViewportTools& tools) {
    addLatticeActions(actions, workspace);
    addSelectActions(actions, workspace, tools);
}

std::string activeLattice(const Workspace& workspace) {
    if (!workspace.selection.showsLattice()) return "";
    const Scene& scene = workspace.document.scene();
    const std::string& selected = workspace.selection.lattice;
    if (!selected.empty() && findTransfer(scene, selected)) return selected;
    const std::vector<std::string> names = latticeNames(scene);
    return names.empty() ? "" : names.front();
}

std::optional<Vec3> shownControlPoint(const Workspace& workspace, const std::string& name, const Index3& point) {
    const auto view = latticeView(workspace.document.scene(), &workspace.compiled, name);
    if (!view) return std::nullopt;
    for (int a = 0; a < 3; ++a)
        if (point[a] < 0 || point[a] >= view->lattice.points[a]) return std::nullopt;
    return view->shown(view->lattice.indexOf(point));
}

}  // namespace voledit
