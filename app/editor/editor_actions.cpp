// The editor's own actions: files, undo, views, looks. The tools add theirs (tools/tool_actions.h).

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/editor/editor.h"
#include "app/editor/navigation.h"
#include "app/editor/tools/tool_actions.h"
#include "core/base/error.h"
#include "core/scene/appearance.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

double numberArgument(const std::string& id, const std::string& argument, double min, double max) {
    double value = 0;
    const char* end = argument.data() + argument.size();
    const auto [at, code] = std::from_chars(argument.data(), end, value);
    if (argument.empty() || code != std::errc() || at != end || !(value >= min && value <= max))
        throw Error(id + " takes a number from " + std::to_string(min) + " to " + std::to_string(max) + ", not \"" +
                    argument + "\"");
    return value;
}

RendererChoice rendererNamed(const std::string& name) {
    if (name == "slices") return RendererChoice::Slices;
    if (name == "rays") return RendererChoice::Rays;
    if (name == "auto") return RendererChoice::Auto;
    throw Error("view.renderer takes slices, rays or auto, not \"" + name + "\"");
}

// Asset names of the scene's volumes that a volume object shows.
std::vector<std::string> shownVolumes(const Workspace& workspace) {
    std::vector<std::string> names;
    for (const auto& [name, volume] : workspace.assets.volumes)
        if (findAppearance(workspace.document.scene(), name)) names.push_back(name);
    return names;
}

void applyPreset(Workspace& workspace, const std::string& argument) {
    Appearance appearance;
    if (argument != "grey-ramp") appearance.preset = presetNamed(argument).name;
    workspace.document.apply("Change appearance", [&](Scene& scene) {
        for (const std::string& asset : shownVolumes(workspace)) setAppearance(scene, asset, appearance);
    });
}

}  // namespace

void Editor::addFileActions() {
    Actions& actions = workspace_.actions;
    const auto open = [this] { return workspace_.open; };
    actions.add({"file.open", "Open…", "Ctrl+O", "PATH", "Opens a scene, or any volume as a new scene",
                 [this](const std::string& path) { files_.open(path); }});
    actions.add({"file.save", "Save", "Ctrl+S", "", "Saves the scene with the view as its camera",
                 [this](const std::string&) { files_.save(); }, open});
    actions.add({"file.save-as", "Save As…", "Ctrl+Shift+S", "PATH", "Saves the scene under another name",
                 [this](const std::string& path) { files_.saveAs(path); }, open});
    actions.add({"file.screenshot", "Screenshot…", "F12", "PATH", "Saves what the window shows as a PNG",
                 [this](const std::string& path) { files_.screenshot(path); }});
    actions.add({"file.cancel", "Cancel Opening", "", "", "Stops opening a file",
                 [this](const std::string&) { files_.cancelLoading(); }, [this] { return files_.loading(); }});
    actions.add({"file.quit", "Quit", "Ctrl+Q", "", "Leaves; asks about unsaved changes first",
                 [this](const std::string&) { files_.quit(); }});
}

void Editor::addEditActions() {
    Actions& actions = workspace_.actions;
    Document& document = workspace_.document;
    actions.add({"edit.undo", "Undo", "Ctrl+Z", "", "Takes back the last step",
                 [&, this](const std::string&) {
                     endGestures();
                     document.undo();
                 },
                 [&] { return !document.undoNames().empty(); }});
    actions.add({"edit.redo", "Redo", "Ctrl+Shift+Z", "", "Does again what was taken back",
                 [&, this](const std::string&) {
                     endGestures();
                     document.redo();
                 },
                 [&] { return !document.redoNames().empty(); }});
}

void Editor::addViewActions() {
    struct View {
        const char* id;
        const char* title;
        const char* shortcut;
        StandardView view;
    };
    static constexpr View kViews[] = {
        {"view.front", "Front", "1", StandardView::Front}, {"view.back", "Back", "Ctrl+1", StandardView::Back},
        {"view.right", "Right", "3", StandardView::Right}, {"view.left", "Left", "Ctrl+3", StandardView::Left},
        {"view.top", "Top", "7", StandardView::Top},       {"view.bottom", "Bottom", "Ctrl+7", StandardView::Bottom},
    };
    Actions& actions = workspace_.actions;
    const auto open = [this] { return workspace_.open; };
    for (const View& view : kViews)
        actions.add({view.id, view.title, view.shortcut, "", "Looks along an axis",
                     [this, which = view.view](const std::string&) {
                         workspace_.camera = standardView(workspace_.camera, which);
                     },
                     open});
    actions.add({"view.frame", "Frame All", "Home", "", "Moves the view until the whole object is seen",
                 [this](const std::string&) {
                     if (workspace_.compiled.root)
                         workspace_.camera =
                             framed(workspace_.camera, workspace_.viewSize, workspace_.compiled.root->bounds);
                 },
                 open});
    actions.add({"view.overlays",
                 "Overlays",
                 "Alt+Shift+Z",
                 "on|off",
                 "Shows lattices and other aids over the picture",
                 [this](const std::string& argument) {
                     workspace_.overlays = switchArgument("view.overlays", argument, workspace_.overlays);
                 },
                 {},
                 [this] { return workspace_.overlays; }});
    actions.add(
        {"view.scale", "Interface Size", "", "FACTOR", "Size of letters and widgets: 1, 1.5, 2 …",
         [this](const std::string& argument) { setScale(float(numberArgument("view.scale", argument, 0.5, 4))); }});
    actions.add({"help.shortcuts", "Keyboard and Mouse", "F1", "", "Lists what keys and buttons do",
                 [this](const std::string&) { showShortcuts_ = true; }});
}

void Editor::addLookActions() {
    Actions& actions = workspace_.actions;
    const auto open = [this] { return workspace_.open; };
    actions.add({"transfers.reload", "Reload Formula Files", "F5", "",
                 "Reads the scene's formula files (.stf) again; they are also watched",
                 [this](const std::string&) { refreshFormulaFiles(true); }, open});
    actions.add({"view.renderer", "Renderer", "", "slices|rays|auto",
                 "Draws by OpenGL slices, by rays on the CPU, or by the faster of both",
                 [this](const std::string& argument) { workspace_.renderer = rendererNamed(argument); }});
    actions.add({"view.frame-budget", "Frame Budget", "", "MS",
                 "What a frame may take while something moves; resolution and step follow it",
                 [this](const std::string& argument) {
                     workspace_.frameBudgetMs =
                         numberArgument("view.frame-budget", argument, kLeastFrameBudget, kMostFrameBudget);
                 }});
    actions.add({"view.step", "Step", "", "FACTOR", "Distance of samples in voxels: smaller is finer and slower",
                 [this](const std::string& argument) {
                     RenderSettings settings = workspace_.document.scene().render;
                     settings.step = numberArgument("view.step", argument, 0.01, 100);
                     workspace_.document.apply("Change step",
                                               [&](Scene& scene) { setRenderSettings(scene, settings); });
                 },
                 open});
    actions.add({"view.shading", "Shading", "", "on|off", "Lights surfaces",
                 [this](const std::string& argument) {
                     RenderSettings settings = workspace_.document.scene().render;
                     settings.shading = switchArgument("view.shading", argument, settings.shading);
                     workspace_.document.apply("Change shading",
                                               [&](Scene& scene) { setRenderSettings(scene, settings); });
                 },
                 open, [this] { return workspace_.document.scene().render.shading; }});
    actions.add({"appearance.preset", "Appearance", "", "NAME", "Gives the volumes an appearance by name (ct-bone …)",
                 [this](const std::string& argument) { applyPreset(workspace_, argument); },
                 [this] { return !shownVolumes(workspace_).empty(); }});
}

}  // namespace voledit
