#include "app/editor/scene_process.h"

#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <sstream>

#include "core/base/error.h"
#include "core/base/paths.h"
#include "core/scene/edits.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

/// What is left of the command's errors without its name; its warnings go to `warnings`.
std::string messageOf(const std::string& errors, std::vector<std::string>& warnings) {
    std::istringstream lines(errors);
    std::string message;
    const std::string name = "voledit: ", warning = "warning: ";
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with(name)) line.erase(0, name.size());
        if (line.starts_with(warning))
            warnings.push_back(line.substr(warning.size()));
        else if (!line.empty())
            message += (message.empty() ? "" : "; ") + line;
    }
    return message;
}

}  // namespace

Scene sceneToRender(const Workspace& workspace) {
    Scene scene = workspace.document.committed();
    const TrackedCamera* own = scene.camera ? &*scene.camera : nullptr;
    const bool moves =
        own && (own->eye.animated() || own->target.animated() || own->up.animated() || own->fovY.animated());
    if (!moves) setCamera(scene, workspace.camera);
    return withDefaultsWrittenOut(scene, workspace.assets);
}

SceneProcess::~SceneProcess() {
    if (!process_) return;
    process_->signal(SIGINT);
    process_->wait();
    removeCopy();
}

void SceneProcess::removeCopy() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void SceneProcess::start(const Scene& scene, const fs::path& folder,
                         const std::function<std::vector<std::string>(const fs::path&)>& arguments) {
    std::string made = (fs::temp_directory_path() / "voledit-render-XXXXXX").string();
    if (!mkdtemp(made.data()))
        throw Error(made, "cannot be made for a copy of the scene", "check the disk's space and permissions");
    folder_ = made;
    try {
        const fs::path copy = folder_ / "scene.voledit";
        saveScene(scene, copy, folder);
        std::vector<std::string> command{"nice", "-n", "10", (programFolder() / "voledit").string()};
        for (std::string& argument : arguments(copy)) command.push_back(std::move(argument));
        process_ = std::make_unique<ChildProcess>(
            ChildProcess::Settings{.command = command, .environment = {}, .keepErrors = true});
    } catch (...) {
        removeCopy();
        throw;
    }
    process_->closeInput();
    cancelled_ = false;
}

void SceneProcess::cancel() {
    if (!process_ || cancelled_) return;
    cancelled_ = true;
    process_->signal(SIGINT);
}

std::optional<SceneProcess::Ended> SceneProcess::poll() {
    if (!process_ || !process_->outputEnded()) return std::nullopt;
    Ended ended;
    ended.done = process_->wait() == 0;
    const std::string message = messageOf(process_->errors(), ended.warnings);
    if (!ended.done) ended.problem = message.empty() ? process_->causeOfDeath() : message;
    process_.reset();
    removeCopy();
    return ended;
}

void SceneProcess::wait() const {
    if (!process_ || process_->outputEnded()) return;
    pollfd output{process_->output(), POLLIN, 0};
    ::poll(&output, 1, -1);
}

}  // namespace voledit
