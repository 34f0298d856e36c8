#include "app/editor/animation_job.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "app/animation/animation_output.h"
#include "core/base/error.h"
#include "core/base/paths.h"
#include "core/scene/edits.h"
#include "core/scene/scene_json.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

std::string numberText(double number) {
    std::array<char, 32> text{};
    std::to_chars(text.data(), text.data() + text.size(), number);
    return text.data();
}

/// Takes the last word of `text` off where it is one of `pattern`.
std::string takeLastWord(std::string& text, const char* pattern) {
    const std::regex last(std::string("^(.*\\S)\\s+(") + pattern + ")$");
    std::smatch found;
    if (!std::regex_match(text, found, last)) return {};
    const std::string word = found[2];
    text = std::string(found[1]);
    return word;
}

void checkOutput(const fs::path& out) {
    try {
        const AnimationOutput checked(out);
    } catch (const std::invalid_argument& error) {
        throw Error(error.what());
    }
}

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

std::vector<std::string> commandFor(const AnimationRequest& request, const fs::path& scene) {
    std::vector<std::string> command{"nice",
                                     "-n",
                                     "10",
                                     (programFolder() / "voledit").string(),
                                     "animate",
                                     "--report",
                                     "--quiet",
                                     "--allow-outside",
                                     "--output=" + request.out.string(),
                                     "--size=" + std::to_string(request.size.x) + "x" + std::to_string(request.size.y)};
    const auto add = [&](const char* flag, const std::string& value) {
        if (!value.empty()) command.push_back(std::string(flag) + "=" + value);
    };
    add("--frames", request.frames);
    add("--renderer", request.renderer);
    if (request.fps > 0) add("--fps", numberText(request.fps));
    if (request.crf >= 0) add("--crf", std::to_string(request.crf));
    if (request.resume) command.push_back("--resume");
    command.push_back(scene.string());
    return command;
}

}  // namespace

AnimationRequest parseAnimationRequest(const std::string& argument) {
    AnimationRequest request;
    std::string text = argument;
    request.resume = !takeLastWord(text, "resume").empty();
    request.renderer = takeLastWord(text, "slices|rays");
    request.frames = takeLastWord(text, "-?[0-9]{1,9}--?[0-9]{1,9}");
    if (const std::string size = takeLastWord(text, "[0-9]{1,5}x[0-9]{1,5}"); !size.empty()) {
        const auto cross = size.find('x');
        request.size = {std::atoi(size.c_str()), std::atoi(size.c_str() + cross + 1)};
    }
    if (request.size.x < 1 || request.size.y < 1 || request.size.x > 16384 || request.size.y > 16384)
        throw Error("file.render-animation: a size has two numbers from 1 to 16384 joined by x");
    request.out = text;
    checkOutput(request.out);
    return request;
}

Scene sceneToRender(const Workspace& workspace) {
    Scene scene = workspace.document.committed();
    const TrackedCamera* own = scene.camera ? &*scene.camera : nullptr;
    const bool moves =
        own && (own->eye.animated() || own->target.animated() || own->up.animated() || own->fovY.animated());
    if (!moves) setCamera(scene, workspace.camera);
    return withDefaultsWrittenOut(scene, workspace.assets);
}

AnimationJob::~AnimationJob() {
    if (!process_) return;
    process_->signal(SIGINT);
    process_->wait();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void AnimationJob::start(const AnimationRequest& request, const Workspace& workspace) {
    if (running()) throw Error("an animation is being rendered already; wait for it, or cancel it");
    checkOutput(request.out);
    std::string folder = (fs::temp_directory_path() / "voledit-render-XXXXXX").string();
    if (!mkdtemp(folder.data()))
        throw Error(folder, "cannot be made for a copy of the scene", "check the disk's space and permissions");
    folder_ = folder;
    try {
        const fs::path scene = folder_ / "scene.voledit";
        saveScene(sceneToRender(workspace), scene, workspace.folder);
        request_ = request;
        request_.out = fs::absolute(request.out);
        process_ = std::make_unique<ChildProcess>(
            ChildProcess::Settings{.command = commandFor(request_, scene), .environment = {}, .keepErrors = true});
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
        throw;
    }
    process_->closeInput();
    done_ = total_ = 0;
    secondsLeft_ = -1;
    encoding_ = cancelled_ = false;
}

double AnimationJob::fraction() const {
    if (encoding_) return 1;
    return total_ > 0 ? double(done_) / total_ : 0;
}

std::string AnimationJob::progressText() const {
    if (cancelled_) return "stopping";
    if (encoding_) return "encoding the video";
    if (total_ == 0) return "starting";
    std::string text = std::to_string(done_) + " of " + std::to_string(total_) + " frames";
    if (secondsLeft_ >= 90)
        text += ", about " + std::to_string(std::lround(secondsLeft_ / 60)) + " min left";
    else if (secondsLeft_ >= 1)
        text += ", about " + std::to_string(std::lround(secondsLeft_)) + " s left";
    return text;
}

void AnimationJob::cancel() {
    if (!process_ || cancelled_) return;
    cancelled_ = true;
    process_->signal(SIGINT);
}

std::optional<AnimationJob::Ended> AnimationJob::poll() {
    if (!process_) return std::nullopt;
    while (const auto line = process_->readLine()) {
        std::istringstream words(*line);
        std::string word;
        words >> word;
        if (word == "frame") words >> done_ >> total_ >> secondsLeft_;
        if (word == "encoding") encoding_ = true;
    }
    if (!process_->outputEnded()) return std::nullopt;
    return ended();
}

AnimationJob::Ended AnimationJob::ended() {
    const int status = process_->wait();
    Ended ended;
    const std::string message = messageOf(process_->errors(), ended.warnings), name = request_.out.filename().string();
    const std::string died = message.empty() ? process_->causeOfDeath() : message;
    process_.reset();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    if (status == 0)
        ended.text = "Rendered " + request_.out.string();
    else if (cancelled_)
        ended.text = "Rendering " + name + " was stopped" +
                     (done_ > 0 ? "; its " + std::to_string(done_) + " finished frames are kept for Resume." : ".");
    else
        ended = {Notice::Kind::Problem, "Rendering " + name + ": " + died, ended.warnings};
    return ended;
}

void AnimationJob::wait() const {
    if (!process_ || process_->outputEnded()) return;
    pollfd output{process_->output(), POLLIN, 0};
    ::poll(&output, 1, -1);
}

}  // namespace voledit
