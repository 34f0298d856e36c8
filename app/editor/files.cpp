#include "app/editor/files.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/editor/keys.h"
#include "app/editor/motion_import.h"
#include "app/editor/progress_box.h"
#include "app/editor/theme.h"
#include "app/editor/widgets.h"
#include "core/base/error.h"
#include "core/scene/edits.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

constexpr const char* kUnsaved = "Unsaved changes";
constexpr const char* kOutside = "Files outside the folder";

double aspectOf(const Workspace& workspace) {
    return double(std::max(1, workspace.viewSize.x)) / std::max(1, workspace.viewSize.y);
}

// A PNG's name beside the scene.
std::string pictureName(const Workspace& workspace) {
    const fs::path path = workspace.document.path();
    return (path.empty() ? "voledit" : path.stem().string()) + ".png";
}

bool keyPressed(Key key) {
    return ImGui::IsKeyPressed(int(key), false);
}

}  // namespace

Files::Files(Workspace& workspace, IoClient& io, const OpenOptions& options)
    : workspace_(workspace), options_(options), loader_(io) {}

// ---- Requests -----------------------------------------------------------------------------------------------------

void Files::open(const fs::path& path) {
    afterUnsavedChanges([this, path] {
        if (path.empty())
            ask(Asking::Open);
        else
            startLoading(path);
    });
}

void Files::save() {
    if (workspace_.document.path().empty())
        ask(Asking::SaveAs);
    else
        writeScene(workspace_.document.path());
}

void Files::saveAs(const fs::path& path) {
    if (path.empty())
        ask(Asking::SaveAs);
    else
        writeScene(path);
}

void Files::screenshot(const fs::path& path) {
    if (path.empty())
        ask(Asking::Screenshot);
    else
        screenshots_.push_back(path);
}

void Files::chooseFormulaFile() {
    ask(Asking::FormulaFile);
}

void Files::chooseMotion() {
    ask(Asking::Motion);
}

void Files::quit() {
    afterUnsavedChanges([this] { quit_ = true; });
}

std::vector<fs::path> Files::takeScreenshots() {
    return std::exchange(screenshots_, {});
}

void Files::afterUnsavedChanges(std::function<void()> next) {
    if (!workspace_.open || !workspace_.document.modified()) return next();
    next_ = std::move(next);
    askUnsaved_ = true;
}

void Files::ask(Asking what) {
    asking_ = what;
    FileBrowser::Request request;
    const fs::path& scene = workspace_.document.path();
    request.folder = !lastFolder_.empty() ? lastFolder_
                     : !scene.empty()     ? fs::absolute(scene).parent_path()
                                          : workspace_.folder;
    if (what == Asking::Open) {
        request.title = "Open";
        request.button = "Open";
    } else if (what == Asking::FormulaFile) {
        request.title = "Formula file";
        request.button = "Add";
        request.kinds = FileKinds::Formulas;
    } else if (what == Asking::Motion) {
        request.title = "Import motion";
        request.button = "Import";
        request.kinds = FileKinds::Motions;
    } else {
        request.mode = FileBrowser::Mode::Save;
        request.title = what == Asking::SaveAs ? "Save as" : "Screenshot";
        request.button = "Save";
        request.ending = what == Asking::SaveAs ? ".voledit" : ".png";
        const auto& assets = workspace_.document.scene().assets;
        request.name = what == Asking::Screenshot ? pictureName(workspace_)
                       : !scene.empty()           ? scene.filename().string()
                       : assets.empty()           ? "scene.voledit"
                                                  : assets.begin()->first + ".voledit";
    }
    browser_.show(std::move(request));
}

void Files::chosen(const fs::path& path) {
    lastFolder_ = browser_.folder();
    switch (std::exchange(asking_, Asking::Nothing)) {
        case Asking::Open:
            return startLoading(path);
        case Asking::SaveAs:
            writeScene(path);
            if (next_) std::exchange(next_, nullptr)();
            return;
        case Asking::Screenshot:
            screenshots_.push_back(path);
            return;
        case Asking::FormulaFile:
            return workspace_.actions.run("transfer.add-file", path.string());
        case Asking::Motion:
            return workspace_.actions.run("actor.import-motion", path.string());
        case Asking::Nothing:
            return;
    }
}

// ---- Loading ------------------------------------------------------------------------------------------------------

void Files::startLoading(const fs::path& path, bool allowOutside) {
    loadingSince_ = workspace_.clock;
    loadProblem_.clear();
    OpenOptions options = options_;
    options.scene.allowOutside |= allowOutside;
    loader_.start(path, options);
}

bool Files::poll() {
    auto result = loader_.take();
    if (!result) return false;
    try {
        takeOver(std::move(*result));
    } catch (const Error& error) {
        loadProblem_ = error.what();
    }
    if (!loadProblem_.empty() && !askOutside_) workspace_.notify(Notice::Kind::Problem, loadProblem_);
    return true;
}

void Files::takeOver(Loader::Result result) {
    if (result.cancelled) {
        workspace_.notify(Notice::Kind::Info, "Opening " + result.path.filename().string() + " was cancelled.");
        return;
    }
    if (!result.opened) {
        loadProblem_ = result.problem;
        askOutside_ = result.outside;
        if (askOutside_) outsideScene_ = result.path;
        return;
    }
    OpenedScene& opened = *result.opened;
    const double time = opened.scene.timeline.start / opened.scene.timeline.fps;
    // Compiled before anything is replaced: a scene that does not compile leaves the work as it was.
    CompiledScene compiled = compile(opened.scene, opened.assets, time, nullptr, aspectOf(workspace_));
    workspace_.open = true;
    workspace_.document = Document(std::move(opened.scene), opened.path);
    workspace_.assets = std::move(opened.assets);
    workspace_.formulaFiles = FormulaFiles(workspace_.formulaFiles.recent());
    workspace_.tree = {};
    workspace_.pending = {};
    workspace_.problem.clear();
    workspace_.folder = opened.folder;
    workspace_.selection = {};
    workspace_.actors = {};
    workspace_.camera = compiled.camera;
    workspace_.time = time;
    workspace_.timeline = withoutScene(workspace_.timeline);
    workspace_.compiled = std::move(compiled);
    for (const std::string& warning : opened.warnings) workspace_.notify(Notice::Kind::Warning, warning);
}

// ---- Saving -------------------------------------------------------------------------------------------------------

void Files::writeScene(const fs::path& path) {
    if (!isSceneFile(path)) throw Error(path.string(), "a scene is not saved under this ending", "name it *.voledit");
    Scene scene = workspace_.document.committed();
    setCamera(scene, workspace_.camera);
    saveScene(withDefaultsWrittenOut(scene, workspace_.assets), path, workspace_.folder);
    workspace_.document.markSaved(path);
    workspace_.notify(Notice::Kind::Info, "Saved " + path.string());
    warnOfOutsideFiles(path);
}

void Files::warnOfOutsideFiles(const fs::path& path) {
    const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
    for (const auto& [name, asset] : workspace_.document.committed().assets) {
        const fs::path file = fs::absolute(assetPath(asset, workspace_.folder)).lexically_normal();
        const fs::path relative = file.lexically_relative(folder);
        if (!relative.empty() && *relative.begin() != "..") continue;
        workspace_.notify(Notice::Kind::Warning, file.string() +
                                                     " lies outside the scene's folder: opening the scene will "
                                                     "ask first, and the command line needs --allow-outside");
    }
}

// ---- Dialogs ------------------------------------------------------------------------------------------------------

void Files::draw(const PixelRect& area) {
    drawUnsavedChanges();
    drawOutsideFiles();
    if (const auto path = browser_.draw(workspace_.scale))
        chosen(*path);
    else if (!browser_.visible() && asking_ != Asking::Nothing) {
        asking_ = Asking::Nothing;  // closed without an answer
        next_ = nullptr;
    }
    drawProgress(area);
}

void Files::drawUnsavedChanges() {
    if (std::exchange(askUnsaved_, false)) ImGui::OpenPopup(kUnsaved);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    if (!ImGui::BeginPopupModal(
            kUnsaved, nullptr,
            ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings))
        return;
    const WidgetScope scope(kUnsaved);
    const fs::path& path = workspace_.document.path();
    ImGui::Text("%s has changes that are not saved.", path.empty() ? "The scene" : path.filename().string().c_str());
    ImGui::Dummy(ImVec2(0, ImGui::GetStyle().ItemSpacing.y));
    const bool appearing = ImGui::IsWindowAppearing();
    const bool saveFirst = ui::button("Save", "Saves, then goes on (Enter)") || (!appearing && keyPressed(Key::Enter));
    ImGui::SameLine();
    const bool discard = ui::button("Discard", "Goes on without saving");
    ImGui::SameLine();
    const bool cancel = ui::button("Cancel", "Goes back (Escape)") || (!appearing && keyPressed(Key::Escape));
    if (saveFirst || discard || cancel) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (cancel) next_ = nullptr;
    if (discard && next_) std::exchange(next_, nullptr)();
    if (!saveFirst) return;
    // Where it fails, nothing goes on: the changes would be lost.
    auto next = std::exchange(next_, nullptr);
    save();
    if (asking_ == Asking::SaveAs)
        next_ = std::move(next);
    else if (next)
        next();
}

// A stranger's scene should not reach the user's other files unasked (scene-format.md §1).
void Files::drawOutsideFiles() {
    if (std::exchange(askOutside_, false)) ImGui::OpenPopup(kOutside);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(ImVec2(std::min(520 * workspace_.scale, size.x), 0));
    if (!ImGui::BeginPopupModal(kOutside, nullptr,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings))
        return;
    const WidgetScope scope(kOutside);
    ImGui::TextWrapped("%s names files outside its folder. Open it if you trust where it comes from.",
                       outsideScene_.filename().string().c_str());
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim));
    ImGui::TextWrapped("%s", loadProblem_.c_str());
    ImGui::PopStyleColor();
    ImGui::Dummy(ImVec2(0, ImGui::GetStyle().ItemSpacing.y));
    const bool appearing = ImGui::IsWindowAppearing();
    const bool trust = ui::button("Open anyway", "Opens it with the files outside its folder (Enter)") ||
                       (!appearing && keyPressed(Key::Enter));
    ImGui::SameLine();
    const bool cancel = ui::button("Cancel", "Leaves it closed (Escape)") || (!appearing && keyPressed(Key::Escape));
    if (trust || cancel) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (trust) startLoading(outsideScene_, true);
}

void Files::drawProgress(const PixelRect& area) {
    // Files that open at once need no box that flashes up.
    if (!loading() || (!workspace_.headless && workspace_.clock - loadingSince_ < 0.25)) return;
    if (drawProgressBox("Loading", "Opening " + loader_.path().filename().string(), loader_.fraction(), area,
                        workspace_.scale))
        cancelLoading();
}

}  // namespace voledit
