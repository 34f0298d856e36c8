#include "app/editor/state_json.h"

#include <nlohmann/json.hpp>

#include "app/editor/tools/lattice_view.h"
#include "core/scene/edits.h"
#include "core/scene/nodes.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

Json sceneState(const Workspace& workspace) {
    if (!workspace.open) return nullptr;
    Scene scene = workspace.document.scene();
    setCamera(scene, workspace.camera);
    return Json::parse(sceneToJson(withDefaultsWrittenOut(scene, workspace.assets)));
}

// Path of the actor whose joints are selected.
std::string actorOf(const Workspace& workspace) {
    return workspace.selection.joints.empty() ? "" : followedUse(workspace.document.scene(), workspace.selection.node);
}

Json selectionState(const Workspace& workspace) {
    const Selection& selection = workspace.selection;
    Json points = Json::array();
    const auto view = latticeView(workspace.document.scene(), &workspace.compiled, selection.lattice);
    for (const std::size_t index : selection.points) {
        if (!view) break;
        const int at = int(index), nx = view->lattice.points.x, ny = view->lattice.points.y;
        points.push_back({at % nx, at / nx % ny, at / (nx * ny)});
    }
    return {{"node", selection.node},
            {"lattice", selection.lattice},
            {"points", points},
            {"joints", {{"actor", actorOf(workspace)}, {"names", selection.joints}}}};
}

Json keysState(const Workspace& workspace) {
    Json keys = Json::array();
    for (const KeyRef& key : workspace.timeline.keys) keys.push_back({{"path", key.path}, {"time", key.time}});
    return keys;
}

}  // namespace

std::string stateJson(const Editor& editor) {
    const Workspace& workspace = editor.workspace();
    Json messages = Json::array();
    for (const Notice& notice : workspace.notices) messages.push_back(notice.text);
    Json state{
        {"scene", sceneState(workspace)},
        {"selection", selectionState(workspace)},
        {"undo", workspace.document.undoNames()},
        {"redo", workspace.document.redoNames()},
        {"modified", workspace.open && workspace.document.modified()},
        {"renderer", editor.rendererName()},
        {"time", workspace.time},
        {"frame", workspace.open ? nearestFrame(workspace.time, workspace.document.scene().timeline) : 0},
        {"playing", workspace.timeline.playback.playing()},
        {"keys", keysState(workspace)},
        {"viewport", {workspace.viewOrigin.x, workspace.viewOrigin.y, workspace.viewSize.x, workspace.viewSize.y}},
        {"messages", messages},
    };
    if (editor.times) {
        state["frame_ms"] = editor.times->frameMs;
        state["pictures_per_second"] = editor.times->picturesPerSecond;
        state["renderer_why"] = editor.picture.why;
        state["picture"] = {editor.picture.size.x, editor.picture.size.y};
        state["refined_ms"] = editor.times->refinedMs;
    }
    return state.dump(2) + "\n";
}

}  // namespace voledit
