#include "app/editor/panels/appearance_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "core/scene/appearance.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

/// Names of the assets that are loaded and shown by a volume object.
std::vector<std::string> shownAssets(const Workspace& workspace) {
    std::vector<std::string> names;
    for (const auto& [name, volume] : workspace.volumes)
        if (volume && findAppearance(workspace.document.scene(), name)) names.push_back(name);
    return names;
}

/// The colours of `tables` over their values, darker where they are transparent, into a rectangle.
void drawSwatch(ImDrawList& list, const TransferFunction& tables, const ImVec2& min, const ImVec2& max) {
    const ValueRange range = rangeOf(tables);
    if (!(range.size() > 0)) return;
    const int steps = 28;
    for (int i = 0; i < steps; ++i) {
        const double value = range.low + range.size() * (i + 0.5) / steps;
        const double shade = 0.15 + 0.85 * std::pow(std::clamp(tables.opacity(value), 0.0, 1.0), 0.5);
        const Vec3 c = tables.color(value) * shade;
        const float left = min.x + (max.x - min.x) * float(i) / float(steps);
        const float right = min.x + (max.x - min.x) * float(i + 1) / float(steps);
        list.AddRectFilled({left, min.y}, {right, max.y}, packed(Vec4f(float(c.x), float(c.y), float(c.z), 1)));
    }
}

/// A row of the preset list: title, swatch at the right. True when it was clicked.
bool presetRow(const std::string& title, const TransferFunction* tables, bool chosen) {
    const float em = ImGui::GetFontSize();
    const bool clicked = ImGui::Selectable(title.c_str(), chosen, 0, {0, em * 1.35f});
    noteWidget(title);
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    if (tables)
        drawSwatch(*ImGui::GetWindowDrawList(), *tables, {max.x - em * 6, min.y + em * 0.3f},
                   {max.x - em * 0.3f, max.y - em * 0.3f});
    return clicked;
}

std::string titleOf(const Appearance& appearance) {
    if (appearance.color || appearance.opacity) return "Custom";
    if (appearance.preset.empty()) return "Grey ramp";
    for (const Preset& preset : presets())
        if (preset.name == appearance.preset) return preset.title;
    return appearance.preset;
}

void presetCombo(Workspace& workspace, const std::string& asset) {
    const Appearance& now = *findAppearance(workspace.document.scene(), asset);
    const std::string title = titleOf(now);
    ui::row("Preset");
    const bool open = ImGui::BeginCombo("##Preset", title.c_str(), ImGuiComboFlags_HeightLarge);
    noteWidget("Preset");
    if (!open) {
        ui::tooltip("How values become colour and opacity");
        return;
    }
    const WidgetScope scope("Preset");
    const auto choose = [&](const std::string& preset) {
        workspace.document.apply("Change preset", [&](Scene& scene) {
            Appearance appearance;
            appearance.preset = preset;
            setAppearance(scene, asset, appearance);
        });
    };
    std::optional<std::string> chosen;
    if (presetRow("Grey ramp", nullptr, title == "Grey ramp")) chosen = "";
    for (const Preset& preset : presets()) {
        if (presetRow(preset.title, &preset.tables, title == preset.title)) chosen = preset.name;
        ui::tooltip(preset.description);
    }
    ImGui::EndCombo();
    if (chosen) choose(*chosen);
}

void opacityDistance(Workspace& workspace) {
    Document& document = workspace.document;
    double distance = document.scene().opacityDistance.value_or(workspace.compiled.opacityDistance);
    NumberFormat format;
    format.min = 1e-6;
    format.decimals = distance < 0.1 ? 4 : 2;
    format.speed = distance / 100;
    const Edit edit = ui::number("Density length", distance, format,
                                 "The length of material that has the opacity drawn above. Shorter is denser.");
    applyEdit(document, edit, "Change density", [&](Scene& scene) { setOpacityDistance(scene, distance); });
}

}  // namespace

void AppearancePanel::draw(Workspace& workspace) {
    const std::vector<std::string> assets = shownAssets(workspace);
    if (assets.empty()) return ui::note("Open a volume to give it an appearance.");
    auto now = std::find(assets.begin(), assets.end(), asset_);
    if (now == assets.end()) {
        now = assets.begin();
        plot_.fit();
    }
    int index = int(now - assets.begin());
    if (assets.size() > 1 && ui::combo("Volume", index, assets).changed) plot_.fit();
    asset_ = assets[std::size_t(index)];

    presetCombo(workspace, asset_);
    const Volume& volume = *workspace.volumes.at(asset_);
    const Document& document = workspace.document;
    const TransferPlot::Result result =
        plot_.draw(resolve(*findAppearance(document.scene(), asset_), volume),
                   resolve(*findAppearance(document.committed(), asset_), volume), volume.statistics());
    applyEdit(workspace.document, result.edit, result.step, [&](Scene& scene) {
        Appearance appearance;
        appearance.color = result.function.color;
        appearance.opacity = result.function.opacity;
        if (!result.function.gradientOpacity.points.empty())
            appearance.gradientOpacity = result.function.gradientOpacity;
        setAppearance(scene, asset_, appearance);
    });
    opacityDistance(workspace);
}

}  // namespace voledit
