// What the editor draws around the picture: menus, panels, status bar.

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/editor/actor_actions.h"
#include "app/editor/add_menu.h"
#include "app/editor/editor.h"
#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/tools/tool_actions.h"
#include "app/editor/widgets.h"
#include "core/base/error.h"
#include "core/scene/appearance.h"

namespace voledit {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void place(const PixelRect& rect) {
    ImGui::SetNextWindowPos(ImVec2(float(rect.origin.x), float(rect.origin.y)));
    ImGui::SetNextWindowSize(ImVec2(float(rect.size.x), float(rect.size.y)));
}

// A menu of actions; "-" is a line.
template <class... More>
void menu(const Actions& actions, const char* title, std::initializer_list<const char*> ids, More... more) {
    const bool isOpen = ImGui::BeginMenu(title);
    {
        const WidgetScope scope("Menu");
        noteWidget(title);
    }
    if (!isOpen) return;
    const WidgetScope scope(title);
    for (const char* id : ids) {
        if (std::string_view(id) == "-")
            ImGui::Separator();
        else
            ui::actionMenuItem(actions, id);
    }
    (more(), ...);
    ImGui::EndMenu();
}

// Entries that run an action with an argument.
void choiceMenu(const Actions& actions, const char* title, const char* id,
                std::span<const std::pair<std::string, std::string>> choices, const std::string& now) {
    const Action* action = actions.find(id);
    const bool isOpen = ImGui::BeginMenu(title, action && action->isEnabled());
    noteWidget(title);
    if (!isOpen) return;
    const WidgetScope scope(title);
    for (const auto& [argument, label] : choices) {
        if (ImGui::MenuItem(label.c_str(), nullptr, argument == now)) actions.run(id, argument);
        noteWidget(label);
    }
    ImGui::EndMenu();
}

std::string rendererWord(RendererChoice choice) {
    return choice == RendererChoice::Slices ? "slices" : choice == RendererChoice::Rays ? "rays" : "auto";
}

// "24.0 fps  ·  3 dropped" while the timeline plays.
std::string playedText(const Workspace& workspace) {
    const Playback& playback = workspace.timeline.playback;
    if (!playback.playing()) return {};
    const auto rate = playback.shownRate();
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%.1f fps", rate.value_or(workspace.document.scene().timeline.fps));
    const std::int64_t dropped = playback.dropped();
    return text.data() + (dropped > 0 ? "  ·  " + std::to_string(dropped) + " dropped" : std::string());
}

// "rays  ·  18 ms  ·  640 × 480 of 960 × 720", "rays  ·  refining 40 %".
std::string pictureText(const std::string& renderer, const FrameTimes& times, const PictureStatus& picture) {
    std::array<char, 128> text;
    if (picture.progress > 0 && picture.progress < 1)
        std::snprintf(text.data(), text.size(), "%s  ·  refining %.0f %%", renderer.c_str(), 100 * picture.progress);
    else if (picture.size == picture.of)
        std::snprintf(text.data(), text.size(), "%s  ·  %.0f ms", renderer.c_str(), times.frameMs);
    else
        std::snprintf(text.data(), text.size(), "%s  ·  %.0f ms  ·  %d × %d of %d × %d", renderer.c_str(),
                      times.frameMs, picture.size.x, picture.size.y, picture.of.x, picture.of.y);
    return text.data();
}

void dimText(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kTextDim));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

}  // namespace

void Editor::drawInterface() {
    // An action run from a menu or a panel's edit may fail; the frame goes on.
    const auto guarded = [&](auto&& draw) {
        try {
            draw();
        } catch (const Error& error) {
            ImGui::ErrorCheckEndFrameRecover(nullptr);
            workspace_.notify(Notice::Kind::Problem, error.what());
        }
    };
    guarded([&] { drawViewport(); });
    guarded([&] { drawMenus(); });
    guarded([&] { drawPanels(); });
    if (workspace_.timeline.shown) guarded([&] { timeline_.draw(workspace_, layout_.time); });
    guarded([&] { drawAddPopup(workspace_); });
    guarded([&] { drawStatus(); });
    // Without overlays nothing may stand over the picture.
    const PixelRect& aside = workspace_.overlays || !workspace_.open ? layout_.view : layout_.panels;
    guarded([&] { noticeList_.draw(workspace_, aside); });
    guarded([&] { drawShortcuts(); });
    guarded([&] { files_.draw(aside); });
    guarded([&] { drawJob(aside); });
    guarded([&] { drawRendering(); });
}

void Editor::drawViewport() {
    place(layout_.view);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::Begin("##view", nullptr, kFixed | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar(2);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const PixelRect& view = layout_.view;
    const ImVec2 min(float(view.origin.x), float(view.origin.y));
    const ImVec2 max(min.x + float(view.size.x), min.y + float(view.size.y));
    if (!workspace_.open) {
        list.AddRectFilled(min, max, packed(theme::kField));
        const std::string text = files_.loading() ? "" : "Open a volume or a scene: Ctrl+O, or drop a file here";
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        list.AddText(ImVec2(std::round(0.5f * (min.x + max.x - size.x)), std::round(0.5f * (min.y + max.y - size.y))),
                     packed(theme::kTextDim), text.c_str());
    } else {
        // GL's first row is the lowest.
        list.AddImage(reinterpret_cast<ImTextureID>(std::uintptr_t(kViewTexture)), min, max, ImVec2(0, 1),
                      ImVec2(1, 0));
        if (const auto box = tools_.lattice().box(); box && workspace_.overlays) {
            const ImVec2 a(min.x + float(box->first.x), min.y + float(box->first.y));
            const ImVec2 b(min.x + float(box->second.x), min.y + float(box->second.y));
            const ImVec2 low(std::min(a.x, b.x), std::min(a.y, b.y)), high(std::max(a.x, b.x), std::max(a.y, b.y));
            list.AddRectFilled(low, high, packed(theme::kAccent, 0.12f));
            list.AddRect(low, high, packed(theme::kAccent, 0.9f), 0, 0, std::max(1.0f, workspace_.scale));
        }
        if (workspace_.overlays) drawBesideMouse(tools_.readout());
        drawHoveredJoint();
    }
    ImGui::End();
}

// A few words that go with the mouse within the viewport.
void Editor::drawBesideMouse(const std::string& text) {
    if (text.empty()) return;
    const PixelRect& view = layout_.view;
    const ImVec2 min(float(view.origin.x), float(view.origin.y));
    const ImVec2 max(min.x + float(view.size.x), min.y + float(view.size.y));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()), mouse = ImGui::GetIO().MousePos;
    const float pad = 5 * workspace_.scale, gap = 18 * workspace_.scale;
    const float x = std::clamp(mouse.x + gap, min.x + pad, std::max(min.x + pad, max.x - size.x - pad));
    const float y = std::clamp(mouse.y + gap, min.y + pad, std::max(min.y + pad, max.y - size.y - pad));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(ImVec2(x - pad, y - pad), ImVec2(x + size.x + pad, y + size.y + pad),
                       packed(withAlpha(theme::kHeader, 0.9f)), 4 * workspace_.scale);
    list.AddText(ImVec2(x, y), packed(theme::kText), text.c_str());
}

void Editor::drawMenus() {
    place(layout_.menu);
    const float height = float(layout_.menu.size.y);
    const float padding = std::max(0.0f, std::floor(0.5f * (height - ImGui::GetFontSize())));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ImGui::GetStyle().FramePadding.x, padding));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin("##menu", nullptr, kFixed | ImGuiWindowFlags_MenuBar);
    ImGui::PopStyleVar(3);
    if (ImGui::BeginMenuBar()) {
        ImGui::BeginDisabled(files_.loading());
        const Actions& actions = workspace_.actions;
        menu(actions, "File",
             {"file.open", "-", "file.save", "file.save-as", "-", "file.screenshot", "file.render-still",
              "file.render-animation", "-", "file.quit"});
        menu(actions, "Edit",
             {"edit.undo", "edit.redo", "-", "node.rename", "node.enable", "node.move-up", "node.move-down",
              "node.delete", "-", "select.all", "select.none", "select.invert", "select.box"});
        menu(actions, "View",
             {"view.frame", "-", "view.front", "view.back", "view.right", "view.left", "view.top", "view.bottom", "-",
              "view.overlays", "view.regions", "view.coverage", "view.shading", "view.timeline"},
             [&] {
                 static const std::array<std::pair<std::string, std::string>, 3> kRenderers{
                     {{"auto", "Automatic"}, {"slices", "Slices (OpenGL)"}, {"rays", "Rays (CPU)"}}};
                 static const std::array<std::pair<std::string, std::string>, 4> kScales{
                     {{"1", "1×"}, {"1.25", "1.25×"}, {"1.5", "1.5×"}, {"2", "2×"}}};
                 std::array<char, 16> scale;
                 std::snprintf(scale.data(), scale.size(), "%g", workspace_.scale);
                 choiceMenu(actions, "Renderer", "view.renderer", kRenderers, rendererWord(workspace_.renderer));
                 choiceMenu(actions, "Interface size", "view.scale", kScales, scale.data());
             });
        menu(actions, "Add", {}, [&] { drawAddMenu(workspace_); });
        menu(actions, "Lattice",
             {"lattice.add", "lattice.remove", "-", "lattice.enable", "lattice.reset", "-", "tool.grab"});
        menu(actions, "Actor",
             {"actor.import-motion", "actor.clear-motion", "-", "rig.edit", "rig.fit", "-", "tool.rotate",
              "joint.clear-rotation", "joint.disjoint", "-", "pose.copy", "pose.paste", "pose.paste-mirrored",
              "pose.mirror", "pose.clear", "pose.save"},
             [&] {
                 static const std::array<std::pair<std::string, std::string>, 3> kTemplates{
                     {{"biped", "Biped"}, {"quadruped", "Quadruped"}, {"chain", "Chain"}}};
                 static const std::array<std::pair<std::string, std::string>, 2> kModes{
                     {{"connected", "Connected"}, {"disjoint", "Disjoint"}}};
                 ImGui::Separator();
                 choiceMenu(actions, "Auto-rig", "actor.rig", kTemplates, "");
                 choiceMenu(actions, "Mode", "actor.mode", kModes, actorMode(workspace_));
             });
        menu(actions, "Volume", {}, [&] {
            std::vector<std::pair<std::string, std::string>> looks{{"grey-ramp", "Grey ramp"}};
            for (const Preset& preset : presets()) looks.emplace_back(preset.name, preset.title);
            choiceMenu(actions, "Appearance", "appearance.preset", looks, "");
        });
        menu(actions, "Help", {"help.shortcuts"});
        ImGui::EndDisabled();
        ImGui::EndMenuBar();
    }
    ImGui::PopStyleVar();
    ImGui::End();
}

void Editor::drawPanels() {
    place(layout_.panels);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    const ImGuiWindowFlags flags = kFixed & ~ImGuiWindowFlags_NoScrollbar;
    ImGui::Begin("##panels", nullptr, flags);
    ImGui::PopStyleVar();
    if (workspace_.open) {
        ImGui::BeginDisabled(files_.loading());
        for (const Panel& panel : panels_) {
            if (panel.shown && !panel.shown(workspace_)) continue;
            const std::string label = std::string(panel.icon) + "  " + panel.title + "###" + panel.title;
            const bool isOpen = ui::section(label.c_str(), panel.openAtFirst);
            noteWidget(panel.title);
            if (!isOpen) continue;
            const WidgetScope scope(panel.title);
            ImGui::PushID(panel.title.c_str());
            panel.draw(workspace_);
            ImGui::PopID();
            ImGui::Spacing();
        }
        ImGui::EndDisabled();
    }
    ImGui::End();
}

std::string Editor::volumeLine() const {
    if (!workspace_.open || workspace_.assets.volumes.empty()) return {};
    const auto& [name, volume] = *workspace_.assets.volumes.begin();
    const Index3 size = volume->grid().size;
    std::string text = name + "   " + std::to_string(size.x) + " × " + std::to_string(size.y) + " × " +
                       std::to_string(size.z) + " " + std::string(nameOf(volume->type()));
    if (workspace_.assets.volumes.size() > 1)
        text += "   and " + std::to_string(workspace_.assets.volumes.size() - 1) + " more";
    return text;
}

void Editor::drawStatus() {
    place(layout_.status);
    const float height = float(layout_.status.size.y);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::PushStyleVar(
        ImGuiStyleVar_WindowPadding,
        ImVec2(10 * workspace_.scale, std::max(0.0f, std::floor(0.5f * (height - ImGui::GetFontSize())))));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, packed(theme::kWindow));
    ImGui::Begin("##status", nullptr, kFixed);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
    std::string right = volumeLine();
    if (const std::string played = playedText(workspace_); !played.empty()) {
        right += (right.empty() ? "" : "      ") + played;
    } else if (times && workspace_.open) {
        right += (right.empty() ? "" : "      ") + pictureText(rendererName_, *times, picture);
    }
    const float width = ImGui::CalcTextSize(right.c_str()).x, all = ImGui::GetWindowContentRegionMax().x;
    std::string hint = workspace_.open ? tools_.hint(toolContext(workspace_)) : "Ctrl+O: open  ·  F1: keys";
    if (const std::string text = tools_.readout(); !text.empty() && !workspace_.overlays) hint = text + "  ·  " + hint;
    const float space = all - width - 24 * workspace_.scale;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    // The hint gives way: what does not fit ends in dots.
    ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), at, ImVec2(at.x + std::max(0.0f, space), at.y + height),
                              at.x + space, at.x + space, hint.c_str(), nullptr, nullptr);
    ImGui::SetCursorPosX(std::max(0.0f, all - width));
    dimText(right);
    if (times && workspace_.open) ui::tooltip(picture.why);
    ImGui::End();
}

void Editor::drawShortcuts() {
    constexpr const char* kTitle = "Keyboard and mouse";
    if (std::exchange(showShortcuts_, false)) ImGui::OpenPopup(kTitle);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * window.x, 0.5f * window.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(
        ImVec2(std::min(560 * workspace_.scale, 0.94f * window.x), std::min(600 * workspace_.scale, 0.9f * window.y)));
    if (!ImGui::BeginPopupModal(kTitle, nullptr,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings))
        return;
    const WidgetScope scope(kTitle);
    const bool appearing = ImGui::IsWindowAppearing();
    ImGui::BeginChild("list", ImVec2(0, -ImGui::GetFrameHeightWithSpacing()));
    const float column = 200 * workspace_.scale;
    const auto line = [&](const std::string& keys, const std::string& what) {
        dimText(keys);
        ImGui::SameLine(column);
        ImGui::TextUnformatted(what.c_str());
    };
    for (const auto& [keys, what] : {std::pair{"Drag", "Turn the view"},
                                     {"Shift+drag", "Move the view"},
                                     {"Wheel", "Zoom to the pointer"},
                                     {"Drag a point", "Move it in the view's plane"},
                                     {"X, Y, Z while moving", "Lock to an axis"},
                                     {"Digits while moving", "Type a distance"},
                                     {"Escape while moving", "Put back"},
                                     {"Shift+click", "Add to the selection"},
                                     {"Ctrl+drag", "Select by a box"}})
        line(keys, what);
    ImGui::Separator();
    for (const Action& action : workspace_.actions.all())
        if (!action.shortcut.empty())
            line(action.shortcut, action.title + (action.region == KeyRegion::Timeline ? "  (over the timeline)"
                                                  : action.region == KeyRegion::Panels ? "  (over the panels)"
                                                                                       : ""));
    ImGui::EndChild();
    const bool close =
        ui::button("Close") ||
        (!appearing && (ImGui::IsKeyPressed(int(Key::Escape), false) || ImGui::IsKeyPressed(int(Key::F1), false)));
    if (close) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace voledit
