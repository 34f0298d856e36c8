#include "app/editor/timeline/timeline_actions.h"

#include <algorithm>
#include <sstream>

#include "app/editor/event_words.h"
#include "core/base/error.h"
#include "core/scene/keys.h"
#include "core/scene/scene_at.h"

namespace voledit {

namespace {

constexpr double kFarthest = 1e6;  // seconds

const Timeline& timelineOf(const Workspace& workspace) {
    return workspace.document.scene().timeline;
}

double numberWithin(const std::string& id, const std::string& argument, double least, double most) {
    const double number = numberOf(argument, id);
    if (!(number >= least && number <= most))
        throw Error(id, argument + " is out of range",
                    "give a number from " + numberText(least) + " to " + numberText(most));
    return number;
}

int frameNumber(const std::string& id, const std::string& argument) {
    const double number = numberWithin(id, argument, -1e6, 1e6);
    if (number != double(int(number))) throw Error(id, argument + " is no frame", "frames are whole numbers");
    return int(number);
}

void setPlaying(Workspace& workspace, bool playing) {
    if (playing == workspace.timeline.playback.playing()) return;
    if (playing)
        workspace.timeline.playback.start(workspace.time, timelineOf(workspace));
    else
        workspace.timeline.playback.stop();
}

void goToEnd(Workspace& workspace, bool last) {
    const Timeline& timeline = timelineOf(workspace);
    goToTime(workspace, timeOfFrame(timeline.start + (last ? frameCount(timeline) - 1 : 0), timeline));
}

/// "START END FPS", the last ones may be left out.
void rangeAction(Workspace& workspace, const std::string& argument) {
    Timeline timeline = timelineOf(workspace);
    std::istringstream words(argument);
    std::string word;
    if (words >> word) timeline.start = frameNumber("timeline.range", word);
    if (words >> word) timeline.end = frameNumber("timeline.range", word);
    if (words >> word) timeline.fps = numberWithin("timeline.range", word, 0.01, 1000);
    if (timeline.end <= timeline.start)
        throw Error("timeline.range", "ends at frame " + std::to_string(timeline.end) + " before it starts",
                    "give an end (exclusive) after the start, " + std::to_string(timeline.start));
    workspace.document.apply("Change timeline", [&](Scene& scene) { setTimeline(scene, timeline); });
}

void addPlayActions(Actions& actions, Workspace& workspace) {
    const auto open = [&workspace] { return workspace.open; };
    const auto playing = [&workspace] { return workspace.timeline.playback.playing(); };
    actions.add({"timeline.toggle", "Play/Pause", "Space", "", "Plays the timeline, or stops it where it is",
                 [&, playing](const std::string&) { setPlaying(workspace, !playing()); }, open});
    actions.add({"timeline.play", "Play", "", "", "Plays the timeline from the current frame",
                 [&](const std::string&) { setPlaying(workspace, true); }, open});
    actions.add({"timeline.pause", "Pause", "", "", "Stops playing and stays at the current frame",
                 [&](const std::string&) { setPlaying(workspace, false); }, open});
    actions.add({"timeline.loop", "Loop", "", "on|off", "After the last frame comes the first; else playing stops",
                 [&](const std::string& argument) {
                     bool& loop = workspace.timeline.playback.loop;
                     loop = switchArgument("timeline.loop", argument, loop);
                 },
                 open, [&workspace] { return workspace.timeline.playback.loop; }});
}

void addStepActions(Actions& actions, Workspace& workspace) {
    const auto open = [&workspace] { return workspace.open; };
    const auto stepBy = [&workspace](int by) {
        goToTime(workspace, steppedTime(workspace.time, by, timelineOf(workspace)));
    };
    actions.add({"timeline.goto", "Go to Time…", "", "SECONDS", "Shows the scene at a time",
                 [&](const std::string& argument) {
                     goToTime(workspace, numberWithin("timeline.goto", argument, -kFarthest, kFarthest));
                 },
                 open});
    actions.add({"timeline.frame", "Go to Frame…", "", "N", "Shows the scene at a frame",
                 [&](const std::string& argument) {
                     goToTime(workspace, timeOfFrame(frameNumber("timeline.frame", argument), timelineOf(workspace)));
                 },
                 open});
    actions.add({"timeline.step", "Step by Frames…", "", "N", "Goes N frames on, or back where N is below 0",
                 [stepBy](const std::string& argument) { stepBy(frameNumber("timeline.step", argument)); }, open});
    actions.add({"timeline.back", "Step Back", "Left", "", "Shows the frame before",
                 [stepBy](const std::string&) { stepBy(-1); }, open});
    actions.add({"timeline.forward", "Step Forward", "Right", "", "Shows the next frame",
                 [stepBy](const std::string&) { stepBy(1); }, open});
    actions.add({"timeline.start", "Go to Start", "Shift+Left", "", "Shows the first frame",
                 [&](const std::string&) { goToEnd(workspace, false); }, open});
    actions.add({"timeline.end", "Go to End", "Shift+Right", "", "Shows the last frame",
                 [&](const std::string&) { goToEnd(workspace, true); }, open});
}

}  // namespace

void goToTime(Workspace& workspace, double t) {
    workspace.time = t;
    workspace.timeline.playback.jump(t);
}

void advanceTime(Workspace& workspace, double seconds) {
    if (!workspace.open) workspace.timeline.playback.stop();
    if (workspace.timeline.playback.playing())
        workspace.time = workspace.timeline.playback.advance(seconds, timelineOf(workspace));
}

bool changesOverTime(const Workspace& workspace) {
    if (!workspace.open) return false;
    const Scene& scene = workspace.document.scene();
    const auto moves = [](const auto& asset) { return asset.second.kind == AssetKind::Motion; };
    return std::any_of(scene.assets.begin(), scene.assets.end(), moves) || animated(scene);
}

void addTimelineActions(Actions& actions, Workspace& workspace) {
    addPlayActions(actions, workspace);
    addStepActions(actions, workspace);
    const auto open = [&workspace] { return workspace.open; };
    actions.add({"timeline.range", "Set Range…", "", "START END FPS",
                 "First frame, the one after the last, and frames a second of the timeline",
                 [&](const std::string& argument) { rangeAction(workspace, argument); }, open});
    actions.add({"view.timeline", "Timeline", "", "on|off",
                 "Shows the timeline also where nothing changes over time, or hides it",
                 [&](const std::string& argument) {
                     workspace.timeline.wanted = switchArgument(
                         "view.timeline", argument, workspace.timeline.wanted.value_or(changesOverTime(workspace)));
                 },
                 open, [&workspace] { return workspace.timeline.wanted.value_or(changesOverTime(workspace)); }});
}

}  // namespace voledit
