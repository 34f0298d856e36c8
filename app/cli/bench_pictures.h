#pragma once
// Frames, edits and faults of a scene's pictures, for `voledit bench`.

#include <nlohmann/json.hpp>

#include "app/cli/drawing.h"
#include "app/opening/open_file.h"

namespace voledit {

/// One renderer's figures for one scene and one size of picture:
/// - `frame_ms`: the camera turned by a degree, to finished pixels;
/// - `rest_frame_ms` and `deformed_over_rest`: the same without the outermost transfers, and the ratio of the medians;
/// - `edit_to_pixel_ms` = `compile_ms` + `draw_ms`: a control point (or the outermost STF's first number) moved.
/// The last two only where the root holds a transfer. Each counted `repeats` times after one that warms caches; each
/// has a `…_cpu_ms`.
nlohmann::ordered_json benchPictures(Drawing& drawing, const OpenedScene& opened, Index2 size, int repeats);

/// The picture that faults are measured against: rays in double precision at steps of 1/16 of the smallest spacing.
Picture referencePicture(const CompiledScene& scene, Index2 size);

}  // namespace voledit
