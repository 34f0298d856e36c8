#include "app/editor/still_dialog.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/editor/keys.h"
#include "app/editor/widgets.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

constexpr const char* kTitle = "Render still";

bool keyPressed(Key key) {
    return ImGui::IsKeyPressed(int(key), false);
}

}  // namespace

void StillDialog::show(const Workspace& workspace) {
    const fs::path& scene = workspace.document.path();
    if (path_.empty() || fs::path(path_).parent_path() != workspace.folder)
        path_ = (workspace.folder / ((scene.empty() ? "picture" : scene.stem().string()) + ".png")).string();
    if (width_ == 0) {
        width_ = 2 * workspace.viewSize.x;
        height_ = 2 * workspace.viewSize.y;
        transparent_ = RenderSettings(workspace.document.scene().render).transparent;
    }
    visible_ = opening_ = true;
}

StillRequest StillDialog::request() const {
    return {.out = path_,
            .size = {width_, height_},
            .supersampling = samples_ + 1,
            .transparent = transparent_,
            .renderer = renderer_ == 1 ? "rays" : ""};
}

void StillDialog::drawPath(const Workspace& workspace) {
    ui::text("Path", path_, "A picture: .png, or .exr with linear light");
    if (ui::button("Browse", "Chooses the place")) {
        const fs::path now = path_;
        std::error_code failed;
        browser_.show({.mode = FileBrowser::Mode::Save,
                       .title = "Render to",
                       .button = "Choose",
                       .folder = fs::is_directory(now.parent_path(), failed) ? now.parent_path() : workspace.folder,
                       .name = now.filename().string(),
                       .kinds = FileKinds::All,
                       .ending = ".png"});
    }
    if (const auto chosen = browser_.draw(workspace.scale)) path_ = chosen->string();
}

void StillDialog::drawFields() {
    ui::integer("Width", width_, 1, 16384, "Pixels. The view's height fills the picture's.");
    ui::integer("Height", height_, 1, 16384, "Pixels");
    static const std::vector<std::string> samples{"1×", "2×", "3×", "4×"}, renderers{"Slices", "Rays"};
    ui::choice(
        "Supersampling", samples_, samples,
        "Draws so many times the pixels along each side and averages them: smoother edges, as many times squared "
        "as long");
    ui::checkbox("Transparent", transparent_, "Leaves the background out");
    ui::choice("Renderer", renderer_, renderers, "Slices: OpenGL, fast. Rays: on the processor, the reference.");
}

std::optional<StillRequest> StillDialog::draw(const Workspace& workspace) {
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
    const std::string problem = problemOfStill(path_);
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
