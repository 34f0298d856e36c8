// What the editor does for actors once a frame, and files that hold motions.

#include <imgui.h>

#include <algorithm>

#include "app/editor/actor_actions.h"
#include "app/editor/editor.h"
#include "app/editor/motion_import.h"
#include "app/editor/progress_box.h"
#include "app/editor/tools/actor_view.h"
#include "core/base/error.h"

namespace voledit {

void Editor::importMotion(const std::string& path) {
    if (path.empty()) return files_.chooseMotion();
    // Without an actor nothing need be read.
    actorForMotion(workspace_);
    job_.start("Reading " + std::filesystem::path(path).filename().string(),
               [this, file = std::filesystem::path(path)](Progress& progress) -> Background::Finish {
                   return [this, read = readMotionFile(io_, file, &progress)] { takeMotion(workspace_, read); };
               });
}

void Editor::finishJobs() {
    // Headless nothing depends on how long work takes.
    if (workspace_.headless) job_.wait();
    if (job_.running() && jobSince_ < 0) jobSince_ = workspace_.clock;
    const std::string title = job_.title();
    const auto noteEnd = [&] {
        jobSince_ = -1;
        if (recorder_) recorder_->loaded();
    };
    try {
        const Background::Ended ended = job_.poll();
        if (ended == Background::Ended::No) return;
        noteEnd();
        if (ended == Background::Ended::Cancelled) workspace_.notify(Notice::Kind::Info, title + " was cancelled.");
    } catch (const std::exception& error) {
        noteEnd();
        workspace_.notify(Notice::Kind::Problem, title + ": " + error.what());
    }
}

void Editor::drawJob(const PixelRect& area) {
    // What is done at once needs no box that flashes up.
    if (!job_.running() || jobSince_ < 0 || workspace_.clock - jobSince_ < 0.25) return;
    if (drawProgressBox("Working", job_.title(), job_.fraction(), area, workspace_.scale)) job_.cancel();
}

void Editor::updateActors() {
    ActorState& state = workspace_.actors;
    // The mode is the actor's: it ends where another node is selected.
    if (state.rigEdit && !actorAtRest()) state.rigEdit = false;
    analysis_.update(workspace_, workspace_.headless);
}

std::shared_ptr<const CompiledActor> Editor::actorAtRest() const {
    if (!workspace_.open || !workspace_.compiled.root || !workspace_.actors.rigEdit) return nullptr;
    return activeActor(workspace_.document.scene(), &workspace_.compiled, workspace_.selection);
}

void Editor::drawHoveredJoint() {
    const std::string name = workspace_.overlays ? tools_.joints().hoveredName() : "";
    if (name.empty() || !hovered_ || tools_.capturing()) return;
    drawBesideMouse(name);
}

}  // namespace voledit
