#include "app/editor/formula_field.h"

#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "app/editor/icons.h"
#include "app/editor/theme.h"
#include "app/editor/widget_parts.h"
#include "core/expression/formula.h"

namespace voledit {

namespace {

constexpr int kMostLines = 10;

int linesOf(const std::string& text) {
    return 1 + int(std::count(text.begin(), text.end(), '\n'));
}

/// Where line `line` of `text` begins and ends; the last one for a line beyond it.
std::pair<std::size_t, std::size_t> lineRange(const std::string& text, int line) {
    std::size_t begin = 0;
    for (int n = 1; n < line; ++n) {
        const std::size_t end = text.find('\n', begin);
        if (end == text.npos) break;
        begin = end + 1;
    }
    return {begin, std::min(text.find('\n', begin), text.size())};
}

/// The byte after `characters` characters of UTF-8 from `begin`, at most `end`.
std::size_t after(const std::string& text, std::size_t begin, std::size_t end, int characters) {
    std::size_t at = begin;
    for (int n = 0; n < characters && at < end; ++n) do
            ++at;
        while (at < end && (text[at] & 0xC0) == 0x80);
    return at;
}

/// A wavy line below the character at which a mistake was found, in the field drawn last.
void underline(const std::string& text, const FormulaProblem& problem, float scrollX) {
    const auto [begin, end] = lineRange(text, problem.line);
    const std::size_t from = after(text, begin, end, problem.column - 1), to = after(text, from, end, 1);
    const ImVec2 padding = ImGui::GetStyle().FramePadding, min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const char* base = text.c_str();
    const float size = ImGui::GetFontSize();
    const int line = 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(begin), '\n'));
    const float left = min.x + padding.x - scrollX + ImGui::CalcTextSize(base + begin, base + from).x;
    const float width = to > from ? ImGui::CalcTextSize(base + from, base + to).x : 0.6f * size;
    const float y = min.y + padding.y + float(line) * size - 0.5f, step = std::round(0.16f * size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(min, max, true);
    list.AddRectFilled({left, y - size}, {left + width, y}, packed(theme::kProblem, 0.22f));
    for (float x = left; x < left + std::max(width, 0.6f * size); x += 2 * step) {
        list.PathLineTo({x, y});
        list.PathLineTo({x + step, y - step * 0.8f});
        list.PathLineTo({x + 2 * step, y});
    }
    list.PathStroke(packed(theme::kProblem), 0, std::max(1.0f, size / 12));
    list.PopClipRect();
}

}  // namespace

FormulaProblem problemOf(const std::exception& error) {
    FormulaProblem problem = problemOf(std::string(error.what()));
    if (const auto* formula = dynamic_cast<const FormulaError*>(&error)) {
        problem.line = formula->line();
        problem.column = formula->column();
    }
    return problem;
}

FormulaProblem problemOf(const std::string& what) {
    FormulaProblem problem{what, {}, 0, 0};
    // The excerpt is the last two lines, of which the second holds nothing but a caret.
    std::string& text = problem.message;
    while (text.ends_with('\n')) text.pop_back();
    const std::size_t caret = text.rfind('\n');
    if (caret == text.npos || text.find_first_not_of(" \t", caret + 1) != text.rfind('^')) return problem;
    const std::size_t source = caret == 0 ? text.npos : text.rfind('\n', caret - 1);
    if (source == text.npos) return problem;
    problem.excerpt = text.substr(source + 1);
    text.erase(source);
    return problem;
}

std::optional<FormulaProblem> problemIn(const std::function<void()>& check) {
    try {
        check();
    } catch (const Error& error) {
        return problemOf(error);
    }
    return std::nullopt;
}

namespace ui {

void formulaProblem(const FormulaProblem& problem) {
    ImGui::PushStyleColor(ImGuiCol_Text, packed(theme::kProblem));
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(problem.message.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    noteWidget("Mistake");
    if (!problem.excerpt.empty()) excerpt(problem.excerpt, ImGui::GetWindowContentRegionMax().x);
}

void excerpt(const std::string& text, float right) {
    ImGui::PushFont(font(FontRole::Mono));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()), padding = ImGui::GetStyle().FramePadding;
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const float width = std::max(1.0f, right - ImGui::GetCursorPosX()), room = width - 2 * padding.x;
    const ImVec2 max{min.x + width, min.y + size.y + 2 * padding.y};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(min, max, packed(theme::kField), ImGui::GetStyle().FrameRounding);
    list.PushClipRect(min, max, true);
    const char* caret = text.c_str() + text.rfind('\n') + 1;
    const float at = ImGui::CalcTextSize(caret).x;
    const float x = min.x + padding.x - std::max(0.0f, std::min(at - 0.7f * room, size.x - room));
    list.AddText({x, min.y + padding.y}, packed(theme::kText), text.c_str(), caret);
    list.AddText({x, min.y + padding.y + ImGui::GetFontSize()}, packed(theme::kProblem), caret);
    list.PopClipRect();
    ImGui::Dummy({max.x - min.x, max.y - min.y});
    ImGui::PopFont();
}

}  // namespace ui

const FormulaProblem* FormulaFields::problem(const std::string& key) const {
    const auto draft = drafts_.find(key);
    return draft != drafts_.end() && draft->second.problem ? &*draft->second.problem : nullptr;
}

std::optional<bool> FormulaFields::typingWrong() const {
    for (const auto& [key, draft] : drafts_)
        if (draft.active) return draft.problem.has_value();
    return std::nullopt;
}

Edit FormulaFields::draw(const char* label, const std::string& key, std::string& value,
                         const std::function<void(const std::string& text)>& check, const std::string& help) {
    const auto found = drafts_.find(key);
    // What the scene holds was changed from elsewhere (undo): it wins.
    if (found != drafts_.end() && !found->second.active && found->second.scene != value) drafts_.erase(found);
    Draft& draft = drafts_.try_emplace(key, Draft{value, value, {}, false}).first->second;

    ui::row(label);
    ImGui::PushFont(font(FontRole::Mono));
    const std::string id = ui::hidden(label);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float height =
        float(std::clamp(linesOf(draft.text), 1, kMostLines)) * ImGui::GetFontSize() + 2 * style.FramePadding.y;
    if (draft.problem) ImGui::PushStyleColor(ImGuiCol_FrameBg, packed({0.220f, 0.115f, 0.120f, 1}));
    const bool changed =
        ImGui::InputTextMultiline(id.c_str(), &draft.text, {-FLT_MIN, height}, ImGuiInputTextFlags_CtrlEnterForNewLine);
    if (draft.problem) ImGui::PopStyleColor();
    const bool active = ImGui::IsItemActive(), left = ImGui::IsItemDeactivated();
    const ImGuiInputTextState* state = ImGui::GetInputTextState(ImGui::GetID(id.c_str()));
    if (draft.problem && draft.problem->line > 0)
        underline(draft.text, *draft.problem, state && active ? state->ScrollX : 0);
    ImGui::PopFont();
    noteWidget(label);
    ui::tooltip(help);

    Edit edit;
    const bool escaped = left && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (changed && !escaped) {
        draft.problem = problemIn([&] { check(draft.text); });
        if (!draft.problem) value = draft.text;
        edit.changed = !draft.problem;
    }
    if (escaped)
        edit.cancelled = true;
    else if (left && draft.problem)
        edit.cancelled = true;  // the last right text was a preview; the wrong one stays to be mended
    else if (left)
        edit.finished = true;
    draft.active = active;
    if (escaped || (left && !draft.problem)) drafts_.erase(key);
    if (const FormulaProblem* wrong = problem(key)) ui::formulaProblem(*wrong);
    return edit;
}

}  // namespace voledit
