#pragma once
// The editor as the command line starts it.

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/types.h"
#include "render/context.h"

namespace voledit {

struct EditorOptions {
    std::filesystem::path file;        // scene or volume; empty: the welcome scene
    bool headless = false;             // offscreen, 1/60 s a frame, no clock; the same picture every time
    std::filesystem::path play;        // event file to replay (scene-format.md §4); empty: none
    std::filesystem::path record;      // writes all that happens as an event file; empty: does not
    std::filesystem::path screenshot;  // PNG of the whole window when the events are done; empty: none
    std::optional<Index2> size;        // window size in pixels; nullopt: 1280x800 (headless), the last or a fitting one
    double scale = 0;                  // size of letters and widgets; 0: the display's (1 when headless)
    double frameBudgetMs = 0;          // of a frame while something moves (a window); 0: 30
    std::string renderer;              // "slices", "rays" or "auto"; empty: slices (headless), auto (window)
    GlBackend gl = GlBackend::Auto;    // headless only
    bool listActions = false;          // prints the actions and returns
    bool allowOutside = false;         // scenes may name files outside their folder
};

/// Runs the editor until it is closed (headless: until the events are done). Gives the exit status: 0, or 1 where a
/// recorded event failed; its message stands on standard error with the file's line. Throws Error where it cannot
/// start (no display, an unreadable event file, a file that is not there when headless).
int runEditor(const EditorOptions& options);

}  // namespace voledit
