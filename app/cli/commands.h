#pragma once
// The commands of `voledit`: each adds its flags to the parser and gives the function that does the work.

#include <functional>

#include "app/cli/arguments.h"

namespace voledit {

/// Does the work and gives the exit status. Throws Error (1), UsageError (2), Cancelled (1).
using Command = std::function<int()>;

Command addRenderCommand(CLI::App& command, const CommonArguments& common);
Command addAnimateCommand(CLI::App& command, const CommonArguments& common);
Command addVoxelizeCommand(CLI::App& command, const CommonArguments& common);
Command addInfoCommand(CLI::App& command, const CommonArguments& common);
Command addSampleCommand(CLI::App& command, const CommonArguments& common);
Command addPoseCommand(CLI::App& command, const CommonArguments& common);
Command addRigCommand(CLI::App& command, const CommonArguments& common);
Command addConvertCommand(CLI::App& command, const CommonArguments& common);
Command addTransfersCommand(CLI::App& command, const CommonArguments& common);
Command addEditCommand(CLI::App& command, const CommonArguments& common);
Command addBenchCommand(CLI::App& command, const CommonArguments& common);

}  // namespace voledit
