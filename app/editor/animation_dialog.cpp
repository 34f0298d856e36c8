#include "app/editor/animation_dialog.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "app/animation/animation_output.h"
#include "app/editor/keys.h"
#include "app/editor/theme.h"
#include "app/editor/widgets.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

constexpr const char* kTitle = "Render animation";
constexpr int kFarthestFrame = 1000000;

// Constant rate factors of .mp4 and .webm for draft, good, best.
constexpr std::array<std::array<int, 3>, 2> kRateFactors{{{28, 18, 8}, {42, 30, 15}}};

bool keyPressed(Key key) {
    return ImGui::IsKeyPressed(int(key), false);
}

/// Why `path` cannot be rendered to; empty where it can.
std::string problemOf(const std::string& path) {
    try {
        const AnimationOutput output(path);
        std::error_code failed;
        const fs::path folder = output.path().parent_path();
        return fs::is_directory(folder, failed) ? "" : "There is no folder " + folder.string();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

bool isKind(const std::string& path, AnimationKind kind) {
    try {
        return AnimationOutput(path).kind() == kind;
    } catch (const std::invalid_argument&) {
        return false;
    }
}

}  // namespace

void AnimationDialog::show(const Workspace& workspace) {
    const fs::path& scene = workspace.document.path();
    const Timeline& timeline = workspace.document.scene().timeline;
    if (path_.empty() || fs::path(path_).parent_path() != workspace.folder)
        path_ = (workspace.folder / ((scene.empty() ? "animation" : scene.stem().string()) + ".mp4")).string();
    first_ = timeline.start;
    last_ = std::max(timeline.start, timeline.end - 1);
    fps_ = timeline.fps;
    resume_ = false;
    visible_ = opening_ = true;
}

AnimationRequest AnimationDialog::request() const {
    AnimationRequest request;
    request.out = path_;
    request.size = {width_, height_};
    request.frames = std::to_string(first_) + "-" + std::to_string(last_);
    request.fps = fps_;
    request.renderer = renderer_ == 1 ? "rays" : "";
    if (isKind(path_, AnimationKind::Mp4)) request.crf = kRateFactors[0][std::size_t(quality_)];
    if (isKind(path_, AnimationKind::Webm)) request.crf = kRateFactors[1][std::size_t(quality_)];
    request.resume = resume_;
    return request;
}

void AnimationDialog::drawPath(const Workspace& workspace) {
    ui::text("Path", path_,
             "A video (.mp4, .webm, .gif), or pictures with the place of their number: frame-%04d.png or .exr");
    if (ui::button("Browse", "Chooses the place")) {
        const fs::path now = path_;
        std::error_code failed;
        browser_.show({.mode = FileBrowser::Mode::Save,
                       .title = "Render to",
                       .button = "Choose",
                       .folder = fs::is_directory(now.parent_path(), failed) ? now.parent_path() : workspace.folder,
                       .name = now.filename().string(),
                       .kinds = FileKinds::All,
                       .ending = ".mp4"});
    }
    if (const auto chosen = browser_.draw(workspace.scale)) path_ = chosen->string();
}

void AnimationDialog::drawFields() {
    ui::integer("Width", width_, 1, 16384, "Pixels");
    ui::integer("Height", height_, 1, 16384, "Pixels");
    ui::integer("First frame", first_, -kFarthestFrame, kFarthestFrame, "The number of the first frame that is drawn");
    ui::integer("Last frame", last_, -kFarthestFrame, kFarthestFrame, "The number of the last frame that is drawn");
    ui::number("Frame rate", fps_, {.min = 0.01, .max = 1000, .speed = 0.1, .decimals = 3, .unit = " /s"},
               "Frames a second: frame n shows the scene at n / rate seconds");
    static const std::vector<std::string> renderers{"Slices", "Rays"}, qualities{"Draft", "Good", "Best"};
    ui::choice("Renderer", renderer_, renderers, "Slices: OpenGL, fast. Rays: on the processor, the reference.");
    if (isKind(path_, AnimationKind::Mp4) || isKind(path_, AnimationKind::Webm))
        ui::choice("Quality", quality_, qualities, "Of the video: better is larger");
    ui::checkbox("Resume", resume_, "Keeps the finished frames of a run that was stopped");
}

std::optional<AnimationRequest> AnimationDialog::draw(const Workspace& workspace) {
    if (std::exchange(opening_, false)) ImGui::OpenPopup(kTitle);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.5f * size.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(ImVec2(std::min(520 * workspace.scale, size.x), 0));
    constexpr auto flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
    if (!ImGui::BeginPopupModal(kTitle, nullptr, flags)) {
        visible_ = false;
        return std::nullopt;
    }
    const WidgetScope scope(kTitle);
    const bool typing = ImGui::IsAnyItemActive();
    const bool browsing = browser_.visible();
    drawPath(workspace);
    drawFields();
    std::string problem = problemOf(path_);
    if (problem.empty() && first_ > last_) problem = "The last frame is before the first";
    if (!problem.empty()) ui::warning(problem);
    ImGui::Dummy(ImVec2(0, ImGui::GetStyle().ItemSpacing.y));
    const bool keys = !ImGui::IsWindowAppearing() && !typing && !browsing;
    const bool render = ui::button("Render", "Renders in the background (Enter)", problem.empty()) ||
                        (keys && problem.empty() && keyPressed(Key::Enter));
    ImGui::SameLine();
    const bool cancel = ui::button("Cancel", "Goes back (Escape)") || (keys && keyPressed(Key::Escape));
    if (render || cancel) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return render ? std::optional(request()) : std::nullopt;
}

}  // namespace voledit
