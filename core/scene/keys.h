#pragma once
// Keys on any value of a scene that may have tracks: what the timeline lists and edits (scene-format.md §1, Tracks).

#include <optional>
#include <string>
#include <vector>

#include "core/scene/nodes.h"

namespace voledit {

/// Where a value stands: the JSON pointer of its member in the saved scene: "/transfers/bend/angle", "/camera/eye",
/// "/root/of/translate", "/root/skeleton/joints/LeftArm/rotate" (joints by name, not by number),
/// "/transfers/pull/move/12/by" (control points by index in the lattice).
using ValuePath = std::string;

/// A value that may have tracks.
struct KeyableValue {
    ValuePath path;
    NodePath node;                // that it belongs to; "" for camera, light, opacityDistance
    std::string label;            // for people: "bend · angle", "actor · LeftArm rotate"
    std::vector<double> numbers;  // lists laid flat; of the first keys where it has tracks
    bool animated = false;
};

/// One key of a value: all its tracks' keys at one time.
struct KeyMark {
    double time = 0;                                                    // seconds
    Track::Interpolation interpolation = Track::Interpolation::Linear;  // from this key to the next
    bool operator==(const KeyMark&) const = default;
};

/// All values with tracks, in the order of the scene's tree; their keys.
std::vector<KeyableValue> animatedValues(const Scene& scene);
std::vector<KeyMark> keysOf(const Scene& scene, const ValuePath& path);

/// The value at `path`; nullopt where there is none.
std::optional<KeyableValue> valueAt(const Scene& scene, const ValuePath& path);
/// All values of the node at `node` itself ("" for the settings), with or without tracks.
std::vector<KeyableValue> valuesOf(const Scene& scene, const NodePath& node);
/// The numbers of the value at `path` at time t (seconds).
std::vector<double> numbersAt(const Scene& scene, const ValuePath& path, double t);

/// Puts a key at t with the value that is shown then; a value without tracks gets one. Throws Error where there is no
/// value.
void setKey(Scene& scene, const ValuePath& path, double t);
/// Puts a key at t with `numbers` (as many as the value has).
void setKey(Scene& scene, const ValuePath& path, double t, const std::vector<double>& numbers);
/// Takes away the key at t; with the last one goes the track, and the value stays as it was there.
void removeKey(Scene& scene, const ValuePath& path, double t);
/// Takes away all tracks of the value, which stays as it is at t.
void clearKeys(Scene& scene, const ValuePath& path, double t);

struct KeyRef {
    ValuePath path;
    double time = 0;
    bool operator==(const KeyRef&) const = default;
};
/// Moves (or copies) keys by `delta` seconds, all at once; a key that lands on one that is not moved replaces it.
/// Times are equal within a millionth of a second. Returns where they are now.
std::vector<KeyRef> moveKeys(Scene& scene, const std::vector<KeyRef>& keys, double delta, bool copy);
/// Interpolation from this key to the next.
void setInterpolation(Scene& scene, const KeyRef& key, Track::Interpolation interpolation);

void setTimeline(Scene& scene, const Timeline& timeline);

}  // namespace voledit
