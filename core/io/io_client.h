#pragma once
// Files through the parser process `voledit-io`: volumes, pictures. Nothing of a stranger's file is parsed here.

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/base/picture.h"
#include "core/base/progress.h"
#include "core/fields/mesh_data.h"
#include "core/fields/volume.h"
#include "core/skeleton/motion.h"

namespace voledit {

/// How to read a headerless file: `--raw SIZE,TYPE[,SPACING][,endian]`.
struct RawFormat {
    Index3 size{0};
    VoxelType type = VoxelType::UInt8;
    Vec3 spacing{1};
    bool bigEndian = false;
};

/// "256x256x128,uint8,1x1x1.5,big" as the command line gives it (a spacing may be one number). Throws Error.
RawFormat parseRawFormat(const std::string& text);

struct ReadOptions {
    std::optional<RawFormat> raw;
    std::optional<Vec3> spacing;  // for stacks that carry none
    std::size_t memoryLimit = 0;  // bytes that the parser process may use; 0: `memoryLimit()`
};

/// Bounds what reading a file may take where the call itself says nothing, for the rest of the process; 0 is three
/// quarters of this machine's memory.
void setMemoryLimit(std::size_t bytes);
/// The bound in bytes, > 0.
std::size_t memoryLimit();

struct VolumeFile {
    std::shared_ptr<const Volume> volume;
    std::string format;      // "nrrd", "nifti", "metaimage", "dicom", "tiff", "png", "vdb", "vtk", "raw"
    std::string storedType;  // number type in the file, before slope and intercept ("uint8", "int64", "half", …)
    std::vector<std::string> warnings;  // what was repaired or cut, one line each
};

/// A tetrahedral mesh or a curvilinear grid with values at its points.
struct MeshFile {
    MeshData mesh;
    std::string format;           // "vtk"
    std::string storedType;       // number type of the values in the file
    VolumeStatistics statistics;  // of channel 0 at the points
    std::vector<std::string> warnings;
};

struct MotionFile {
    std::shared_ptr<const Motion> motion;
    std::string format;                 // "bvh", "gltf", "fbx", "dae"
    std::vector<std::string> warnings;  // what was repaired, cut or left out, one line each
};

/// True if `path` is named as a file that holds motions: .bvh, .gltf, .glb, .fbx, .dae, in any case.
bool isMotionFile(const std::filesystem::path& path);

/// How long the parser may work without any progress before it counts as hung. Both grow with the file (a second for
/// every 20 MB). Processor time is what tells: a slow disk or a busy machine is not the parser's fault.
struct IoPatience {
    double processorSeconds = 6;
    double wallSeconds = 60;
};

/// Resident connection to one parser process, started when first needed, restarted when it died. Calls from several
/// threads wait for each other.
class IoClient {
public:
    /// Starts nothing yet. `program`: voledit-io; by default $VOLEDIT_IO, else beside this program.
    explicit IoClient(std::filesystem::path program = {}, IoPatience patience = {});
    ~IoClient();
    IoClient(const IoClient&) = delete;
    IoClient& operator=(const IoClient&) = delete;

    /// Reads a volume: any format of scene-format.md §3, by content first, by name where that says nothing. `path` may
    /// be a file, a folder (DICOM series, picture stack) or a numbered pattern ("slice_%03d.png", "slice_*.png"). The
    /// voxels stay in the memory that the parser filled. Throws Error (file, cause, remedy; also where the file holds a
    /// mesh), Cancelled.
    VolumeFile readVolume(const std::filesystem::path& path, const ReadOptions& options = {},
                          Progress* progress = nullptr);
    /// The same for files that may hold a mesh instead: legacy VTK files.
    std::variant<VolumeFile, MeshFile> readVolumeOrMesh(const std::filesystem::path& path,
                                                        const ReadOptions& options = {}, Progress* progress = nullptr);

    /// Reads a motion: BVH here (core/io/bvh.h), the first clip of glTF, FBX and Collada through the parser. Throws
    /// Error (file, cause, remedy), Cancelled.
    MotionFile readMotion(const std::filesystem::path& path, Progress* progress = nullptr);

    /// Writes NRRD (.nrrd, .nhdr), NIfTI (.nii, .nii.gz), MetaImage (.mhd, .mha) or VDB (.vdb, float) by ending; beside
    /// `path`, then renamed. Throws Error, Cancelled.
    void writeVolume(const Volume& volume, const std::filesystem::path& path, Progress* progress = nullptr);

    /// Writes .png (8-bit RGB) or .exr (float RGBA, converted from sRGB to linear light) by ending; beside `path`, then
    /// renamed. A `transparent` picture's colours are multiplied by alpha, no background under them: it becomes a PNG
    /// of 8-bit RGBA with straight alpha, or an EXR whose linear light is multiplied by alpha. Throws Error.
    void writePicture(const Picture& picture, const std::filesystem::path& path, bool transparent = false);

    /// Reads a picture that OpenImageIO knows, first frame or page, as RGBA (values as stored, 0…1). Throws Error.
    Picture readPicture(const std::filesystem::path& path);

    /// Process number of the running parser, 0 where none runs.
    int processId() const;

private:
    struct Process;
    std::unique_ptr<Process> process_;
};

}  // namespace voledit
