#pragma once
// Playing an actor against making its volume anew for each frame, for `voledit bench`.

#include <nlohmann/json.hpp>

#include "app/cli/drawing.h"
#include "app/opening/open_file.h"

namespace voledit {

/// Draws `frames` consecutive frames of the scene's timeline (from its start, round and round) with `drawing`, each
/// compiled at its time: medians in milliseconds of compiling and of drawing, and of both together. Where the root
/// shows one volume, the same frames are also made the way of programs that resample: the root voxelised on a grid of
/// the volume's spacing, and that volume drawn; `revoxelised_over_direct` is the ratio of the medians.
nlohmann::ordered_json benchPlaying(Drawing& drawing, const OpenedScene& opened, Index2 size, int frames);

}  // namespace voledit
