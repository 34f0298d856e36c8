#pragma once
// A mesh as it comes from a file.

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/types.h"

namespace voledit {

/// Points in the file's physical space, cells, and values at the points. A curvilinear grid's cells are hexahedra
/// (vertices i + 2j + 4k), a tetrahedral mesh's are tetrahedra; one of the two lists is empty.
struct MeshData {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 8>> hexahedra;
    std::vector<std::array<std::uint32_t, 4>> tetrahedra;
    std::vector<float> values;  // `channels` for each point, interleaved
    int channels = 1;
};

}  // namespace voledit
