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
        checkWritable(*output);
        IoClient io;
        const OpenOptions options = input->options(common);
        withProgress("Converting", common.verbosity(), [&](Progress* progress) {
            const VolumeFile file = io.readVolume(input->file, options.read, progress);
            printWarnings(file.warnings);
            io.writeVolume(*file.volume, *output, progress);
        });
        return 0;
    };
}

}  // namespace voledit
