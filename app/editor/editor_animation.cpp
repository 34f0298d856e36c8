// Rendering animations beside the editor: the actions, the dialog, and how far it is.

#include <algorithm>

#include "app/editor/editor.h"
#include "app/editor/progress_box.h"
#include "core/base/error.h"

namespace voledit {

void Editor::addAnimationActions() {
    Actions& actions = workspace_.actions;
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

void Editor::pollAnimation() {
    const auto ended = animation_.poll();
    if (!ended) return;
    for (const std::string& warning : ended->warnings) workspace_.notify(Notice::Kind::Warning, warning);
    workspace_.notify(ended->kind, ended->text);
    if (ended->kind == Notice::Kind::Problem) renderingProblem_ = ended->text;
}

void Editor::drawAnimation() {
    if (animationDialog_.visible())
        if (const auto request = animationDialog_.draw(workspace_)) {
            renderingProblem_.clear();
            animation_.start(*request, workspace_);
        }
    // How far it is depends on the machine; pictures of a headless run must not.
    if (!animation_.running() || workspace_.headless) return;
    const Index2 size(int(300 * workspace_.scale), int(90 * workspace_.scale));
    PixelRect corner = layout_.view;
    corner.origin.x += std::max(0, corner.size.x - size.x);
    corner.size = {std::min(corner.size.x, size.x), std::min(corner.size.y, size.y)};
    const std::string text = animation_.request().out.filename().string() + ": " + animation_.progressText();
    if (drawProgressBox("Rendering", text, animation_.fraction(), corner, workspace_.scale)) animation_.cancel();
}

}  // namespace voledit
