#pragma once
// What is known of a term throughout a box, without sampling it.

#include "core/objects/term.h"

namespace voledit {

/// False only if `term` has opacity 0 at every point of `box`. A bound: boxes are pushed through the maps as boxes.
bool mayBeVisible(const Term& term, const Box3& box);

/// Bounds of an attribute (as `sample` names them) where `term` has it in `box`; low > high where it certainly has
/// none.
Interval attributeRange(const Term& term, const Box3& box, const std::string& attribute);

/// True only if `term` has the attribute wherever its opacity is above 0.
bool alwaysHas(const Term& term, const std::string& attribute);

}  // namespace voledit
