#include "app/editor/panels/inspection.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/error.h"
#include "core/scene/compile.h"

namespace voledit {

namespace {

constexpr double kDefaultSize = 2;  // of a scene without anything in it

/// Decimals that show a thousandth of `size`.
int decimalsFor(double size) {
    return std::clamp(int(std::ceil(-std::log10(std::max(size / 1000, 1e-9)))), 1, 6);
}

std::string numberText(double value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return std::string(text.data(), end);
}

/// The number that `text` is, and nothing else.
std::optional<double> numberIn(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\n"), last = text.find_last_not_of(" \t\n");
    if (first == text.npos) return std::nullopt;
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data() + first, text.data() + last + 1, value);
    if (problem != std::errc{} || end != text.data() + last + 1) return std::nullopt;
    return value;
}

}  // namespace

std::string Inspection::stepFor(const std::string& label) {
    std::string name = label;
    if (!name.empty()) name[0] = char(std::tolower(static_cast<unsigned char>(name[0])));
    return "Change " + name;
}

void Inspection::note(const Edit& edit, const std::string& step) {
    if (!edit.changed && !edit.finished && !edit.cancelled) return;
    edit_ = edit_ | edit;
    step_ = step;
}

void Inspection::finish() {
    if (edit_.changed) workspace_.pending.step = step_;
    if (edit_.finished || edit_.cancelled) workspace_.pending = {};
    applyEdit(workspace_.document, edit_, step_, write);
}

NumberFormat Inspection::lengthFormat() const {
    const double size = state_.box.empty() ? kDefaultSize : glm::length(state_.box.size());
    NumberFormat format;
    format.speed = size / 1000;
    format.decimals = decimalsFor(size);
    return format;
}

void Inspection::length(const char* label, const std::string& member, Tracked<double>& value, double low,
                        const std::string& help) {
    NumberFormat format = lengthFormat();
    format.min = low;
    tracked(label, member, value, [&](double& now) { return ui::number(label, now, format, help); });
}

void Inspection::position(const char* label, const std::string& member, Tracked<Vec3>& value, const std::string& help) {
    tracked(label, member, value, [&](Vec3& now) { return ui::vector(label, now, lengthFormat(), help); });
}

void Inspection::direction(const char* label, const std::string& member, Tracked<Vec3>& value,
                           const std::string& help) {
    NumberFormat format;
    format.speed = 0.01;
    tracked(label, member, value, [&](Vec3& now) {
        const Vec3 before = now;
        Edit edit = ui::vector(label, now, format, help);
        // No direction at all is none to show anything by.
        if (glm::length(now) < 1e-9) {
            now = before;
            edit.changed = false;
        }
        return edit;
    });
}

Edit Inspection::formulaRow(const char* label, const std::string& member, const std::string& text, std::string& typed,
                            const std::function<void(const std::string&)>& put, const std::string& help) {
    typed = text;
    const auto check = [&](const std::string& candidate) {
        put(candidate);
        Scene scene = workspace_.document.committed();
        try {
            write(scene);
            compile(scene, workspace_.assets, workspace_.time, &workspace_.compiled);
        } catch (const Error& error) {
            put(text);
            // What was wrong before is not this formula's fault.
            if (error.what() != workspace_.problem) throw;
        }
    };
    const Edit edit = state_.formulas.draw(label, path_ + member, typed, check, help);
    if (edit.changed) put(typed);
    return edit;
}

void Inspection::formula(const char* label, const std::string& member, const std::string& text,
                         const std::function<void(const std::string&)>& put, const std::string& help) {
    std::string typed;
    note(formulaRow(label, member, text, typed, put, help), stepFor(label));
}

void Inspection::scalar(const char* label, const std::string& member, std::variant<Tracked<double>, std::string>& value,
                        const ParameterFormat& format, const std::string& help) {
    const std::string step = stepFor(label);
    if (auto* number = std::get_if<Tracked<double>>(&value)) {
        bool toFormula = false;
        tracked(label, member, *number,
                [&](double& now) { return ui::parameterOrFormula(label, now, format, help, toFormula); });
        if (!toFormula) return;
        value = numberText(number->at(workspace_.time));
        return note({true, true, false}, step);
    }
    const std::string text = std::get<std::string>(value);
    std::string typed;
    Edit edit = formulaRow(
        label, member, text, typed, [&](const std::string& to) { value = to; }, help);
    if (const auto number = numberIn(typed); number && edit.finished) {
        value = Tracked<double>(*number);
        edit.changed = true;
    }
    note(edit, step);
}

void Inspection::field(const char* label, const std::string& member, FieldRef& field, const ParameterFormat& format,
                       const std::string& help) {
    std::variant<Tracked<double>, std::string> value;
    if (const auto* number = std::get_if<NumberField>(&field->kind))
        value = number->value;
    else if (const auto* formula = std::get_if<FormulaField>(&field->kind))
        value = formula->expression;
    else {
        const auto* asset = std::get_if<AssetField>(&field->kind);
        ui::row(label);
        return ui::note(asset ? "values of " + asset->asset : "made of others, see the tree");
    }
    const auto before = value;
    // The check of a formula writes the copy of the node: the field must hold the candidate then.
    const std::function<void(Scene&)> outer = write;
    const auto store = [&] {
        if (const auto* number = std::get_if<Tracked<double>>(&value))
            field = Field{NumberField{*number}};
        else
            field = Field{FormulaField{std::get<std::string>(value)}};
    };
    write = [&](Scene& scene) {
        store();
        outer(scene);
    };
    scalar(label, member, value, format, help);
    write = outer;
    if (!(value == before)) store();
}

void Inspection::boxRows(const char* minLabel, const char* maxLabel, const std::string& member, TrackedBox& box) {
    position(minLabel, member + "/min", box.min, "Lower corner, world units");
    position(maxLabel, member + "/max", box.max, "Upper corner, world units");
}

void Inspection::placementRows(Placement& placement, const std::string& member) {
    if (placement.matrix) {
        ui::note("A matrix, as the file gives it.");
        const bool split =
            ui::button("Replace by translate, rotate, scale", "Starts from no translation, no rotation and scale 1");
        if (split) placement = {};
        note({split, split, false}, "Replace matrix");
        return;
    }
    position("Translate", member + "/translate", placement.translate, "World units");
    NumberFormat degrees{-kInfinity, kInfinity, 0.5, 1, "°"};
    tracked("Rotate", member + "/rotate", placement.rotate,
            [&](Vec3& now) { return ui::vector("Rotate", now, degrees, "Degrees about x, then y, then z"); });
    NumberFormat factor{-kInfinity, kInfinity, 0.005, 3};
    tracked("Scale", member + "/scale", placement.scale, [&](Vec3& now) {
        const Vec3 before = now;
        Edit edit = ui::vector("Scale", now, factor, "Along x, y, z");
        if (now.x * now.y * now.z == 0) {
            now = before;
            edit.changed = false;
        }
        return edit;
    });
}

}  // namespace voledit
