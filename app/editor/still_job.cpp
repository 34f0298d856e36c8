#include "app/editor/still_job.h"

#include <array>
#include <charconv>
#include <sstream>

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

std::vector<std::string> argumentsFor(const StillRequest& request, double time, const fs::path& scene) {
    std::vector<std::string> command{"render",
                                     "--report",
                                     "--quiet",
                                     "--allow-outside",
                                     "--output=" + request.out.string(),
                                     "--time=" + numberText(time),
                                     "--size=" + std::to_string(request.size.x) + "x" + std::to_string(request.size.y)};
    if (request.supersampling > 1) command.push_back("--supersample=" + std::to_string(request.supersampling));
    if (!request.renderer.empty()) command.push_back("--renderer=" + request.renderer);
    command.push_back(scene.string());
    return command;
}

}  // namespace

std::string problemOfStill(const fs::path& path) {
    const std::string ending = path.extension().string();
    if (ending != ".png" && ending != ".exr") return "Name a .png or .exr file";
    std::error_code failed;
    const fs::path folder = fs::absolute(path, failed).parent_path();
    return fs::is_directory(folder, failed) ? "" : "There is no folder " + folder.string();
}

StillRequest parseStillRequest(const std::string& argument) {
    StillRequest request;
    std::string text = argument;
    request.renderer = takeLastWord(text, "slices|rays");
    request.transparent = !takeLastWord(text, "transparent").empty();
    if (const std::string samples = takeLastWord(text, "[1-4]"); !samples.empty())
        request.supersampling = samples[0] - '0';
    request.size = takeLastSize(text, request.size, "file.render-still");
    request.out = text;
    if (const std::string problem = problemOfStill(request.out); !problem.empty())
        throw Error("file.render-still", text, problem);
    return request;
}

void StillJob::start(const StillRequest& request, const Workspace& workspace) {
    if (running()) throw Error("a picture is being rendered already; wait for it, or cancel it");
    request_ = request;
    request_.out = fs::absolute(request.out);
    Scene scene = sceneToRender(workspace);
    scene.render.transparent = request.transparent;
    process_.start(scene, workspace.folder,
                   [&](const fs::path& copy) { return argumentsFor(request_, workspace.time, copy); });
    fraction_ = 0;
}

std::optional<StillJob::Ended> StillJob::poll() {
    while (const auto line = process_.readLine()) {
        std::istringstream words(*line);
        std::string word;
        words >> word;
        if (word == "progress") words >> fraction_;
    }
    const auto end = process_.poll();
    if (!end) return std::nullopt;
    const std::string name = request_.out.filename().string();
    Ended ended{.kind = Notice::Kind::Info, .text = "Saved " + request_.out.string(), .warnings = end->warnings};
    if (!end->done && process_.cancelled())
        ended.text = "Rendering " + name + " was stopped.";
    else if (!end->done)
        ended = {Notice::Kind::Problem, "Rendering " + name + ": " + end->problem, end->warnings};
    return ended;
}

}  // namespace voledit
