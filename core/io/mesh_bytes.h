#pragma once
// A mesh in a memory file: points, values, cells, one behind the other.

#include <cstddef>
#include <span>

#include "core/fields/mesh_data.h"

namespace voledit {

/// What a mesh holds how many of.
struct MeshCounts {
    std::uint64_t points = 0, hexahedra = 0, tetrahedra = 0;
    std::int32_t channels = 1;
};

MeshCounts countsOf(const MeshData& mesh);
/// Length of the bytes below. Throws Error where the counts cannot be those of a mesh.
std::size_t byteSize(const MeshCounts& counts);
/// Fills `out`, byteSize(countsOf(mesh)) bytes.
void writeMesh(const MeshData& mesh, std::span<std::byte> out);
/// Inverse of `writeMesh`. Needs in.size() ≥ byteSize(counts). Indices may be out of range.
MeshData readMesh(const MeshCounts& counts, std::span<const std::byte> in);

}  // namespace voledit
