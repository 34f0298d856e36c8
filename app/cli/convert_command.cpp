// `voledit convert`: between volume formats, and any motion to BVH.

#include <CLI/App.hpp>

#include "app/cli/commands.h"
#include "app/cli/output.h"
#include "core/base/error.h"
#include "core/io/bvh.h"

namespace voledit {

namespace {

int convertMotion(IoClient& io, const InputArguments& input, const std::filesystem::path& output,
                  const CommonArguments& common) {
    if (output.extension() != ".bvh" && output.extension() != ".BVH")
        throw Error(output.string(), "motions are written as BVH only", "end it in .bvh");
    checkWritable(output);
    writeBvh(*readMotionFile(io, input.file, common).motion, output);
    return 0;
}

}  // namespace

Command addConvertCommand(CLI::App& command, const CommonArguments& common) {
    auto input = std::make_shared<InputArguments>();
    auto output = std::make_shared<std::string>();
    addInputArguments(command, *input, "input");
    command
        .add_option("output", *output, "Volume to write: .nrrd .nhdr .nii .nii.gz .mhd .mha .vdb; of a motion: .bvh")
        ->required();
    return [input, output, &common] {
        IoClient io;
        if (isMotionFile(input->file)) return convertMotion(io, *input, *output, common);
        checkVolumeWritable(*output);
        const VolumeFile file = readVolumeFile(io, *input, common);
        withProgress("Writing " + *output, common.verbosity(),
                     [&](Progress* progress) { io.writeVolume(*file.volume, *output, progress); });
        return 0;
    };
}

}  // namespace voledit
