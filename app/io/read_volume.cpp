#include "app/io/read_volume.h"

#include "app/io/check_vdb.h"
#include "app/io/detect.h"
#include "app/io/limits.h"
#include "app/io/module_loader.h"
#include "app/io/modules/dicom.h"
#include "app/io/modules/pictures.h"
#include "app/io/modules/vdb.h"
#include "app/io/png_file.h"
#include "app/io/readers.h"
#include "app/io/stacks.h"

namespace voledit {

namespace {

void limitParsingOf(const std::vector<Source>& files) {
    std::uint64_t bytes = 0;
    for (const Source& file : files) bytes += InputFile(file).size();
    limitParsing(bytes);
}

void readStack(const SliceStack& stack, VolumeSink& sink) {
    if (stack.format == "png") return readPngSlices(stack, sink);
    auto* read = moduleFunction<decltype(voleditReadSlices)>("voledit-io-pictures.so", "voleditReadSlices");
    limitParsingOf(stack.files);
    read(stack, sink);
}

void readSeries(const DicomFiles& files, VolumeSink& sink) {
    auto* read = moduleFunction<decltype(voleditReadDicom)>("voledit-io-dicom.so", "voleditReadDicom");
    limitParsingOf(files.files);
    read(files, sink);
}

void readVdb(const Source& source, VolumeSink& sink) {
    checkVdb(source);
    auto* read = moduleFunction<decltype(voleditReadVdb)>("voledit-io-vdb.so", "voleditReadVdb");
    limitParsingOf({source});
    read(source, sink);
}

/// A DICOM series where there is one, else slices.
void readFolder(const Source& source, const std::optional<Vec3>& spacing, VolumeSink& sink) {
    if (const DicomFiles series = dicomFilesIn(source); !series.files.empty()) return readSeries(series, sink);
    readStack(stackInFolder(source, spacing, sink), sink);
}

}  // namespace

void readAnyVolume(const IoRequest& request, VolumeSink& sink) {
    const Source source{request.path, request.shownPath};
    if (request.raw) return load(source, parseRaw(source, *request.raw), sink);
    const Format format = detect(source);
    switch (format) {
        case Format::Nrrd:
            return load(source, parseNrrd(source, sink), sink);
        case Format::Nifti:
        case Format::NiftiGz:
            return load(source, parseNifti(source, format == Format::NiftiGz, sink), sink);
        case Format::MetaImage:
            return load(source, parseMetaImage(source, sink), sink);
        case Format::Vtk:
            return readVtk(source, sink);
        case Format::Vdb:
            return readVdb(source, sink);
        case Format::Dicom:
            return readSeries(seriesOfFile(source), sink);
        case Format::Tiff:
        case Format::Png:
            return readStack(stackOfFile(source, format, request.spacing, sink), sink);
        case Format::Folder:
            return readFolder(source, request.spacing, sink);
        case Format::Pattern:
            return readStack(stackOfPattern(source, request.spacing, sink), sink);
    }
}

}  // namespace voledit
