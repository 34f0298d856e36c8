#pragma once
// Where the program's own files are.

#include <filesystem>

namespace voledit {

/// Folder of the running program.
std::filesystem::path programFolder();

/// `resources/`: $VOLEDIT_RESOURCES if set, else beside an installed program (../share/voledit/resources), else the
/// source tree that it was built from.
std::filesystem::path resourceFolder();

/// `shaders/`, found the same way ($VOLEDIT_SHADERS).
std::filesystem::path shaderFolder();

}  // namespace voledit
