// Rendering animations and pictures beside the editor: the actions, the dialogs, and how far it is.

#include <algorithm>

#include "app/editor/editor.h"
#include "app/editor/progress_box.h"
#include "core/base/error.h"

namespace voledit {

void Editor::addRenderingActions() {
    Actions& actions = workspace_.actions;
    actions.add({"file.render-still", "Render Still…", "Shift+F12", "PATH [WxH] [N] [transparent] [slices|rays]",
                 "Renders a picture of any size to a file, N² samples a pixel, while the editor goes on",
                 [this](const std::string& argument) { renderStill(argument); },
                 [this] { return workspace_.open && !still_.running(); }});
    actions.add({"file.cancel-still", "Cancel Rendering the Still", "", "", "Stops rendering the picture",
                 [this](const std::string&) { still_.cancel(); }, [this] { return still_.running(); }});
    actions.add({"file.render-animation", "Render Animation…", "Ctrl+F12", "PATH [WxH] [A-B] [slices|rays] [resume]",
                 "Renders the timeline to a video or to numbered pictures, while the editor goes on",
                 [this](const std::string& argument) { renderAnimation(argument); },
                 [this] { return workspace_.open && !animation_.running(); }});
    actions.add({"file.cancel-animation", "Cancel Rendering", "", "", "Stops rendering; finished frames stay",
                 [this](const std::string&) { animation_.cancel(); }, [this] { return animation_.running(); }});
}

void Editor::renderAnimation(const std::string& argument) {
    renderingProblem_.clear();
    if (argument.empty())
        animationDialog_.show(workspace_);
    else
        animation_.start(parseAnimationRequest(argument), workspace_);
}

void Editor::renderStill(const std::string& argument) {
    renderingProblem_.clear();
    if (argument.empty())
        stillDialog_.show(workspace_);
    else
        still_.start(parseStillRequest(argument), workspace_);
}

void Editor::waitForRendering() const {
    if (still_.running())
        still_.wait();
    else
        animation_.wait();
}

void Editor::pollRendering() {
    const auto tell = [&](const auto& ended) {
        if (!ended) return;
        for (const std::string& warning : ended->warnings) workspace_.notify(Notice::Kind::Warning, warning);
        workspace_.notify(ended->kind, ended->text);
        if (ended->kind == Notice::Kind::Problem) renderingProblem_ = ended->text;
    };
    tell(animation_.poll());
    tell(still_.poll());
}

// `above`: boxes that are there already.
bool Editor::drawRenderingBox(const char* scope, const std::string& text, double fraction, int above) {
    const Index2 size(int(300 * workspace_.scale), int(90 * workspace_.scale));
    PixelRect corner = layout_.view;
    corner.origin.x += std::max(0, corner.size.x - size.x);
    corner.origin.y += above * size.y;
    corner.size = {std::min(corner.size.x, size.x), std::min(corner.size.y, size.y)};
    return drawProgressBox(scope, text, fraction, corner, workspace_.scale);
}

void Editor::drawRendering() {
    const auto start = [&](auto& dialog, auto& job) {
        if (!dialog.visible()) return;
        const auto request = dialog.draw(workspace_);
        if (!request) return;
        renderingProblem_.clear();
        job.start(*request, workspace_);
    };
    start(animationDialog_, animation_);
    start(stillDialog_, still_);
    // How far it is depends on the machine; pictures of a headless run must not.
    if (workspace_.headless) return;
    int boxes = 0;
    if (animation_.running() &&
        drawRenderingBox("Rendering", animation_.request().out.filename().string() + ": " + animation_.progressText(),
                         animation_.fraction(), boxes++))
        animation_.cancel();
    if (still_.running() &&
        drawRenderingBox("Rendering still", still_.request().out.filename().string(), still_.fraction(), boxes))
        still_.cancel();
}

}  // namespace voledit
