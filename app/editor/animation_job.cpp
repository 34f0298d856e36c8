#include "app/editor/animation_job.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "app/animation/animation_output.h"
#include "app/editor/request_words.h"
#include "core/base/error.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

std::string numberText(double number) {
    std::array<char, 32> text{};
    std::to_chars(text.data(), text.data() + text.size(), number);
    return text.data();
}

void checkOutput(const fs::path& out) {
    try {
        const AnimationOutput checked(out);
    } catch (const std::invalid_argument& error) {
        throw Error(error.what());
    }
}

std::vector<std::string> argumentsFor(const AnimationRequest& request, const fs::path& scene) {
    std::vector<std::string> command{"animate",
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
    request.size = takeLastSize(text, request.size, "file.render-animation");
    request.out = text;
    checkOutput(request.out);
    return request;
}

void AnimationJob::start(const AnimationRequest& request, const Workspace& workspace) {
    if (running()) throw Error("an animation is being rendered already; wait for it, or cancel it");
    checkOutput(request.out);
    request_ = request;
    request_.out = fs::absolute(request.out);
    process_.start(sceneToRender(workspace), workspace.folder,
                   [&](const fs::path& scene) { return argumentsFor(request_, scene); });
    done_ = total_ = 0;
    secondsLeft_ = -1;
    encoding_ = false;
}

double AnimationJob::fraction() const {
    if (encoding_) return 1;
    return total_ > 0 ? double(done_) / total_ : 0;
}

std::string AnimationJob::progressText() const {
    if (process_.cancelled()) return "stopping";
    if (encoding_) return "encoding the video";
    if (total_ == 0) return "starting";
    std::string text = std::to_string(done_) + " of " + std::to_string(total_) + " frames";
    if (secondsLeft_ >= 90)
        text += ", about " + std::to_string(std::lround(secondsLeft_ / 60)) + " min left";
    else if (secondsLeft_ >= 1)
        text += ", about " + std::to_string(std::lround(secondsLeft_)) + " s left";
    return text;
}

std::optional<AnimationJob::Ended> AnimationJob::poll() {
    while (const auto line = process_.readLine()) {
        std::istringstream words(*line);
        std::string word;
        words >> word;
        if (word == "frame") words >> done_ >> total_ >> secondsLeft_;
        if (word == "encoding") encoding_ = true;
    }
    const auto end = process_.poll();
    if (!end) return std::nullopt;
    const std::string name = request_.out.filename().string();
    Ended ended{.kind = Notice::Kind::Info, .text = "Rendered " + request_.out.string(), .warnings = end->warnings};
    if (!end->done && process_.cancelled())
        ended.text = "Rendering " + name + " was stopped" +
                     (done_ > 0 ? "; its " + std::to_string(done_) + " finished frames are kept for Resume." : ".");
    else if (!end->done)
        ended = {Notice::Kind::Problem, "Rendering " + name + ": " + end->problem, end->warnings};
    return ended;
}

}  // namespace voledit
