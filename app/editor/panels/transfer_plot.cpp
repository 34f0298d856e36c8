#include "app/editor/panels/transfer_plot.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "app/editor/icons.h"
#include "app/editor/theme.h"

namespace voledit {

namespace {

ImVec2 im(const Vec2& v) {
    return {float(v.x), float(v.y)};
}

/// Decimals that tell apart what a pixel of `range` over a panel does.
int decimalsFor(double range) {
    return std::clamp(int(std::ceil(-std::log10(std::max(range, 1e-12) / 300))), 0, 6);
}

/// All values of the data and of the tables, never empty.
ValueRange wholeRange(const TransferFunction& tables, const VolumeStatistics& statistics) {
    ValueRange whole = rangeOf(tables);
    whole.low = std::min(whole.low, statistics.min);
    whole.high = std::max(whole.high, statistics.max);
    return whole.size() > 0 ? whole : ValueRange{whole.low - 0.5, whole.low + 0.5};
}

ImU32 rgb(const Vec3& c, float alpha = 1) {
    return packed(Vec4f(float(c.x), float(c.y), float(c.z), 1), alpha);
}

}  // namespace

/// Where things are in this frame, screen pixels: the plot above, the bar of colours below, then labels.
struct TransferPlot::Geometry {
    Vec2 plotMin, plotMax, barMin, barMax;
    ValueRange view;
    double em;  // height of the letters
    ImDrawList* list;

    double xOf(double value) const { return plotMin.x + (value - view.low) / view.size() * (plotMax.x - plotMin.x); }
    double valueOf(double x) const { return view.low + (x - plotMin.x) / (plotMax.x - plotMin.x) * view.size(); }
    // A little room above and below keeps points at 0 and 1 whole.
    double inset() const { return 0.4 * em; }
    double yOf(double opacity) const { return plotMax.y - inset() - opacity * (plotMax.y - plotMin.y - 2 * inset()); }
    double opacityOf(double y) const { return (plotMax.y - inset() - y) / (plotMax.y - plotMin.y - 2 * inset()); }
    Vec2 at(const Vec2& point) const { return {xOf(point.x), yOf(point.y)}; }
    Vec2 stopAt(double value) const { return {xOf(value), barMax.y}; }
    bool inBar(const Vec2& p) const { return barMax.y > barMin.y && p.y >= barMin.y; }
    bool inView(double x) const { return x >= plotMin.x - 0.5 && x <= plotMax.x + 0.5; }
};

TransferPlot::Geometry TransferPlot::geometry(const ValueRange& whole) const {
    const double em = ImGui::GetFontSize(), width = std::max(8 * em, double(ImGui::GetContentRegionAvail().x));
    const double margin = 0.02 * whole.size();
    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    Geometry g{};
    g.plotMin = {cursor.x, cursor.y};
    g.plotMax = g.plotMin + Vec2(width, words_.lines * em);
    g.barMin = {g.plotMin.x, g.plotMax.y + (words_.colors ? 0.15 * em : 0)};
    g.barMax = g.barMin + Vec2(width, words_.colors ? 0.9 * em : 0);
    g.view = view_.value_or(ValueRange{whole.low - margin, whole.high + margin});
    g.em = em;
    g.list = ImGui::GetWindowDrawList();
    return g;
}

TransferPlot::Result TransferPlot::draw(const TransferFunction& shown, const TransferFunction& committed,
                                        const VolumeStatistics& statistics) {
    const ValueRange whole = wholeRange(committed, statistics);
    const Geometry g = geometry(whole);
    const ImVec2 size{float(g.plotMax.x - g.plotMin.x), float(g.barMax.y - g.plotMin.y + 0.5 * g.em)};
    ImGui::InvisibleButton(
        words_.plot, size,
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    ImGui::SetItemUsingMouseWheel();
    noteWidget(words_.plot, g.plotMin, g.plotMax);
    if (words_.colors) noteWidget("Color bar", g.barMin, g.barMax);
    const bool hovered = ImGui::IsItemHovered();
    const Vec2 mouse{ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y};
    const Handle under = dragged_.part != Part::None ? dragged_ : hovered ? handleAt(g, shown, mouse) : Handle{};

    Result result{shown, {}, {}};
    // Something else ended the drag, as undo does: its tables are no longer the scene's.
    const bool held =
        ImGui::IsItemActive() || (ImGui::IsItemDeactivated() && !ImGui::IsMouseDown(ImGuiMouseButton_Left));
    if (start_ && !held) {
        start_.reset();
        dragged_ = {};
    }
    if (hovered || ImGui::IsItemActive()) navigate(g, whole);
    if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) press(g, committed, under, g.inBar(mouse));
    if (start_) drag(g, result);
    const bool deletes = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Delete), false) && !ImGui::GetIO().KeyCtrl;
    if (hovered && !start_ && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) removeHandle(under, result);
    if (hovered && !start_ && deletes) removeHandle(selected_, result);

    g.list->PushClipRect(im(g.plotMin - Vec2(0.4 * g.em)), im(g.barMax + Vec2(0.6 * g.em)), true);
    drawHistogram(g, statistics);
    drawOpacity(g, result.function, under);
    if (words_.colors) drawColors(g, result.function, under);
    if (hovered || start_) drawReadout(g, result.function);
    g.list->PopClipRect();
    drawAxis(g);
    ImGui::Dummy({size.x, float(0.9 * g.em)});
    entry(committed, whole, result);
    return result;
}

TransferPlot::Handle TransferPlot::handleAt(const Geometry& g, const TransferFunction& shown, const Vec2& mouse) const {
    Handle best;
    double nearest = 0.65 * g.em;
    const auto consider = [&](Part part, std::size_t index, const Vec2& at) {
        const double distance = glm::distance(at, mouse);
        if (distance >= nearest) return;
        nearest = distance;
        best = {part, index};
    };
    for (std::size_t i = 0; i < shown.opacity.points.size(); ++i) {
        const Vec2 at = g.at(shown.opacity.points[i]);
        if (g.inView(at.x)) consider(Part::Opacity, i, at);
    }
    for (std::size_t i = 0; i < shown.color.points.size(); ++i) {
        const Vec2 at = g.stopAt(shown.color.points[i].value);
        // The whole height of the bar above a stop is its handle.
        if (g.inView(at.x) && g.inBar(mouse)) consider(Part::Color, i, {at.x, mouse.y});
    }
    return best;
}

void TransferPlot::navigate(const Geometry& g, const ValueRange& whole) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
        const double fixed = g.valueOf(io.MousePos.x);
        view_ = zoomed(g.view, fixed, std::pow(0.8, double(io.MouseWheel)), whole.size() * 1e-4, whole.size() * 4);
    }
    if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
        const double by = g.valueOf(g.plotMin.x + io.MouseDelta.x) - g.view.low;
        view_ = ValueRange{g.view.low - by, g.view.high - by};
    }
}

std::string TransferPlot::stepOf(Part part) const {
    return part == Part::Opacity ? words_.what : "colour";
}

void TransferPlot::press(const Geometry& g, const TransferFunction& committed, const Handle& under, bool inBar) {
    const ImGuiIO& io = ImGui::GetIO();
    const Vec2 at{g.valueOf(io.MousePos.x), g.opacityOf(io.MousePos.y)};
    start_.reset();
    grab_ = at;
    pressedAt_ = {io.MousePos.x, io.MousePos.y};
    moved_ = false;
    selected_ = under;
    if (io.KeyShift) {
        start_ = committed;
        dragged_ = {Part::All, 0};
        step_ = "Shift appearance";
    } else if (under.part != Part::None) {
        start_ = committed;
        dragged_ = under;
        step_ = "Edit " + stepOf(under.part);
        if (under.part == Part::Opacity && under.index < committed.opacity.points.size())
            grab_ = at - committed.opacity.points[under.index];
        else if (under.part == Part::Color && under.index < committed.color.points.size())
            grab_.x = at.x - committed.color.points[under.index].value;
    } else if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        start_ = committed;
        grab_ = {0, 0};
        dragged_ = inBar ? Handle{Part::Color, insertStop(start_->color, at.x)}
                         : Handle{Part::Opacity, insertPoint(start_->opacity, at)};
        step_ = inBar ? "Add colour" : "Add " + stepOf(Part::Opacity) + " point";
        selected_ = dragged_;
        moved_ = true;
    }
}

void TransferPlot::drag(const Geometry& g, Result& result) {
    const ImGuiIO& io = ImGui::GetIO();
    const Vec2 at = Vec2(g.valueOf(io.MousePos.x), g.opacityOf(io.MousePos.y)) - grab_;
    // A click selects; its tremble is no edit.
    moved_ = moved_ || glm::distance(pressedAt_, Vec2(io.MousePos.x, io.MousePos.y)) > 0.15 * g.em;
    const bool released = !ImGui::IsMouseDown(ImGuiMouseButton_Left);
    if (!moved_) {
        if (released) start_.reset();
        if (released) dragged_ = {};
        return;
    }
    result.step = step_;
    result.function = *start_;
    if (dragged_.part == Part::Opacity) movePoint(result.function.opacity, dragged_.index, at);
    if (dragged_.part == Part::Color) moveStop(result.function.color, dragged_.index, at.x);
    if (dragged_.part == Part::All) result.function = shifted(*start_, at.x);
    result.edit.changed = true;
    const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (!escape && !released) return;
    result.edit.cancelled = escape;
    result.edit.finished = !escape;
    start_.reset();
    dragged_ = {};
    if (escape) ImGui::ClearActiveID();
}

void TransferPlot::removeHandle(Handle handle, Result& result) {
    bool removed = false;
    if (handle.part == Part::Opacity) removed = removePoint(result.function.opacity, handle.index);
    if (handle.part == Part::Color) removed = removeStop(result.function.color, handle.index);
    if (!removed) return;
    result.step = "Remove " + stepOf(handle.part) + (handle.part == Part::Opacity ? " point" : "");
    result.edit = {true, true, false};
    selected_ = {};
}

void TransferPlot::drawHistogram(const Geometry& g, const VolumeStatistics& statistics) const {
    const float rounding = ImGui::GetStyle().FrameRounding;
    g.list->AddRectFilled(im(g.plotMin), im(g.plotMax), packed(theme::kField), rounding, ImDrawFlags_RoundCornersTop);
    const auto& bins = statistics.histogram;
    if (bins.empty() || !(statistics.max > statistics.min)) return;
    const std::uint64_t most = *std::max_element(bins.begin(), bins.end());
    if (most == 0) return;
    const double width = (statistics.max - statistics.min) / double(bins.size());
    for (std::size_t i = 0; i < bins.size(); ++i) {
        if (bins[i] == 0) continue;
        // Logarithmic: a thousandth of the voxels is still seen.
        const double share = std::log1p(double(bins[i])) / std::log1p(double(most));
        const double left = std::max(g.plotMin.x, g.xOf(statistics.min + width * double(i)));
        const double right = std::min(g.plotMax.x, g.xOf(statistics.min + width * double(i + 1)));
        if (right <= left) continue;
        g.list->AddRectFilled(im({left, g.yOf(0.92 * share)}), im({right, g.yOf(0)}), packed(theme::kTextDim, 0.26f));
    }
}

void TransferPlot::drawOpacity(const Geometry& g, const TransferFunction& shown, const Handle& under) const {
    for (const double opacity : {0.0, 0.5, 1.0})
        g.list->AddLine(im({g.plotMin.x, g.yOf(opacity)}), im({g.plotMax.x, g.yOf(opacity)}),
                        packed(theme::kText, 0.07f));
    const double column = std::max(1.0, std::round(g.em / 8));
    for (double x = g.plotMin.x; x < g.plotMax.x; x += column) {
        const double value = g.valueOf(x + 0.5 * column), opacity = shown.opacity(value);
        if (opacity > 0)
            g.list->AddRectFilled(im({x, g.yOf(opacity)}), im({std::min(x + column, g.plotMax.x), g.yOf(0)}),
                                  rgb(shown.color(value), 0.42f));
    }
    const auto& points = shown.opacity.points;
    if (points.empty()) return;
    std::vector<ImVec2> line{im({g.plotMin.x, g.yOf(shown.opacity(g.view.low))})};
    for (const auto& point : points)
        if (g.inView(g.xOf(point.x))) line.push_back(im(g.at(point)));
    line.push_back(im({g.plotMax.x, g.yOf(shown.opacity(g.view.high))}));
    g.list->AddPolyline(line.data(), int(line.size()), packed(theme::kText, 0.9f), 0, float(g.em * 0.11));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec2 at = g.at(points[i]);
        if (!g.inView(at.x)) continue;
        const Handle self{Part::Opacity, i};
        const bool marked = self == selected_ || self == under;
        const auto radius = float(g.em * (marked ? 0.36 : 0.29));
        g.list->AddCircleFilled(im(at), radius, packed(self == selected_ ? theme::kAccent : theme::kText));
        g.list->AddCircle(im(at), radius, packed(marked ? theme::kText : theme::kField), 0, float(g.em * 0.1));
        noteWidget(words_.point + (" " + std::to_string(i + 1)), at - Vec2(radius), at + Vec2(radius));
    }
}

void TransferPlot::drawColors(const Geometry& g, const TransferFunction& shown, const Handle& under) const {
    const double column = std::max(1.0, std::round(g.em / 8));
    for (double x = g.barMin.x; x < g.barMax.x; x += column)
        g.list->AddRectFilled(im({x, g.barMin.y}), im({std::min(x + column, g.barMax.x), g.barMax.y}),
                              rgb(shown.color(g.valueOf(x + 0.5 * column))));
    for (std::size_t i = 0; i < shown.color.points.size(); ++i) {
        const Vec2 at = g.stopAt(shown.color.points[i].value);
        if (!g.inView(at.x)) continue;
        const Handle self{Part::Color, i};
        const double w = g.em * 0.30, top = at.y - 0.42 * g.em, bottom = at.y + 0.38 * g.em;
        const ImU32 ring = packed(self == selected_ ? theme::kAccent : self == under ? theme::kText : theme::kWindow);
        g.list->AddTriangleFilled(im({at.x, top - 0.15 * g.em}), im({at.x + w * 1.5, bottom + 0.1 * g.em}),
                                  im({at.x - w * 1.5, bottom + 0.1 * g.em}), ring);
        g.list->AddTriangleFilled(im({at.x, top + 0.1 * g.em}), im({at.x + w, bottom}), im({at.x - w, bottom}),
                                  rgb(shown.color.points[i].color));
        noteWidget("Color stop " + std::to_string(i + 1), {at.x - w, top}, {at.x + w, bottom});
    }
}

void TransferPlot::drawAxis(const Geometry& g) const {
    ImGui::PushFont(font(FontRole::Small));
    const double step = niceStep(g.view.size(), 4);
    const int decimals = std::max(0, -int(std::floor(std::log10(step))));
    double used = g.plotMin.x;
    for (double value = std::ceil(g.view.low / step) * step; value <= g.view.high; value += step) {
        char label[32];
        std::snprintf(label, sizeof label, "%.*f", decimals, std::abs(value) < step / 2 ? 0.0 : value);
        const double width = ImGui::CalcTextSize(label).x, x = g.xOf(value) - width / 2;
        if (x < used || x + width > g.plotMax.x) continue;
        g.list->AddText(im({x, g.barMax.y + 0.5 * g.em}), packed(theme::kTextDim), label);
        used = x + width + 0.5 * g.em;
    }
    ImGui::PopFont();
}

void TransferPlot::drawReadout(const Geometry& g, const TransferFunction& shown) const {
    const double x = std::clamp(double(ImGui::GetIO().MousePos.x), g.plotMin.x, g.plotMax.x), value = g.valueOf(x);
    g.list->AddLine(im({x, g.plotMin.y}), im({x, g.barMax.y}), packed(theme::kText, 0.25f));
    char label[96];
    std::snprintf(label, sizeof label, "%.*f   %s %.3f", decimalsFor(g.view.size()), value, words_.what,
                  shown.opacity(value));
    ImGui::PushFont(font(FontRole::Small));
    const ImVec2 size = ImGui::CalcTextSize(label);
    const Vec2 at = g.plotMin + Vec2(0.4 * g.em, 0.25 * g.em);
    g.list->AddRectFilled(im(at - Vec2(0.2 * g.em, 0.1 * g.em)),
                          im(at + Vec2(size.x + 0.2 * g.em, size.y + 0.1 * g.em)), packed(theme::kField, 0.8f),
                          ImGui::GetStyle().FrameRounding);
    g.list->AddText(im(at), packed(theme::kText), label);
    ImGui::PopFont();
}

void TransferPlot::entry(const TransferFunction& committed, const ValueRange& whole, Result& result) {
    NumberFormat values;
    values.decimals = decimalsFor(whole.size());
    values.speed = whole.size() / 600;
    NumberFormat opacities{0, 1, 0.003, 3};
    if (selected_.part == Part::Opacity && selected_.index < result.function.opacity.points.size()) {
        const std::size_t i = selected_.index;
        Vec2 at = result.function.opacity.points[i];
        Edit edit = ui::number(words_.where, at.x, values, words_.whereHelp);
        edit = edit | ui::number(words_.height, at.y, opacities, words_.help);
        if (start_ || i >= committed.opacity.points.size()) return;
        if (edit.changed) movePoint(result.function.opacity, i, at);
        if (edit.changed || edit.finished || edit.cancelled)
            result.edit = edit, result.step = "Edit " + stepOf(Part::Opacity);
    } else if (selected_.part == Part::Color && selected_.index < result.function.color.points.size()) {
        const std::size_t i = selected_.index;
        double value = result.function.color.points[i].value;
        Vec3 color = result.function.color.points[i].color;
        const Edit moved = ui::number("Value", value, values, "Data value of the selected colour");
        const Edit painted = ui::color("Colour", color, "Colour from this value on");
        const Edit edit = moved | painted;
        if (start_) return;
        if (moved.changed) moveStop(result.function.color, i, value);
        if (painted.changed) result.function.color.points[i].color = color;
        if (edit.changed || edit.finished || edit.cancelled) result.edit = edit, result.step = "Edit colour";
    } else {
        ImGui::PushFont(font(FontRole::Small));
        ImGui::AlignTextToFramePadding();
        ui::note("Double-click: add  ·  right-click: remove");
        ImGui::PopFont();
        const float side = ImGui::GetFrameHeight() * 1.1f;
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - side);
        if (ui::iconButton(icons::kFit, "Fit", "Show all values. The wheel zooms, a middle drag pans.")) fit();
    }
}

}  // namespace voledit
