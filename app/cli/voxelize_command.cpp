// `voledit voxelize`: a scene's root on a regular grid.

#include <CLI/App.hpp>
#include <cmath>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "core/base/error.h"
#include "core/eval/term_path.h"
#include "core/eval/voxelise.h"

namespace voledit {

namespace {

struct VoxelizeArguments {
    InputArguments input;
    std::string output, like, size, cellSize, bounds, what = "rgba", type;
    double time = kNaN, fill = 0;
};

VoxeliseWhat whatNamed(const std::string& name) {
    if (name == "scalar") return VoxeliseWhat::Scalar;
    if (name == "opacity") return VoxeliseWhat::Opacity;
    if (name == "rgba") return VoxeliseWhat::Rgba;
    if (name == "displacement") return VoxeliseWhat::Displacement;
    throw UsageError("--what " + name + ": there are scalar, opacity, rgba and displacement");
}

/// The number type of the one volume of a term; float for a mesh.
VoxelType sourceType(const Term& root) {
    const Term* source = oneSourceOf(root);
    const auto* volume = source ? std::get_if<VolumeTerm>(&source->node) : nullptr;
    return volume ? volume->volume->type() : VoxelType::Float;
}

VolumeGrid gridOver(const VoxelizeArguments& a, const CompiledScene& scene) {
    Box3 bounds = scene.root->bounds;
    if (!a.bounds.empty()) {
        const auto b = parseNumbers(a.bounds, 6, "--bounds");
        bounds = {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
    }
    const Vec3 extent = bounds.size();
    if (!a.bounds.empty() && !(extent.x > 0 && extent.y > 0 && extent.z > 0))
        throw UsageError("--bounds " + a.bounds + ": the box is empty; each maximum must be above its minimum");
    if (bounds.empty() || !(extent.x > 0 && extent.y > 0 && extent.z > 0))
        throw Error(a.input.file, "its root is empty, so there is no box to sample", "give --bounds x0,y0,z0,x1,y1,z1");
    if (!a.size.empty()) return cellCentredGrid(bounds, parseSize3(a.size, "--size"), 1);
    const Vec3 cell = parseSpacing(a.cellSize, "--spacing");
    Index3 size;
    for (int i = 0; i < 3; ++i) {
        const double n = std::max(1.0, std::ceil(extent[i] / cell[i] - 1e-9));
        if (n > 65536)
            throw Error("--spacing " + a.cellSize + ": more than 65536 cells an axis; give a larger spacing");
        size[i] = static_cast<int>(n);
        // The cells keep the spacing asked for and stand about the middle of the box.
        const double rest = n * cell[i] - extent[i];
        bounds.min[i] -= rest / 2;
        bounds.max[i] += rest / 2;
    }
    return cellCentredGrid(bounds, size, 1);
}

/// The result and the copy of it that is written must fit: the system would end the program without a word.
void checkFits(const VoxeliseRequest& request) {
    const int channels = request.what == VoxeliseWhat::Rgba ? 4 : request.what == VoxeliseWhat::Displacement ? 3 : 1;
    const Index3 n = request.grid.size;
    const double bytes = 2.0 * n.x * n.y * n.z * channels * double(byteSize(request.type));
    const auto mebibytes = [](double b) { return std::to_string(std::uint64_t(std::ceil(b / (1 << 20)))) + " MiB"; };
    if (bytes > double(memoryLimit()))
        throw Error("voxelize",
                    "a grid of " + std::to_string(n.x) + " × " + std::to_string(n.y) + " × " + std::to_string(n.z) +
                        " needs " + mebibytes(bytes) + ", more than the limit of " + mebibytes(double(memoryLimit())),
                    "give fewer cells, or raise --memory-limit");
}

int voxelize(const VoxelizeArguments& a, const CommonArguments& common) {
    VoxeliseRequest request;
    request.what = whatNamed(a.what);
    request.fill = a.fill;
    if (int(!a.like.empty()) + int(!a.size.empty()) + int(!a.cellSize.empty()) != 1)
        throw UsageError("give one of --like VOLUME, --size NxNxN and --spacing S, which say the grid");
    if (!a.like.empty() && !a.bounds.empty())
        throw UsageError("--bounds goes with --size or --spacing, not with --like");
    if (!a.type.empty()) {
        const auto type = voxelTypeOf(a.type);
        if (!type)
            throw UsageError("--type " + a.type +
                             ": there are int8, uint8, int16, uint16, int32, uint32, float and double");
        request.type = *type;
    }
    checkVolumeWritable(a.output);
    IoClient io;
    const OpenedScene opened = open(io, a.input, common);
    const CompiledScene scene = compileAt(opened, a.input, a.time);
    if (a.type.empty() && request.what == VoxeliseWhat::Scalar) request.type = sourceType(*scene.root);
    InputArguments like;
    like.file = a.like;
    request.grid = a.like.empty() ? gridOver(a, scene) : readVolumeFile(io, like, common).volume->grid();
    checkFits(request);
    withProgress("Voxelising", common.verbosity(), [&](Progress* progress) {
        const auto volume = voxelise(scene, request, progress);
        io.writeVolume(*volume, a.output, progress);
    });
    return 0;
}

}  // namespace

Command addVoxelizeCommand(CLI::App& command, const CommonArguments& common) {
    auto a = std::make_shared<VoxelizeArguments>();
    command.add_option("scene", a->input.file, "A scene (.voledit) or a volume file")->required();
    command.add_flag("--allow-outside", a->input.allowOutside, "Let a scene name files outside its folder");
    command.add_option("--raw", a->input.raw, "Read as headerless voxels: SIZE,TYPE[,SPACING][,endian]");
    command.add_option("-o,--output", a->output, "Volume to write: .nrrd .nhdr .nii .nii.gz .mhd .mha .vdb")
        ->required();
    command.add_option("--like", a->like, "Use the very grid of this volume")->type_name("VOLUME");
    command.add_option("--size", a->size, "Cells an axis, over the bounds")->type_name("NxNxN");
    command.add_option("--spacing", a->cellSize, "Edge of a cell, over the bounds")->type_name("S");
    command.add_option("--bounds", a->bounds, "Box to sample (the root's)")->type_name("x0,y0,z0,x1,y1,z1");
    command.add_option("--what", a->what, "scalar, opacity, rgba or displacement")->capture_default_str();
    command.add_option("--fill", a->fill, "Scalar where undefined or outside")->capture_default_str()->type_name("V");
    command.add_option("--type", a->type, "int8 … uint32, float, double (the source's for scalar, else float)");
    command.add_option("--time", a->time, "Time in seconds (the timeline's start)")->type_name("S");
    return [a, &common] { return voxelize(*a, common); };
}

}  // namespace voledit
