// `voledit edit`: the editor, in a window or headless.

#include <CLI/App.hpp>

#include "app/cli/commands.h"
#include "app/editor/run_editor.h"
#include "app/editor/workspace.h"

namespace voledit {

namespace {

struct EditArguments {
    std::vector<std::string> files;
    bool headless = false, listActions = false, allowOutside = false;
    std::string play, record, screenshot, size, renderer, gl = "auto";
    double scale = 0, frameBudget = 30;
};

EditorOptions optionsOf(const EditArguments& a) {
    EditorOptions options;
    if (a.files.size() > 1) throw UsageError("give one scene or volume; the editor shows one at a time");
    if (!a.files.empty()) options.file = a.files.front();
    options.headless = a.headless;
    options.play = a.play;
    options.record = a.record;
    options.screenshot = a.screenshot;
    if (!a.size.empty()) options.size = parseSize2(a.size, "--size");
    if (a.scale != 0 && !(a.scale >= 0.5 && a.scale <= 4)) throw UsageError("--scale: give a number from 0.5 to 4");
    options.scale = a.scale;
    if (!(a.frameBudget >= kLeastFrameBudget && a.frameBudget <= kMostFrameBudget))
        throw UsageError("--frame-budget: give milliseconds from 5 to 1000");
    options.frameBudgetMs = a.frameBudget;
    if (!a.renderer.empty() && a.renderer != "slices" && a.renderer != "rays" && a.renderer != "auto")
        throw UsageError("--renderer " + a.renderer + ": there are slices, rays and auto");
    options.renderer = a.renderer;
    if (a.gl != "auto" && a.gl != "egl" && a.gl != "osmesa")
        throw UsageError("--gl " + a.gl + ": there are auto, egl and osmesa");
    options.gl = a.gl == "egl" ? GlBackend::Egl : a.gl == "osmesa" ? GlBackend::Osmesa : GlBackend::Auto;
    options.listActions = a.listActions;
    options.allowOutside = a.allowOutside;
    return options;
}

}  // namespace

Command addEditCommand(CLI::App& command, const CommonArguments&) {
    auto a = std::make_shared<EditArguments>();
    command.add_option("file", a->files, "A scene (.voledit) or a volume (the welcome scene)");
    command.add_flag("--headless", a->headless, "Without a window; the same picture every time");
    command.add_option("--play", a->play, "Replay recorded events")->type_name("EVENTS");
    command.add_option("--record", a->record, "Record events to a file")->type_name("EVENTS");
    command.add_option("--screenshot", a->screenshot, "Save what the window shows at the end")->type_name("OUT.png");
    command.add_option("--size", a->size, "Window size in pixels")->type_name("WxH");
    command.add_option("--scale", a->scale, "Size of letters and widgets, e.g. 2")->type_name("F");
    command
        .add_option("--frame-budget", a->frameBudget,
                    "Milliseconds that a frame may take while something moves; pictures are as fine as that allows")
        ->capture_default_str()
        ->type_name("MS");
    command.add_option("--renderer", a->renderer, "slices, rays or auto");
    command.add_option("--gl", a->gl, "OpenGL when headless: osmesa, egl or auto")->capture_default_str();
    command.add_flag("--list-actions", a->listActions, "List the named actions and stop");
    command.add_flag("--allow-outside", a->allowOutside, "Let a scene name files outside its folder");
    return [a] { return runEditor(optionsOf(*a)); };
}

}  // namespace voledit
