#include "app/editor/panels/appearance_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/editor/icons.h"
#include "app/editor/panels/gradient_statistics.h"
#include "app/editor/theme.h"
#include "app/editor/timeline/key_row.h"
#include "core/fields/statistics.h"
#include "core/scene/appearance.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

/// Names of the assets that are loaded and shown by a volume object.
std::vector<std::string> shownAssets(const Workspace& workspace) {
    std::vector<std::string> names;
    for (const auto& [name, volume] : workspace.assets.volumes)
        if (volume && findAppearance(workspace.document.scene(), name)) names.push_back(name);
    return names;
}

/// The colours of `tables`, darker where they are transparent, in a rectangle. Each stretch between two points takes as
/// much room as any other, for most of what is seen lies in a small part of the values.
void drawSwatch(ImDrawList& list, const TransferFunction& tables, const ImVec2& min, const ImVec2& max) {
    std::vector<double> stops;
    for (const auto& point : tables.opacity.points) stops.push_back(point.x);
    for (const auto& point : tables.color.points) stops.push_back(point.value);
    std::sort(stops.begin(), stops.end());
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    if (stops.size() < 2) return;
    const auto shadeAt = [&](double share) {
        const double at = share * double(stops.size() - 1);
        const std::size_t i = std::min(std::size_t(at), stops.size() - 2);
        const double value = stops[i] + (at - double(i)) * (stops[i + 1] - stops[i]);
        const Vec3 c = tables.color(value) * (0.12 + 0.88 * std::sqrt(std::clamp(tables.opacity(value), 0.0, 1.0)));
        return packed(Vec4f(float(c.x), float(c.y), float(c.z), 1));
    };
    const int steps = 32;
    for (int i = 0; i < steps; ++i) {
        const double from = double(i) / steps, to = double(i + 1) / steps;
        const ImU32 left = shadeAt(from), right = shadeAt(to);
        list.AddRectFilledMultiColor({min.x + (max.x - min.x) * float(from), min.y},
                                     {min.x + (max.x - min.x) * float(to), max.y}, left, right, right, left);
    }
}

/// The swatch at the right end of the item drawn last, `gap` letters before its end.
void swatchInItem(const TransferFunction& tables, float gap) {
    const float em = ImGui::GetFontSize();
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const float inset = std::round((max.y - min.y - em * 0.8f) / 2), right = max.x - em * gap;
    drawSwatch(*ImGui::GetWindowDrawList(), tables, {right - em * 4.5f, min.y + inset}, {right, max.y - inset});
}

/// A row of the preset list: title, swatch at the right. True when it was clicked.
bool presetRow(const std::string& title, const TransferFunction& tables, bool chosen) {
    ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, ImVec2(0, 0.5f));
    const bool clicked = ImGui::Selectable(title.c_str(), chosen, 0, {0, ImGui::GetFontSize() * 1.4f});
    ImGui::PopStyleVar();
    noteWidget(title);
    swatchInItem(tables, 0.4f);
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
    const bool open = ui::beginCombo("Preset", title);
    if (!open) {
        swatchInItem(resolve(now, *workspace.assets.volumes.at(asset)), 1.6f);
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
    if (presetRow("Grey ramp", greyRamp(0, 1), title == "Grey ramp")) chosen = "";
    for (const Preset& preset : presets()) {
        if (presetRow(preset.title, preset.tables, title == preset.title)) chosen = preset.name;
        ui::tooltip(preset.description);
    }
    ImGui::EndCombo();
    if (chosen) choose(*chosen);
}

void opacityDistance(Workspace& workspace) {
    Document& document = workspace.document;
    const auto& tracked = document.scene().opacityDistance;
    double distance = tracked ? tracked->at(workspace.time) : workspace.compiled.opacityDistance;
    NumberFormat format;
    format.min = 1e-6;
    format.decimals = distance < 0.1 ? 4 : 2;
    format.speed = distance / 100;
    const KeyRow keys(workspace, tracked ? "/opacityDistance" : "", "Opacity distance",
                      tracked ? keyStateOf(*tracked, workspace.time) : KeyState::None);
    const Edit edit = ui::number("Opacity distance", distance, format,
                                 "The length of material that has the opacity drawn above. Shorter is denser.");
    applyEdit(document, edit, "Change density",
              [&](Scene& scene) { setOpacityDistance(scene, distance, workspace.when()); });
}

/// Writes tables out as the appearance of `asset`.
void applyTables(Workspace& workspace, const std::string& asset, const Edit& edit, const std::string& step,
                 const TransferFunction& tables) {
    applyEdit(workspace.document, edit, step, [&](Scene& scene) {
        Appearance appearance;
        appearance.color = tables.color;
        appearance.opacity = tables.opacity;
        if (!tables.gradientOpacity.points.empty()) appearance.gradientOpacity = tables.gradientOpacity;
        setAppearance(scene, asset, appearance);
    });
}

constexpr PlotWords kGradientWords{.plot = "Gradient plot",
                                   .point = "Gradient point",
                                   .height = "Factor",
                                   .help = "On the opacity, where values change so steeply",
                                   .what = "factor",
                                   .where = "Gradient",
                                   .whereHelp = "Change of the values a unit of length",
                                   .lines = 5,
                                   .colors = false};

}  // namespace

AppearancePanel::AppearancePanel() : gradientPlot_(kGradientWords) {}

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
    const auto& volume = workspace.assets.volumes.at(asset_);
    const Document& document = workspace.document;
    const TransferFunction shown = resolve(*findAppearance(document.scene(), asset_), *volume);
    const TransferFunction committed = resolve(*findAppearance(document.committed(), asset_), *volume);
    if (std::exchange(countedOf_, volume) != volume) {
        values_ = countedStatistics(*volume);
        steepness_ = gradientStatistics(*volume);
        gradientPlot_.fit();
    }
    const TransferPlot::Result result = plot_.draw(shown, committed, values_);
    applyTables(workspace, asset_, result.edit, result.step, result.function);
    editGradientOpacity(workspace, shown, committed);
    opacityDistance(workspace);
}

// The factor's table is drawn as the opacity of a grey material over the magnitude.
void AppearancePanel::editGradientOpacity(Workspace& workspace, const TransferFunction& shown,
                                          const TransferFunction& committed) {
    bool on = !shown.gradientOpacity.points.empty();
    const Edit switched = ui::checkbox("Gradient opacity", on,
                                       "Multiplies opacity by a factor that depends on how steeply values change: "
                                       "flat regions vanish, surfaces stay.");
    TransferFunction tables = shown;
    tables.gradientOpacity.points.clear();
    if (on) tables.gradientOpacity.points = {{0.05 * steepness_.max, 0}, {0.3 * steepness_.max, 1}};
    applyTables(workspace, asset_, switched, "Change gradient opacity", tables);
    if (shown.gradientOpacity.points.empty() || committed.gradientOpacity.points.empty() || !on) return;
    const auto grey = [](const TransferFunction& function) {
        return TransferFunction{ColorTable{{{0, Vec3(0.75)}}}, function.gradientOpacity, {}};
    };
    const TransferPlot::Result result = gradientPlot_.draw(grey(shown), grey(committed), steepness_);
    tables.gradientOpacity = result.function.opacity;
    applyTables(workspace, asset_, result.edit, result.step, tables);
}

}  // namespace voledit
