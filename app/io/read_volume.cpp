#include "app/io/read_volume.h"

#include "app/io/detect.h"
#include "app/io/readers.h"
#include "core/base/error.h"

namespace voledit {

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
        default:
            throw Error(source.name, "its format is not read by this build", "convert it to NRRD");
    }
}

}  // namespace voledit
