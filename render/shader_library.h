#pragma once
// Programs from the files of shaders/: #include, variants by #define, errors with file and line.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/gl_objects.h"

namespace voledit {

/// One program: a vertex and a fragment file of shaders/, the names that are defined (as 1, or NAME=VALUE), and text
/// that was generated.
struct ProgramVariant {
    std::string vertex;    // "slice.vert"
    std::string fragment;  // "slice.frag"
    std::vector<std::string> defines;
    std::string generated = {};  // takes the place of `#include "generated"`

    auto operator<=>(const ProgramVariant&) const = default;
};

/// A shader file with its includes put in, and where each of its lines came from.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  // #line's second number indexes it
};

/// Reads `folder`/`file`; `#include "x"` is replaced by `folder`/x, each file once, and `#include "generated"` by
/// `generated`. `defines` follow the #version line. Throws Error for a missing file or an include that leaves `folder`.
ShaderSource loadShader(const std::filesystem::path& folder, const std::string& file,
                        const std::vector<std::string>& defines, const std::string& generated = {});

/// Compiles programs on first use and keeps them; of those with generated text the ones used last.
class ShaderLibrary {
public:
    /// Programs with generated text that are kept.
    static constexpr std::size_t kMostGenerated = 32;

    explicit ShaderLibrary(std::filesystem::path folder);

    /// The program of `variant`; valid until kMostGenerated others were asked for. Throws Error with the driver's
    /// message, in which files and lines are ours.
    Program& get(const ProgramVariant& variant);

    /// Programs compiled so far.
    std::size_t compiled() const { return compiled_; }

private:
    struct Kept {
        Program program;
        std::size_t lastUse = 0;
    };
    Program compile(const ProgramVariant& variant);
    void dropOldest();

    std::filesystem::path folder_;
    std::map<ProgramVariant, Kept> programs_;
    std::size_t compiled_ = 0, uses_ = 0;
};

}  // namespace voledit
