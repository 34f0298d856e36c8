#pragma once
// Words of the command line that several commands share, and their parsing.

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

#include "app/cli/terminal.h"
#include "app/opening/open_file.h"
#include "core/base/types.h"

namespace CLI {
class App;
}

namespace voledit {

/// A flag with a value that it cannot have: exit status 2.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Flags that every command takes.
struct CommonArguments {
    bool quiet = false, verbose = false;
    int threads = 0;
    std::string memoryLimit;

    Verbosity verbosity() const { return quiet ? Verbosity::Quiet : verbose ? Verbosity::Verbose : Verbosity::Normal; }
    /// Applies threads and the memory limit to this process. Throws UsageError.
    void apply() const;
};

/// Flags that say how a file is read.
struct InputArguments {
    std::string file;
    bool allowOutside = false;
    std::string raw, spacing;

    /// Throws UsageError for a malformed value.
    OpenOptions options() const;
};

void addCommonArguments(CLI::App& command, CommonArguments& arguments);
/// `name`: what the positional is called in the help.
void addInputArguments(CLI::App& command, InputArguments& arguments, const std::string& name);

/// Compiles an opened scene at `time`, the timeline's start where that is NaN. Throws Error that names `input`'s file.
CompiledScene compileAt(const OpenedScene& opened, const InputArguments& input, double time, double aspect = 4.0 / 3.0);

/// Reads a motion with a progress bar and prints its warnings. Throws Error.
MotionFile readMotionFile(IoClient& io, const std::string& path, const CommonArguments& common);

/// Reads a volume with a progress bar and prints its warnings. Throws Error, also for a mesh.
VolumeFile readVolumeFile(IoClient& io, const InputArguments& input, const CommonArguments& common);
/// The same for files that may hold a mesh.
std::variant<VolumeFile, MeshFile> readVolumeOrMeshFile(IoClient& io, const InputArguments& input,
                                                        const CommonArguments& common);

/// Opens a scene or volume with a progress bar and prints its warnings.
OpenedScene open(IoClient& io, const InputArguments& input, const CommonArguments& common);

/// "960x720" (also with ×). Throws UsageError naming `flag`; both 1 … 16384.
Index2 parseSize2(const std::string& text, const std::string& flag);
/// "64x64x64". Throws UsageError; each 1 … 65536.
Index3 parseSize3(const std::string& text, const std::string& flag);
/// `count` finite numbers separated by commas. Throws UsageError.
std::vector<double> parseNumbers(const std::string& text, std::size_t count, const std::string& flag);
/// "1.5" or "1,1,2" (or x for comma). Throws UsageError.
Vec3 parseSpacing(const std::string& text, const std::string& flag);
/// "512M", "2GiB", "1000000" in bytes. Throws UsageError.
std::size_t parseBytes(const std::string& text, const std::string& flag);

}  // namespace voledit
