// Legacy VTK files: structured points are volumes, the other grids meshes.

#include "app/io/checks.h"
#include "app/io/readers.h"
#include "app/io/scan_vtk.h"
#include "core/base/error.h"

namespace voledit {

namespace {

StoredVolume volumeOf(const VtkFile& file) {
    const std::string& name = file.source.name;
    const VtkArray* array = mainArray(file.pointData);
    if (!array && !file.cellData.empty())
        throw Error(name, "holds values of cells, not of points", "convert them to point data");
    if (!array) throw Error(name, "holds no values at its points", "the file is cut off, or save it with POINT_DATA");
    checkSizes(name + ", DIMENSIONS", file.dimensions, array->components);
    if (array->tuples != checkProduct(name, {file.dimensions[0], file.dimensions[1], file.dimensions[2]}))
        throw Error(name, "its POINT_DATA does not fit its DIMENSIONS", "correct the header");
    checkSpacing(name + ", SPACING", file.spacing);
    StoredVolume stored;
    stored.format = "vtk";
    stored.type = array->type;
    stored.encoding = file.text ? Encoding::Ascii : Encoding::Raw;
    stored.bigEndian = true;
    stored.setInterleaved(file.dimensions, array->components, 1);
    for (int a = 0; a < 3; ++a) stored.worldFromIndex[a][a] = file.spacing[a];
    stored.worldFromIndex[3] = Vec4(file.origin, 1);
    stored.parts = {{file.source, array->offset}};
    stored.moreMayFollow = true;
    return stored;
}

}  // namespace

void readVtk(const Source& source, VolumeSink& sink) {
    const VtkFile file = scanVtk(source, sink);
    if (file.dataset == VtkDataset::StructuredPoints) return load(source, volumeOf(file), sink);
    readVtkMesh(file, sink);
}

}  // namespace voledit
