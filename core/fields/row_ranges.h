#pragma once
// Smallest and largest of rows of numbers, element by element, by vector instructions.

#include <cstddef>
#include <span>

namespace voledit {

/// low[i] = the smallest of lowRows[r][i] over all r, high[i] = the largest of highRows[r][i]; NaN counts as nothing,
/// and where there is nothing else they are numeric_limits' infinity or largest number, and its negative or lowest.
/// Both lists are equally long, all rows hold `count` elements, wherever they begin; low and high may not overlap any.
/// T is one of the types that VoxelType names.
template <class T>
void rangesOfRows(std::span<const T* const> lowRows, std::span<const T* const> highRows, std::size_t count, T* low,
                  T* high);

}  // namespace voledit
