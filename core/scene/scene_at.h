#pragma once
// A scene at a time (definitions.md §5).

#include "core/scene/scene.h"

namespace voledit {

/// Whether anything in the scene has tracks.
bool hasTracks(const Scene& scene);
/// Whether anything in the scene has tracks or is moved by a motion. (Formulas over t change over time too, without
/// any.)
bool animated(const Scene& scene);

/// The scene at t seconds, an ordinary scene without tracks: every tracked value is its value then. Random access.
/// What has no tracks stays shared with `scene`; one without any is returned as it is. What tracks may carry out of its
/// range is held there: an `amount` in 0 … 1, a table's values not below the ones before.
Scene sceneAt(const Scene& scene, double t);

}  // namespace voledit
