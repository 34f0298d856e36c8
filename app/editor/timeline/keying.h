#pragma once
// Keys on values: of the field under the mouse, of what is selected.

#include <optional>
#include <vector>

#include "app/editor/workspace.h"

namespace voledit {

/// The values that keys are put on where no field is meant: of the selected joints, of the selected control points,
/// else those of the selected node (without its frame; only the animated ones where there are any).
std::vector<ValuePath> selectedValues(const Workspace& workspace);

/// Puts keys at t on `values` as one step, and selects them. Throws Error where there are none, or one of them does not
/// exist.
void insertKeys(Workspace& workspace, const std::vector<ValuePath>& values, double t);
/// The same at the shown time for what is selected, also for joints and control points that the scene leaves at rest.
void insertSelectedKeys(Workspace& workspace);
/// Takes the keys of the shown time off `values`, as one step.
void removeKeys(Workspace& workspace, const std::vector<ValuePath>& values);
/// Takes all keys off `values`, which stay as they are shown, as one step.
void clearAllKeys(Workspace& workspace, const std::vector<ValuePath>& values);
/// Deletes the selected keys, as one step.
void deleteSelectedKeys(Workspace& workspace);
void setSelectedInterpolation(Workspace& workspace, Track::Interpolation interpolation);
/// Shows the next (`by` 1) or previous (−1) key's time of `values` (empty: of all); stays where there is none.
void goToKey(Workspace& workspace, const std::vector<ValuePath>& values, int by);

/// Drops selected keys that the scene does not hold any more. Once a frame.
void settleKeys(Workspace& workspace);

}  // namespace voledit
