#include "app/io/writers.h"

#include "app/io/header_text.h"
#include "app/io/module_loader.h"
#include "app/io/modules/vdb.h"
#include "core/base/error.h"

namespace voledit {

std::vector<std::string> writeAnyVolume(const VolumeOutput& volume) {
    const std::string file = volume.target.path.filename().string(), name = lowered(file);
    const auto ends = [&](const char* ending) { return name.ends_with(ending); };
    if (ends(".nrrd") || ends(".nhdr")) return writeNrrd(volume);
    if (ends(".nii") || ends(".nii.gz")) return writeNifti(volume);
    if (ends(".mha") || ends(".mhd")) return writeMetaImage(volume);
    if (ends(".vdb")) {
        moduleFunction<decltype(voleditWriteVdb)>("voledit-io-vdb.so", "voleditWriteVdb")(volume);
        return {file};
    }
    throw Error(volume.target.name, "its ending names no format that voledit writes",
                "end it in .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd or .vdb");
}

}  // namespace voledit
