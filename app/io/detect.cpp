#include "app/io/detect.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "app/io/header_text.h"
#include "app/io/inflater.h"
#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLook = 1024;

bool hasNiftiMagic(std::string_view start) {
    if (start.size() < 348) return false;
    const std::string_view magic = start.substr(344, 3);
    return magic == "n+1" || magic == "ni1";
}

bool isMetaImage(const std::string& start) {
    for (const char* key : {"ObjectType", "NDims", "Comment", "ObjectSubType", "DimSize"})
        if (start.starts_with(key) && trimmed(start.substr(std::strlen(key), 16)).starts_with("=")) return true;
    return false;
}

std::string inflatedStart(const Source& source) {
    const InputFile file(source);
    Inflater inflater(file, 0);
    std::array<std::byte, 348> bytes;
    const std::size_t n = inflater.read(bytes);
    return {reinterpret_cast<const char*>(bytes.data()), n};
}

std::optional<Format> byContent(const Source& source, const std::string& start) {
    using namespace std::string_literals;
    if (start.starts_with("NRRD000")) return Format::Nrrd;
    if (start.starts_with("# vtk DataFile")) return Format::Vtk;
    if (start.starts_with("\x89PNG\r\n\x1a\n")) return Format::Png;
    for (const auto& magic : {"II*\0"s, "MM\0*"s, "II+\0"s, "MM\0+"s})
        if (start.starts_with(magic)) return Format::Tiff;
    if (start.starts_with(" BDV\0\0\0\0"s)) return Format::Vdb;
    if (start.size() >= 132 && start.compare(128, 4, "DICM") == 0) return Format::Dicom;
    if (hasNiftiMagic(start)) return Format::Nifti;
    if (isMetaImage(start)) return Format::MetaImage;
    if (start.starts_with("\x1f\x8b") && hasNiftiMagic(inflatedStart(source))) return Format::NiftiGz;
    return std::nullopt;
}

std::optional<Format> byName(const std::string& name) {
    const std::string low = lowered(name);
    constexpr std::array<std::pair<const char*, Format>, 15> endings{{{".nrrd", Format::Nrrd},
                                                                      {".nhdr", Format::Nrrd},
                                                                      {".nii", Format::Nifti},
                                                                      {".hdr", Format::Nifti},
                                                                      {".nii.gz", Format::NiftiGz},
                                                                      {".mhd", Format::MetaImage},
                                                                      {".mha", Format::MetaImage},
                                                                      {".vtk", Format::Vtk},
                                                                      {".vdb", Format::Vdb},
                                                                      {".dcm", Format::Dicom},
                                                                      {".dicom", Format::Dicom},
                                                                      {".ima", Format::Dicom},
                                                                      {".tif", Format::Tiff},
                                                                      {".tiff", Format::Tiff},
                                                                      {".png", Format::Png}}};
    for (const auto& [ending, format] : endings)
        if (low.ends_with(ending)) return format;
    return std::nullopt;
}

bool isPattern(const std::string& name) {
    return name.find_first_of("*%") != std::string::npos;
}

}  // namespace

Format detect(const Source& source) {
    std::error_code failed;
    const fs::file_status status = fs::status(source.path, failed);
    if (!fs::exists(status) && isPattern(source.path.filename().string())) return Format::Pattern;
    if (fs::is_directory(status)) return Format::Folder;
    const InputFile file(source);
    if (file.size() == 0) throw Error(source.name, "is empty", "copy or download the file anew");
    if (const auto format = byContent(source, file.start(kLook))) return *format;
    if (const auto format = byName(source.path.filename().string())) return *format;
    throw Error(source.name, "is no volume that voledit reads",
                "give NRRD, NIfTI-1, MetaImage, DICOM, TIFF, PNG, OpenVDB or legacy VTK; for headerless data say "
                "--raw SIZE,TYPE[,SPACING][,endian]");
}

bool looksLikeDicom(const Source& source) {
    try {
        const std::string start = InputFile(source).start(132);
        if (start.size() == 132 && start.compare(128, 4, "DICM") == 0) return true;
        const auto named = byName(source.path.filename().string());
        return named == Format::Dicom && !start.empty();
    } catch (const Error&) {
        return false;  // a pipe, or not ours to read
    }
}

}  // namespace voledit
