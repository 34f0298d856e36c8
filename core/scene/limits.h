#pragma once
// How large a scene may be. A file beyond these is refused before anything is allocated for it.

#include <cstddef>

namespace voledit {

/// Bytes of a scene file.
inline constexpr std::size_t kLargestSceneFile = std::size_t(256) << 20;
/// Objects and lists within each other, in a file and through `use`. Walking the deepest takes about 0.4 MiB of stack,
/// and ten times that under sanitizers.
inline constexpr std::size_t kDeepestNesting = 500;
/// Nodes of a compiled term that one point may visit: what is shared counts as often as it is used.
inline constexpr std::size_t kMostTermNodes = 100'000;
/// Numbers, texts, lists and objects of a scene file: they take up to a hundred bytes each.
inline constexpr std::size_t kMostJsonValues = 8'000'000;
/// Mapped cells of all lattices together: at about half a kilobyte each, 2 GiB.
inline constexpr std::size_t kMostCells = 4'000'000;
/// Control points of all lattices together.
inline constexpr std::size_t kMostControlPoints = 1'000'000;
/// Degree of a Bézier lattice along one axis.
inline constexpr int kLargestDegree = 64;
/// Control points of a B-spline lattice along one axis.
inline constexpr int kMostPointsAlongAxis = 1024;

}  // namespace voledit
