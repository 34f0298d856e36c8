// `voledit`: the command line (scene-format.md §2). Without a command it opens the editor.

#include <CLI/CLI.hpp>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <map>

#include "app/cli/commands.h"
#include "app/cli/terminal.h"
#include "core/base/error.h"

namespace {

using namespace voledit;

struct Description {
    const char* name;
    const char* text;
    Command (*add)(CLI::App&, const CommonArguments&);
};

constexpr Description kCommands[] = {
    {"render", "Render a scene to a picture, without a window", addRenderCommand},
    {"animate", "Render a scene over time to a video or to numbered pictures", addAnimateCommand},
    {"voxelize", "Sample a scene on a regular grid and write a volume", addVoxelizeCommand},
    {"info", "Say what a volume, a motion or a scene holds", addInfoCommand},
    {"sample", "Values of a volume or a scene at points", addSampleCommand},
    {"pose", "Where the joints of a motion are at a frame", addPoseCommand},
    {"rig", "Lay a skeleton into a volume by its shape, and let a motion drive it", addRigCommand},
    {"convert", "Convert between volume formats, and motions to BVH", addConvertCommand},
    {"transfers", "The library of deformations: their parameters and formulas", addTransfersCommand},
    {"edit", "Open the editor; with --headless drive it from recorded events", addEditCommand},
    {"bench", "The project's own measurements, as JSON", addBenchCommand},
};

int runCommand(int argc, char** argv) {
    CLI::App app{"voledit: deforms volumes directly, without resampling them", "voledit"};
    app.set_version_flag("--version", "voledit 0.1.0");
    app.require_subcommand(1);
    std::map<CLI::App*, Command> commands;
    CommonArguments common;
    addCommonArguments(app, common);
    for (const Description& d : kCommands) {
        CLI::App* command = app.add_subcommand(d.name, d.text);
        addCommonArguments(*command, common);
        commands[command] = d.add(*command, common);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error, std::cout, std::cerr) == 0 ? 0 : 2;
    }
    common.apply();
    return commands.at(app.get_subcommands().front())();
}

bool namesCommand(const std::string& word) {
    if (word == "--help" || word == "-h" || word == "--version") return true;
    for (const Description& d : kCommands)
        if (word == d.name) return true;
    return false;
}

/// Where the command stands, or would stand: behind the flags that every command takes.
std::size_t commandPosition(const std::vector<char*>& arguments) {
    std::size_t at = 1;
    while (at < arguments.size()) {
        const std::string word = arguments[at];
        if (word == "--threads" || word == "--memory-limit")
            at += 2;
        else if (word == "--quiet" || word == "--verbose" || word.starts_with("--threads=") ||
                 word.starts_with("--memory-limit="))
            ++at;
        else
            break;
    }
    return std::min(at, arguments.size());
}

/// `voledit [FILE…]` is `voledit edit [FILE…]`. Throws Error for a word that is neither a command nor a file.
void completeCommand(std::vector<char*>& arguments) {
    static char edit[] = "edit";
    const std::size_t at = commandPosition(arguments);
    const std::string word = at < arguments.size() ? arguments[at] : "";
    if (namesCommand(word)) return;
    std::error_code ignored;
    if (!word.empty() && word[0] != '-' && word.find_first_of("*%") == std::string::npos &&
        !std::filesystem::exists(word, ignored))
        throw Error(word, "there is no such file, and no such command", "check the name, or see voledit --help");
    arguments.insert(arguments.begin() + std::ptrdiff_t(at), edit);
}

}  // namespace

int main(int argc, char** argv) {
    // A reader that went away (a closed pipe) and a file that may not grow show as failed writes, not as deaths.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        std::vector<char*> arguments(argv, argv + argc);
        completeCommand(arguments);
        return runCommand(static_cast<int>(arguments.size()), arguments.data());
    } catch (const UsageError& error) {
        std::cerr << "voledit: " << error.what() << "\n";
        return 2;
    } catch (const Cancelled&) {
        std::cerr << "voledit: stopped; nothing was written\n";
        return 1;
    } catch (const std::bad_alloc&) {
        std::cerr << "voledit: out of memory; close other programs, or work on a smaller volume or grid\n";
        return 1;
    } catch (const std::exception& error) {
        std::cerr << "voledit: " << error.what() << "\n";
        return 1;
    }
}
