#include "app/editor/session.h"

#include <fstream>
#include <utility>

#include "app/editor/state_json.h"
#include "core/base/error.h"
#include "core/base/paths.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

// ImGui lays out a new popup or panel within this many frames.
constexpr int kLayoutFrames = 3;

RendererChoice rendererOf(const EditorOptions& options) {
    if (options.renderer == "rays") return RendererChoice::Rays;
    if (options.renderer == "auto") return RendererChoice::Auto;
    return options.renderer.empty() && !options.headless ? RendererChoice::Auto : RendererChoice::Slices;
}

}  // namespace

Session::Session(const EditorOptions& options) : headless_(options.headless) {
    platform_ = headless_ ? makeOffscreen(options) : makeWindow(options);
    EditorSettings settings;
    settings.scale = options.scale > 0 ? float(options.scale) : platform_->displayScale();
    settings.headless = headless_;
    settings.renderer = rendererOf(options);
    settings.open.scene.allowOutside = options.allowOutside;
    editor_ = std::make_unique<Editor>(settings, io_);
    if (options.frameBudgetMs > 0) editor_->workspace().frameBudgetMs = options.frameBudgetMs;
    drawFrame(platform_->nextFrame(true));  // lays out the viewport that the first picture is fitted to
    openFirst(options.file);
    if (options.record.empty()) return;
    recorder_ = std::make_unique<Recorder>(options.record, RecordedWindow{platform_->size(), settings.scale});
    editor_->setRecorder(recorder_.get());
}

Session::~Session() {
    editor_->setRecorder(nullptr);
}

void Session::openFirst(const fs::path& file) {
    const fs::path welcome = resourceFolder() / "scenes" / "welcome.voledit";
    std::error_code ignored;
    if (file.empty() && !fs::exists(welcome, ignored)) return;
    editor_->files().open(file.empty() ? welcome : file);
    if (!headless_) return;
    finishLoading();
    if (!editor_->files().loadProblem().empty()) throw Error(editor_->files().loadProblem());
}

void Session::drawFrame(FrameInput input) {
    editor_->frame(input);
    platform_->show(*editor_);
    serveScreenshots();
    if (!headless_) return;
    loadingFrames_ = editor_->files().loading() ? loadingFrames_ + 1 : 0;
    if (loadingFrames_ >= 2) finishLoading();
}

void Session::finishLoading() {
    while (editor_->files().loading() || editor_->working()) {
        editor_->files().waitForLoading();
        editor_->waitForWork();
        loadingFrames_ = 0;
        drawFrame(platform_->nextFrame(true));
    }
}

void Session::runWindow() {
    while (!editor_->finished()) {
        // What plays is not refined: between its frames the window sleeps.
        const bool refining = platform_->refining() && !editor_->playedFrame();
        const bool busy = refining || editor_->files().loading() || editor_->working() || editor_->inputWaits();
        drawFrame(platform_->nextFrame(busy, editor_->untilNextFrame()));
    }
}

// ---- Driven by events ---------------------------------------------------------------------------------------------

void Session::frame(const std::vector<InputEvent>& events) {
    FrameInput input = platform_->nextFrame(true);
    // In a window too a replayed frame is 1/60 s, and the user's own mouse does not disturb it.
    input.seconds = 1.0 / 60;
    input.events = events;
    drawFrame(std::move(input));
}

Vec2 Session::locate(const Place& place) {
    if (place.kind != Place::Kind::Pixel) finishLoading();
    for (int n = 0;; ++n) {
        try {
            return editor_->locate(place);
        } catch (const Error&) {
            const bool hidden = place.kind == Place::Kind::Widget || place.kind == Place::Kind::Key;
            if (!hidden || n >= kLayoutFrames) throw;
            editor_->reveal(place);
            frame({});
        }
    }
}

void Session::act(const std::string& action, const std::string& argument) {
    if (action != "file.cancel") finishLoading();
    editor_->act(action, argument);
}

void Session::finishRendering() {
    while (editor_->rendering() && !closed()) {
        editor_->waitForRendering();
        drawFrame(platform_->nextFrame(true));
    }
    if (!editor_->renderingProblem().empty()) throw Error(editor_->renderingProblem());
}

void Session::waitIdle() {
    finishLoading();
    finishRendering();
    // What plays never rests.
    do frame({});
    while ((platform_->refining() || editor_->working()) && !editor_->playedFrame() && !closed());
}

void Session::saveScreenshot(const std::string& path) {
    finishLoading();
    io_.writePicture(platform_->screenshot(*editor_), path);
}

void Session::serveScreenshots() {
    for (const fs::path& path : editor_->files().takeScreenshots()) try {
            io_.writePicture(platform_->screenshot(*editor_), path);
            editor_->workspace().notify(Notice::Kind::Info, "Saved " + path.string());
        } catch (const Error& error) {
            editor_->workspace().notify(Notice::Kind::Problem, error.what());
        }
}

void Session::saveState(const std::string& path) {
    finishLoading();
    std::ofstream file(path, std::ios::binary);
    file << stateJson(*editor_);
    file.close();
    if (!file) throw Error(path, "the state cannot be written there", "name a file in a folder that exists");
}

}  // namespace voledit
