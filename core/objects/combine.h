#pragma once
// How the pre-images of a folded map become one sample (definitions.md §§4, 6).

#include <span>

#include "core/objects/term.h"

namespace voledit {

/// `preImages`, in the order of their cells, combined from left to right by the operator's formulas: opacity and
/// colour as in the table of definitions.md §4. `value` is that of the largest opacity, the first on a tie (one that
/// has a value before one that has none); the gradient is that of the sample which decides the opacity, the first
/// on a tie: the largest (union, merge), the smallest (intersection), the first (first). None gives an empty sample.
ObjectSample combined(std::span<const ObjectSample> preImages, Combine by);

}  // namespace voledit
