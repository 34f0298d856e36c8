// `voledit convert`: between volume formats.

#include <CLI/App.hpp>

#include "app/cli/commands.h"
#include "app/cli/output.h"

namespace voledit {

Command addConvertCommand(CLI::App& command, const CommonArguments& common) {
    auto input = std::make_shared<InputArguments>();
    auto output = std::make_shared<std::string>();
    addInputArguments(command, *input, "input");
    command.add_option("output", *output, "Volume to write: .nrrd .nhdr .nii .nii.gz .mhd .mha .vdb")->required();
    return [input, output, &common] {
        refuseMotion(input->file);
        checkVolumeWritable(*output);
        IoClient io;
        const VolumeFile file = readVolumeFile(io, *input, common);
        withProgress("Writing " + *output, common.verbosity(),
                     [&](Progress* progress) { io.writeVolume(*file.volume, *output, progress); });
        return 0;
    };
}

}  // namespace voledit
