#pragma once
// Programs from the files of shaders/: #include, variants by #define, errors with file and line.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/gl_objects.h"

namespace voledit {

/// One program: a vertex and a fragment file of shaders/ and the names that are defined (as 1, or NAME=VALUE).
struct ProgramVariant {
    std::string vertex;    // "slice.vert"
    std::string fragment;  // "slice.frag"
    std::vector<std::string> defines;

    auto operator<=>(const ProgramVariant&) const = default;
};

/// A shader file with its includes put in, and where each of its lines came from.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  // #line's second number indexes it
};

/// Reads `folder`/`file`; `#include "x"` is replaced by `folder`/x, each file once. `defines` follow the #version line.
/// Throws Error for a missing file or an include that leaves `folder`.
ShaderSource loadShader(const std::filesystem::path& folder, const std::string& file,
                        const std::vector<std::string>& defines);

/// Compiles programs on first use and keeps them.
class ShaderLibrary {
public:
    explicit ShaderLibrary(std::filesystem::path folder);

    /// The program of `variant`. Throws Error with the driver's message, in which files and lines are ours.
    Program& get(const ProgramVariant& variant);

private:
    std::filesystem::path folder_;
    std::map<ProgramVariant, Program> programs_;
};

}  // namespace voledit
