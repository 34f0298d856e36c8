#pragma once
// What a legacy VTK file holds, and where. https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/io/stored_volume.h"

namespace voledit {

/// An array of numbers somewhere in a file.
struct VtkArray {
    /// The keyword that it stands under, in the order of how likely it is to be what is to be seen.
    enum class Role : std::uint8_t { Scalars, Values, Directions, Names };

    std::string name;
    StoredType type = StoredType::Float;
    std::uint64_t components = 1, tuples = 0;
    std::uint64_t offset = 0;  // byte at which its numbers begin; they are all there
    Role role = Role::Values;

    std::uint64_t count() const { return components * tuples; }
};

enum class VtkDataset : std::uint8_t { StructuredPoints, StructuredGrid, RectilinearGrid, UnstructuredGrid };

/// A legacy file of version 1 to 5. Members that its data set does not have are as here.
struct VtkFile {
    Source source;
    bool text = false;  // ASCII; else big-endian bytes
    VtkDataset dataset = VtkDataset::StructuredPoints;
    std::array<std::uint64_t, 3> dimensions{0, 0, 0};
    Vec3 origin{0}, spacing{1};
    std::optional<VtkArray> points;
    std::array<std::optional<VtkArray>, 3> coordinates;  // of a rectilinear grid
    std::optional<VtkArray> visible;                     // BLANKING: 0 where a point is not there
    /// Cells up to version 4: the number of its points, then their numbers, one cell after the other.
    std::optional<VtkArray> cells;
    /// Cells from version 5 on: where each cell's points begin, and one more; and their numbers.
    std::optional<VtkArray> offsets, connectivity;
    std::uint64_t cellCount = 0;
    std::optional<VtkArray> cellTypes;
    std::vector<VtkArray> pointData, cellData;
};

/// Goes through the whole file once, skipping the numbers. Throws Error where it is cut off, or not understood.
VtkFile scanVtk(const Source& source, VolumeSink& sink);

/// The array to be seen: the first SCALARS; else the first of VECTORS, FIELD and others; normals and numberings last.
/// Null where there is none.
const VtkArray* mainArray(const std::vector<VtkArray>& arrays);

}  // namespace voledit
