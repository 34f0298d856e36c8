#pragma once
// Every edit of a scene, as a free function. Undo is a snapshot, so none has an inverse.

#include <string>
#include <vector>

#include "core/scene/compile.h"
#include "core/scene/scene.h"
#include "core/scene/when.h"

namespace voledit {

/// A scene of one volume: asset `name`, object `name`, root `{use: name}`, with `preset` ("" for the grey ramp).
Scene sceneOfVolume(const std::string& assetPath, const std::string& name, const std::string& preset);

/// Wraps the root in a transfer by a new lattice `name` (made unique) over `frame`, kept in `transfers`. Where the root
/// is a transfer already, the lattice is appended to its list. Returns the name used.
std::string addLattice(Scene& scene, const std::string& name, const FfdTransfer& lattice, const Frame& frame);

/// Takes the transfer `name` out of all that uses it and of `transfers`, as removeNode does. Throws Error if there is
/// none.
void removeTransfer(Scene& scene, const std::string& name);

/// Names of the scene's lattices (entries of `transfers` of type ffd, and named inline ones), the outermost first.
std::vector<std::string> latticeNames(const Scene& scene);
/// The transfer `name`, or null. Finds entries of `transfers` and inline ones with that `name`.
const Transfer* findTransfer(const Scene& scene, const std::string& name);

/// Position of control point `point` of lattice `name`, world units, before the transfers outside it. `frame` is the
/// transfer's own or, where it is left out, the operand's box. Throws Error if the lattice is gone.
Vec3 controlPoint(const Scene& scene, const std::string& name, std::size_t point, const Frame& frame);
/// Moves control points `points` of lattice `name` by `offset`, world units: with `when` as it says, without at every
/// time. Throws Error if the lattice is gone or a point is out of range.
void moveControlPoints(Scene& scene, const std::string& name, const std::vector<std::size_t>& points,
                       const Vec3& offset, const When& when = {});
/// Moves control point `point` to `position`, world units.
void setControlPoint(Scene& scene, const std::string& name, std::size_t point, const Vec3& position,
                     const When& when = {});
/// All control points of lattice `name` back to rest (or only `points`, where it is not empty).
void resetLattice(Scene& scene, const std::string& name, const std::vector<std::size_t>& points);
/// Degree (Bézier) or points (B-spline) and cells of lattice `name`. Control points are elevated where the new lattice
/// can hold the old shape (Bézier to a higher degree); else the new lattice is fitted at its Greville points. Where the
/// points change, their tracks go: the shape is that of the first keys.
void setLatticeShape(Scene& scene, const std::string& name, LatticeBasis basis, Index3 points, Index3 cells,
                     const Frame& frame);

void setTransferEnabled(Scene& scene, const std::string& name, bool enabled);
void setTransferAmount(Scene& scene, const std::string& name, double amount, const When& when = {});
void setTransferOutside(Scene& scene, const std::string& name, Outside outside);

/// Appearance of the volume object that shows `asset`. Throws Error if there is none.
void setAppearance(Scene& scene, const std::string& asset, const Appearance& appearance);
const Appearance* findAppearance(const Scene& scene, const std::string& asset);

/// Settings that are not what they were (at `when.time`; else by their first keys) change as `when` says; the others
/// keep their tracks.
void setCamera(Scene& scene, const Camera& camera);
void setRenderSettings(Scene& scene, const RenderSettings& settings, const When& when = {});
void setOpacityDistance(Scene& scene, double distance, const When& when = {});

}  // namespace voledit
