#pragma once
// The files of an animation other than its result: what runs leave behind, and taking it away.

#include "app/animation/animation_output.h"

namespace voledit {

/// Makes OUT.frames/ of a video. Throws Error.
void makeFrameFolder(const AnimationOutput& output);

/// Takes away what killed runs left where frames are written: hidden folders with a half-written frame in them. Nothing
/// else is touched.
void removeLeftovers(const AnimationOutput& output);

/// Takes away a video's frames and their record, and OUT.frames/ where nothing else is in it. Of numbered pictures
/// nothing is removed.
void removeFrames(const AnimationOutput& output);

}  // namespace voledit
