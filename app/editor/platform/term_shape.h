#pragma once
// What makes one scene's pictures cost another amount than another's: its structure, not its numbers.

#include <cstdint>
#include <vector>

#include "core/scene/compile.h"

namespace voledit {

/// Equal for scenes of the same nodes over the same volumes, whatever is dragged in them. A node used several times
/// counts once.
using TermShape = std::vector<std::uint64_t>;

TermShape shapeOf(const CompiledScene& scene);

}  // namespace voledit
