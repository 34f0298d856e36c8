#include "app/editor/timeline/keying.h"

#include <algorithm>

#include "app/editor/timeline/dope_rows.h"
#include "app/editor/timeline/key_move.h"
#include "app/editor/timeline/timeline_actions.h"
#include "app/editor/tools/joint_edits.h"
#include "core/base/error.h"
#include "core/scene/actor_edits.h"
#include "core/scene/edits.h"
#include "core/scene/nodes.h"

namespace voledit {

namespace {

bool endsWith(const std::string& text, const std::string& tail) {
    return text.size() >= tail.size() && text.compare(text.size() - tail.size(), tail.size(), tail) == 0;
}

std::optional<KeyMark> keyAt(const Scene& scene, const ValuePath& path, double t) {
    for (const KeyMark& mark : keysOf(scene, path))
        if (sameTime(mark.time, t)) return mark;
    return std::nullopt;
}

/// Those of `values` that have a key at t.
std::vector<KeyRef> keysAt(const Scene& scene, const std::vector<ValuePath>& values, double t) {
    std::vector<KeyRef> keys;
    for (const ValuePath& path : values)
        if (const auto mark = keyAt(scene, path, t)) keys.push_back({path, mark->time});
    return keys;
}

/// The selected joints, and those above them that inverse kinematics turns with them, where they are posed or have
/// keys.
std::vector<std::string> jointsToKey(const Workspace& workspace, const NodePath& actor) {
    std::vector<std::string> names = workspace.selection.joints;
    const auto& actors = workspace.compiled.actors;
    const auto at = std::find_if(actors.begin(), actors.end(), [&](const auto& a) { return a->path == actor; });
    if (at == actors.end()) return names;
    const Skeleton& skeleton = (*at)->skeleton;
    const NamedPose pose = poseOf(workspace.document.scene(), actor, workspace.time);
    for (const std::string& name : workspace.selection.joints) {
        int joint = skeleton.find(name);
        const auto said = workspace.actors.chains.find(name);
        int chain = joint < 0 ? 0 : said != workspace.actors.chains.end() ? said->second : usualChain(skeleton, joint);
        for (; chain > 0 && (joint = skeleton.joints[std::size_t(joint)].parent) >= 0; --chain) {
            const std::string& above = skeleton.joints[std::size_t(joint)].name;
            if (pose.contains(above) && std::find(names.begin(), names.end(), above) == names.end())
                names.push_back(above);
        }
    }
    return names;
}

std::vector<ValuePath> jointValues(const Workspace& workspace, const NodePath& actor) {
    std::vector<ValuePath> values;
    const std::vector<KeyableValue> all = valuesOf(workspace.document.scene(), actor);
    for (const std::string& joint : jointsToKey(workspace, actor))
        for (const KeyableValue& value : all)
            if (endsWith(value.path, "/" + pointerToken(joint) + "/rotate") ||
                (value.animated && endsWith(value.path, "/" + pointerToken(joint) + "/translate")))
                values.push_back(value.path);
    return values;
}

std::vector<ValuePath> pointValues(const Workspace& workspace, const NodePath& lattice) {
    std::vector<ValuePath> values;
    const std::vector<KeyableValue> all = valuesOf(workspace.document.scene(), lattice);
    for (const std::size_t point : workspace.selection.points) {
        const std::string start = lattice + "/move/" + std::to_string(point) + "/";
        const auto moved =
            std::find_if(all.begin(), all.end(), [&](const KeyableValue& v) { return v.path.starts_with(start); });
        if (moved != all.end()) values.push_back(moved->path);
    }
    return values;
}

}  // namespace

std::vector<ValuePath> selectedValues(const Workspace& workspace) {
    const Scene& scene = workspace.document.scene();
    const NodePath node = followedUse(scene, workspace.selection.node);
    if (node.empty()) return {};
    if (!workspace.selection.joints.empty()) return jointValues(workspace, node);
    if (!workspace.selection.points.empty()) return pointValues(workspace, node);
    std::vector<ValuePath> values, animated;
    for (const KeyableValue& value : valuesOf(scene, node)) {
        if (value.path.starts_with(node + "/frame")) continue;
        values.push_back(value.path);
        if (value.animated) animated.push_back(value.path);
    }
    return animated.empty() ? values : animated;
}

void insertKeys(Workspace& workspace, const std::vector<ValuePath>& values, double t) {
    if (values.empty())
        throw Error("key.insert", "nothing is selected that may have keys",
                    "select a node, control points or joints, or hold the mouse over a field");
    workspace.document.apply(keyStep("Insert", values.size()), [&](Scene& scene) {
        for (const ValuePath& path : values) setKey(scene, path, t);
    });
    workspace.timeline.keys = keysAt(workspace.document.scene(), values, t);
}

void insertSelectedKeys(Workspace& workspace) {
    const Selection& selection = workspace.selection;
    const double t = workspace.time;
    const When key{t, true};
    if (selection.joints.empty() && selection.points.empty())
        return insertKeys(workspace, selectedValues(workspace), t);
    const NodePath actor = followedUse(workspace.document.scene(), selection.node);
    const std::vector<std::string> joints =
        selection.joints.empty() ? std::vector<std::string>{} : jointsToKey(workspace, actor);
    workspace.document.apply(keyStep("Insert", std::max(joints.size(), selection.points.size())), [&](Scene& scene) {
        if (selection.joints.empty())
            return moveControlPoints(scene, selection.lattice, selection.points, Vec3(0), key);
        const NamedPose pose = poseOf(scene, actor, t);
        for (const std::string& joint : joints) {
            const auto own = pose.find(joint);
            setJointRotation(scene, actor, joint, own == pose.end() ? Quat(1, 0, 0, 0) : quatOfDegrees(own->second),
                             key);
        }
    });
    workspace.timeline.keys = keysAt(workspace.document.scene(), selectedValues(workspace), t);
}

void removeKeys(Workspace& workspace, const std::vector<ValuePath>& values) {
    const std::vector<KeyRef> keys = keysAt(workspace.document.scene(), values, workspace.time);
    if (keys.empty()) throw Error("key.remove", "there is no key at this time", "go to one by the Up and Down keys");
    workspace.document.apply(keyStep("Delete", keys.size()), [&](Scene& scene) {
        for (const KeyRef& key : keys) removeKey(scene, key.path, key.time);
    });
}

void clearAllKeys(Workspace& workspace, const std::vector<ValuePath>& values) {
    std::vector<ValuePath> animated;
    for (const ValuePath& path : values)
        if (!keysOf(workspace.document.scene(), path).empty()) animated.push_back(path);
    if (animated.empty()) throw Error("key.clear", "it has no keys", {});
    workspace.document.apply("Clear keys", [&](Scene& scene) {
        for (const ValuePath& path : animated) clearKeys(scene, path, workspace.time);
    });
}

void deleteSelectedKeys(Workspace& workspace) {
    const std::vector<KeyRef> keys = workspace.timeline.keys;
    workspace.document.apply(keyStep("Delete", keys.size()), [&](Scene& scene) {
        for (const KeyRef& key : keys) removeKey(scene, key.path, key.time);
    });
    workspace.timeline.keys.clear();
}

void setSelectedInterpolation(Workspace& workspace, Track::Interpolation interpolation) {
    workspace.document.apply("Change interpolation", [&](Scene& scene) {
        for (const KeyRef& key : workspace.timeline.keys) setInterpolation(scene, key, interpolation);
    });
}

void goToKey(Workspace& workspace, const std::vector<ValuePath>& values, int by) {
    const std::vector<double> times = keyTimes(workspace.document.scene(), values);
    const double now = workspace.time;
    if (by > 0) {
        for (const double time : times)
            if (time > now && !sameTime(time, now)) return goToTime(workspace, time);
    } else {
        for (auto time = times.rbegin(); time != times.rend(); ++time)
            if (*time < now && !sameTime(*time, now)) return goToTime(workspace, *time);
    }
}

void settleKeys(Workspace& workspace) {
    std::vector<KeyRef>& keys = workspace.timeline.keys;
    if (keys.empty()) return;
    const Scene& scene = workspace.document.scene();
    ValuePath path;
    std::vector<KeyMark> marks;
    std::erase_if(keys, [&](const KeyRef& key) {
        if (key.path != path || path.empty()) marks = keysOf(scene, path = key.path);
        return std::none_of(marks.begin(), marks.end(), [&](const KeyMark& m) { return sameTime(m.time, key.time); });
    });
}

}  // namespace voledit
