// NRRD and MetaImage: a text header, then the voxels, packed or in a file of their own.

#include <cstdio>
#include <glm/geometric.hpp>

#include "app/io/header_text.h"
#include "app/io/output_file.h"
#include "app/io/writers.h"

namespace voledit {

namespace {

constexpr std::size_t kChunk = 4 << 20;

/// Shortest text that reads back as the same number.
std::string exact(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

std::string vectorText(const Vec3& v, const char* separator) {
    return exact(v.x) + separator + exact(v.y) + separator + exact(v.z);
}

void writeVoxels(OutputFile& file, const VolumeOutput& volume) {
    for (std::size_t at = 0; at < volume.voxels.size(); at += kChunk) {
        file.write(volume.voxels.subspan(at, std::min(kChunk, volume.voxels.size() - at)));
        volume.progress(double(at) / double(volume.voxels.size()));
    }
}

/// The target with another ending, for the data of a header.
Source dataTarget(const VolumeOutput& volume, const char* ending) {
    Source data = volume.target;
    data.path.replace_extension(ending);
    return data;
}

void writeText(const Source& target, const std::string& text) {
    OutputFile file(target);
    file.write(text);
    file.close();
}

}  // namespace

std::vector<std::string> writeNrrd(const VolumeOutput& volume) {
    const VolumeGrid& g = volume.grid;
    const bool detached = lowered(volume.target.path.extension().string()) == ".nhdr";
    const bool several = g.channels > 1;
    std::string text = "NRRD0005\n# http://teem.sourceforge.net/nrrd/format.html\n";
    text += "type: " + std::string(nameOf(volume.type)) + "\n";
    text += "dimension: " + std::string(several ? "4" : "3") + "\nspace: left-posterior-superior\nsizes: ";
    if (several) text += std::to_string(g.channels) + " ";
    text += std::to_string(g.size.x) + " " + std::to_string(g.size.y) + " " + std::to_string(g.size.z);
    text += several ? "\nspace directions: none" : "\nspace directions:";
    for (int a = 0; a < 3; ++a) text += " (" + vectorText(Vec3(g.worldFromIndex[a]), ",") + ")";
    text += several ? "\nkinds: vector domain domain domain" : "\nkinds: domain domain domain";
    text += "\nendian: little\nencoding: " + std::string(detached ? "raw" : "gzip");
    text += "\nspace origin: (" + vectorText(g.origin(), ",") + ")\n";
    if (!detached) {
        OutputFile file(volume.target);
        file.write(text + "\n");
        file.pack(Packing::Gzip);
        writeVoxels(file, volume);
        file.close();
        return {volume.target.path.filename().string()};
    }
    const Source data = dataTarget(volume, ".raw");
    OutputFile file(data);
    writeVoxels(file, volume);
    file.close();
    const std::string name = data.path.filename().string();
    writeText(volume.target, text + "data file: " + name + "\n");
    return {name, volume.target.path.filename().string()};
}

namespace {

std::string metaType(VoxelType type) {
    switch (type) {
        case VoxelType::Int8:
            return "MET_CHAR";
        case VoxelType::UInt8:
            return "MET_UCHAR";
        case VoxelType::Int16:
            return "MET_SHORT";
        case VoxelType::UInt16:
            return "MET_USHORT";
        case VoxelType::Int32:
            return "MET_INT";
        case VoxelType::UInt32:
            return "MET_UINT";
        case VoxelType::Float:
            return "MET_FLOAT";
        case VoxelType::Double:
            break;
    }
    return "MET_DOUBLE";
}

/// All lines but those of the data's size and place.
std::string metaHeader(const VolumeOutput& volume, bool compressed) {
    const VolumeGrid& g = volume.grid;
    const Mat3 directions = g.direction();
    std::string text = "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n";
    text += std::string("CompressedData = ") + (compressed ? "True" : "False") + "\nTransformMatrix =";
    for (int a = 0; a < 3; ++a) text += " " + vectorText(directions[a], " ");
    text += "\nOffset = " + vectorText(g.origin(), " ");
    text += "\nCenterOfRotation = 0 0 0\nElementSpacing = " + vectorText(g.spacing(), " ");
    text += "\nDimSize = " + std::to_string(g.size.x) + " " + std::to_string(g.size.y) + " " +
            std::to_string(g.size.z) + "\n";
    if (g.channels > 1) text += "ElementNumberOfChannels = " + std::to_string(g.channels) + "\n";
    return text + "ElementType = " + metaType(volume.type) + "\n";
}

}  // namespace

std::vector<std::string> writeMetaImage(const VolumeOutput& volume) {
    const std::string name = volume.target.path.filename().string();
    if (lowered(volume.target.path.extension().string()) == ".mha") {
        // A header before packed data would have to tell its size in advance.
        OutputFile file(volume.target);
        file.write(metaHeader(volume, false) + "ElementDataFile = LOCAL\n");
        writeVoxels(file, volume);
        file.close();
        return {name};
    }
    const Source data = dataTarget(volume, ".zraw");
    OutputFile file(data);
    file.pack(Packing::Zlib);
    writeVoxels(file, volume);
    file.pack(Packing::Plain);
    const std::string size = std::to_string(file.size());
    file.close();
    const std::string dataName = data.path.filename().string();
    writeText(volume.target,
              metaHeader(volume, true) + "CompressedDataSize = " + size + "\nElementDataFile = " + dataName + "\n");
    return {dataName, name};
}

}  // namespace voledit
