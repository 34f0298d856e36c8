#pragma once
// The way from the root of a compiled term inwards, as far as it is one way.

#include <string>
#include <vector>

#include "core/objects/term.h"

namespace voledit {

/// An STF of a `by` list, and where it has carried a point.
struct PathPoint {
    std::string name;  // may be empty
    Vec3 point;        // after the whole STF; kUndefined where it is undefined
};

/// The point p on its way from deformed to undeformed space: one entry for each entry of each `by` list, the outermost
/// first. Placements and displacements carry it on without an entry, recolouring leaves it, an operator of constructive
/// volume geometry, where the way would part, ends it.
std::vector<PathPoint> pathThrough(const Term& root, const Vec3& p);

/// The outermost `transfer` of a term: the maps above it, and those of its whole `by` list; of both the outermost
/// first. Empty `list`: there is none before the way parts.
struct OutermostTransfer {
    std::vector<const TransferTerm*> above, list;
};
OutermostTransfer outermostTransfer(const Term& root);

/// The one volume or mesh that the way leads to; null where it ends at something else.
const Term* oneSourceOf(const Term& root);

}  // namespace voledit
