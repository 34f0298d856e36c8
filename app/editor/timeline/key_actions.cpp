#include "app/editor/timeline/key_actions.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "app/editor/event_words.h"
#include "app/editor/timeline/dope_rows.h"
#include "app/editor/timeline/key_move.h"
#include "app/editor/timeline/keying.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr std::array kInterpolations{Track::Interpolation::Step, Track::Interpolation::Linear,
                                     Track::Interpolation::Smooth};

/// The value that `argument` names; without one that of the field under the mouse, else what is selected.
std::vector<ValuePath> valuesMeant(const Workspace& workspace, const std::string& argument) {
    const Scene& scene = workspace.document.scene();
    if (argument.empty()) {
        const ValuePath& hovered = workspace.timeline.hovered;
        return hovered.empty() ? selectedValues(workspace) : std::vector{hovered};
    }
    if (valueAt(scene, argument)) return {argument};
    if (const auto named = trackNamed(scene, argument)) return {*named};
    throw Error("key", "the scene has no value \"" + argument + "\"",
                "name one by its path, such as /transfers/bend/angle");
}

void insertAction(Workspace& workspace, const std::string& argument) {
    const ValuePath& hovered = workspace.timeline.hovered;
    if (argument.empty() && hovered.empty()) return insertSelectedKeys(workspace);
    // A value that the file leaves out: its field knows what it is.
    if (argument.empty() && !valueAt(workspace.document.scene(), hovered))
        workspace.timeline.request = {"key.insert", hovered, false};
    else
        insertKeys(workspace, valuesMeant(workspace, argument), workspace.time);
}

void moveAction(Workspace& workspace, const std::string& id, const std::string& argument, bool copy) {
    const double delta = numberOf(argument, id);
    const std::vector<KeyRef> keys = workspace.timeline.keys;
    if (delta == 0) return;
    std::vector<KeyRef> moved;
    workspace.document.apply(keyStep(copy ? "Copy" : "Move", keys.size()),
                             [&](Scene& scene) { moved = moveKeys(scene, keys, delta, copy); });
    workspace.timeline.keys = moved;
}

void interpolationAction(Workspace& workspace, const std::string& argument) {
    for (const Track::Interpolation interpolation : kInterpolations)
        if (argument == wordOf(interpolation)) return setSelectedInterpolation(workspace, interpolation);
    throw Error("key.interpolation", "\"" + argument + "\" is none", "give step, linear or smooth");
}

/// "TRACK N" or "TRACK".
void selectAction(Workspace& workspace, const std::string& argument) {
    const Scene& scene = workspace.document.scene();
    std::vector<std::string> words = wordsOf(argument);
    std::optional<std::size_t> index;
    if (words.size() > 1) {
        index = std::size_t(wholeNumberOf(words.back(), "key.select", 0));
        words.pop_back();
    }
    std::string name;
    for (const std::string& word : words) name += (name.empty() ? "" : " ") + unquoted(word);
    const auto path = trackNamed(scene, name);
    if (!path) throw Error("key.select", "\"" + name + "\" has no keys", "name a value by its path or its label");
    std::vector<KeyRef> keys;
    for (const KeyMark& mark : keysOf(scene, *path)) keys.push_back({*path, mark.time});
    if (index && *index >= keys.size())
        throw Error("key.select",
                    "\"" + name + "\" has " + std::to_string(keys.size()) + " keys, no " + std::to_string(*index),
                    "keys are counted from 0");
    workspace.timeline.keys = index ? std::vector{keys[*index]} : keys;
}

void selectAll(Workspace& workspace) {
    workspace.timeline.keys.clear();
    for (const KeyableValue& value : animatedValues(workspace.document.scene()))
        for (const KeyMark& mark : keysOf(workspace.document.scene(), value.path))
            if (const KeyRef key{value.path, mark.time}; !contains(workspace.timeline.keys, key))
                workspace.timeline.keys.push_back(key);
}

/// The scene's frames and all keys.
void frameAll(Workspace& workspace) {
    const Timeline& timeline = workspace.document.scene().timeline;
    const std::vector<double> times = keyTimes(workspace.document.scene(), {});
    workspace.timeline.range.reset();
    if (times.empty()) return;
    const double from = std::min(double(timeline.start), times.front() * timeline.fps);
    const double to = std::max(double(timeline.start + frameCount(timeline)), times.back() * timeline.fps);
    workspace.timeline.range = framedRange({}, from, to);
}

void addValueActions(Actions& actions, Workspace& workspace) {
    const auto open = [&workspace] { return workspace.open; };
    actions.add({"key.insert", "Insert Key", "I", "PATH",
                 "Keeps the value of the field under the mouse (else of what is selected) at this time",
                 [&](const std::string& argument) { insertAction(workspace, argument); }, open});
    actions.add({"key.remove", "Delete Key", "Alt+I", "PATH",
                 "Takes away the key at this time, of the field under the mouse, else of what is selected",
                 [&](const std::string& argument) { removeKeys(workspace, valuesMeant(workspace, argument)); }, open});
    actions.add({"key.clear", "Clear Keys", "", "PATH", "Takes away all keys: the value stays as it is now",
                 [&](const std::string& argument) { clearAllKeys(workspace, valuesMeant(workspace, argument)); },
                 open});
    actions.add({"key.next", "Next Key", "Up", "PATH", "Goes to the next key in time",
                 [&](const std::string& argument) {
                     goToKey(workspace, argument.empty() ? std::vector<ValuePath>{} : valuesMeant(workspace, argument),
                             1);
                 },
                 open});
    actions.add({"key.previous", "Previous Key", "Down", "PATH", "Goes to the key before in time",
                 [&](const std::string& argument) {
                     goToKey(workspace, argument.empty() ? std::vector<ValuePath>{} : valuesMeant(workspace, argument),
                             -1);
                 },
                 open});
    actions.add({"key.auto", "Auto-key", "", "on|off", "Every edit of a value sets a key at the current time",
                 [&](const std::string& argument) {
                     workspace.timeline.autoKey = switchArgument("key.auto", argument, workspace.timeline.autoKey);
                 },
                 open, [&workspace] { return workspace.timeline.autoKey; }});
}

void addSelectedActions(Actions& actions, Workspace& workspace) {
    const auto some = [&workspace] { return !workspace.timeline.keys.empty(); };
    actions.add({"key.delete",
                 "Delete Keys",
                 "Delete",
                 "",
                 "Takes the selected keys away; also X",
                 [&](const std::string&) { deleteSelectedKeys(workspace); },
                 some,
                 {},
                 KeyRegion::Timeline});
    actions.add({"key.move", "Move Keys by…", "", "SECONDS", "Moves the selected keys in time",
                 [&](const std::string& argument) { moveAction(workspace, "key.move", argument, false); }, some});
    actions.add({"key.copy", "Copy Keys by…", "", "SECONDS", "Copies the selected keys to another time",
                 [&](const std::string& argument) { moveAction(workspace, "key.copy", argument, true); }, some});
    actions.add({"key.interpolation",
                 "Interpolation…",
                 "T",
                 "step|linear|smooth",
                 "How the value goes from the selected keys to the next ones",
                 [&](const std::string& argument) {
                     if (argument.empty())
                         workspace.timeline.menuWanted = true;
                     else
                         interpolationAction(workspace, argument);
                 },
                 some,
                 {},
                 KeyRegion::Timeline});
    actions.add({"key.grab",
                 "Move Keys",
                 "G",
                 "",
                 "The selected keys follow the mouse until a click",
                 [&](const std::string&) { workspace.timeline.grabWanted = TimelineState::Grab::Move; },
                 some,
                 {},
                 KeyRegion::Timeline});
    actions.add({"key.duplicate",
                 "Duplicate Keys",
                 "Shift+D",
                 "",
                 "Copies of the selected keys follow the mouse until a click",
                 [&](const std::string&) { workspace.timeline.grabWanted = TimelineState::Grab::Copy; },
                 some,
                 {},
                 KeyRegion::Timeline});
}

void addSelectionActions(Actions& actions, Workspace& workspace) {
    const auto open = [&workspace] { return workspace.open; };
    actions.add({"key.select", "Select Keys…", "", "TRACK N",
                 "Selects key N (from 0) of a value, or all its keys, by its path or label",
                 [&](const std::string& argument) { selectAction(workspace, argument); }, open});
    actions.add({"key.select-all",
                 "Select All Keys",
                 "A",
                 "",
                 "Selects every key of the scene",
                 [&](const std::string&) { selectAll(workspace); },
                 open,
                 {},
                 KeyRegion::Timeline});
    actions.add({"key.select-none",
                 "Select No Keys",
                 "Alt+A",
                 "",
                 "Clears the selection of keys",
                 [&](const std::string&) { workspace.timeline.keys.clear(); },
                 open,
                 {},
                 KeyRegion::Timeline});
    actions.add({"timeline.frame-all",
                 "Frame All Keys",
                 "Home",
                 "",
                 "Shows the scene's frames and all keys",
                 [&](const std::string&) { frameAll(workspace); },
                 open,
                 {},
                 KeyRegion::Timeline});
}

}  // namespace

std::string wordOf(Track::Interpolation interpolation) {
    switch (interpolation) {
        case Track::Interpolation::Step:
            return "step";
        case Track::Interpolation::Linear:
            return "linear";
        case Track::Interpolation::Smooth:
            return "smooth";
    }
    return {};
}

void addKeyActions(Actions& actions, Workspace& workspace) {
    addValueActions(actions, workspace);
    addSelectedActions(actions, workspace);
    addSelectionActions(actions, workspace);
}

}  // namespace voledit
