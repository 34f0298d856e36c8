#pragma once
// The named actions of time: playing, stepping, jumping, the scene's range of frames.

#include "app/editor/workspace.h"

namespace voledit {

/// Adds timeline.play, timeline.pause, timeline.toggle, timeline.goto, timeline.frame, timeline.step, timeline.start,
/// timeline.end, timeline.loop, timeline.range, timeline.frame-all, view.timeline. `workspace` outlives `actions`.
void addTimelineActions(Actions& actions, Workspace& workspace);

/// Shows the scene at t seconds; what plays goes on from there.
void goToTime(Workspace& workspace, double t);
/// What a frame of the editor passes, `seconds` long: the time that is shown, where it plays.
void advanceTime(Workspace& workspace, double seconds);
/// Whether something in the scene changes over time by keys or motions.
bool changesOverTime(const Workspace& workspace);

}  // namespace voledit
