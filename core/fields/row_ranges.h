#pragma once
// Smallest and largest of rows of numbers, element by element, by vector instructions.

#include <cstddef>
#include <span>

#include "core/fields/volume.h"

namespace voledit {

/// low[i] = the smallest of lowRows[r][i] over all r, high[i] = the largest of highRows[r][i]; NaN counts as nothing,
/// and where there is nothing else they are numeric_limits' infinity or largest number, and its negative or lowest.
/// Both lists are equally long; all rows, low and high hold `count` elements of `type`, wherever they begin; low and
/// high may not overlap any.
void rangesOfRows(VoxelType type, std::span<const void* const> lowRows, std::span<const void* const> highRows,
                  std::size_t count, void* low, void* high);

}  // namespace voledit
