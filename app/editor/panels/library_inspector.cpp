#include <algorithm>
#include <cmath>

#include "app/editor/panels/inspectors.h"
#include "core/base/error.h"

namespace voledit {

namespace {

/// "toAxis" and "at" as labels: "To axis", "At".
std::string labelOf(const std::string& name) {
    std::string label;
    for (const char c : name)
        label += c >= 'A' && c <= 'Z' && !label.empty() ? std::string(" ") + char(c - 'A' + 'a') : std::string(1, c);
    if (!label.empty() && label[0] >= 'a' && label[0] <= 'z') label[0] = char(label[0] - 'a' + 'A');
    return label;
}

int decimalsFor(const Interval& range) {
    const double length = range.high - range.low;
    if (!std::isfinite(length) || length <= 0) return 3;
    return std::clamp(int(std::ceil(-std::log10(length / 100))), 0, 5);
}

/// How a parameter's numbers are shown for lengths of `box`.
ParameterFormat formatOf(const TransferParameter& parameter, const Box3& box) {
    const Interval slider = sliderFor(parameter, box);
    ParameterFormat format;
    format.format.min = slider.low;
    format.format.max = slider.high;
    format.format.decimals = decimalsFor(slider);
    format.format.speed = std::isfinite(slider.high - slider.low) ? (slider.high - slider.low) / 400 : 0;
    if (parameter.unit == "degrees") {
        format.format.unit = "°";
        format.format.decimals = 1;
    }
    format.allowed = parameter.allowed;
    return format;
}

/// Fields of vectors are dragged; what may be typed bounds them.
NumberFormat dragFormat(const ParameterFormat& format) {
    NumberFormat drag = format.format;
    drag.min = format.allowed.low;
    drag.max = format.allowed.high;
    return drag;
}

std::string helpOf(const TransferParameter& parameter) {
    std::string help = parameter.description;
    const auto add = [&](const std::string& line) { help += (help.empty() ? "" : "\n") + line; };
    if (parameter.unit == "length" || parameter.unit == "position") add("World units.");
    if (parameter.strength) add("Amount multiplies it.");
    return help;
}

/// As TransferArgument, with tracks.
LibraryTransfer::Argument argumentOf(const TransferParameter& parameter, const TransferArgument& value) {
    if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return Tracked<std::vector<double>>(*numbers);
    if (const auto* line = std::get_if<LineValue>(&value)) return LibraryTransfer::Line{line->point, line->direction};
    return LibraryTransfer::Axes{std::get<std::vector<int>>(value), parameter.kind == TransferParameter::Kind::Axes};
}

class ParameterRow {
public:
    ParameterRow(Inspection& inspection, const TransferParameter& parameter, LibraryTransfer::Argument& argument)
        : inspection_(inspection),
          parameter_(parameter),
          argument_(argument),
          label_(labelOf(parameter.name)),
          help_(helpOf(parameter)),
          format_(formatOf(parameter, inspection.box())) {}

    void draw() {
        switch (parameter_.kind) {
            case TransferParameter::Kind::Number:
            case TransferParameter::Kind::Pair:
            case TransferParameter::Kind::Vector:
                return numbers();
            case TransferParameter::Kind::Line:
                return line();
            case TransferParameter::Kind::Axis:
            case TransferParameter::Kind::Axes:
                return axes();
        }
    }

private:
    Inspection& inspection_;
    const TransferParameter& parameter_;
    LibraryTransfer::Argument& argument_;
    std::string label_, help_;
    ParameterFormat format_;

    void numbers() {
        auto* value = std::get_if<Tracked<std::vector<double>>>(&argument_);
        if (!value || (*value)->empty()) return;
        inspection_.tracked(label_.c_str(), "/" + parameter_.name, *value,
                            [&](std::vector<double>& now) { return numberRow(now); });
    }

    Edit numberRow(std::vector<double>& now) {
        const char* label = label_.c_str();
        if (parameter_.kind == TransferParameter::Kind::Pair && now.size() == 2) {
            std::array<double, 2> pair{now[0], now[1]};
            const Edit edit = ui::pair(label, pair, format_, help_);
            now = {pair[0], pair[1]};
            return edit;
        }
        if (parameter_.kind == TransferParameter::Kind::Vector) {
            Vec3 vector = now.size() == 3 ? Vec3(now[0], now[1], now[2]) : Vec3(now[0]);
            const Edit edit = ui::vector(label, vector, dragFormat(format_), help_);
            if (edit.changed) now = {vector.x, vector.y, vector.z};
            return edit;
        }
        return ui::parameter(label, now[0], format_, help_);
    }

    void line() {
        auto* line = std::get_if<LibraryTransfer::Line>(&argument_);
        if (!line) return;
        inspection_.position((label_ + " point").c_str(), "/" + parameter_.name + "/point", line->point, help_);
        inspection_.direction((label_ + " along").c_str(), "/" + parameter_.name + "/direction", line->direction,
                              help_);
    }

    void axes() {
        auto* axes = std::get_if<LibraryTransfer::Axes>(&argument_);
        if (!axes || axes->axes.empty()) return;
        const std::string step = "Change " + parameter_.name;
        if (parameter_.kind == TransferParameter::Kind::Axes)
            return inspection_.note(ui::axes(label_.c_str(), axes->axes, help_), step);
        int axis = axes->axes.front();
        const Edit edit = ui::axis(label_.c_str(), axis, help_);
        if (edit.changed) axes->axes = {axis};
        inspection_.note(edit, step);
    }
};

}  // namespace

TransferDefinitionPtr definitionOf(const LibraryTransfer& transfer, const LoadedAssets& assets) {
    if (!transfer.isFile) return libraryTransfer(transfer.definition);
    const auto found = assets.transfers.find(transfer.definition);
    return found == assets.transfers.end() ? nullptr : found->second;
}

void inspectLibraryTransfer(Inspection& inspection, LibraryTransfer& transfer) {
    Workspace& workspace = inspection.workspace();
    const TransferDefinitionPtr definition = definitionOf(transfer, workspace.assets);
    if (transfer.isFile) {
        const std::string& problem = workspace.formulaFiles.problem(transfer.definition);
        if (!problem.empty()) ui::formulaProblem(problemOf(Error(problem)));
    }
    if (!definition) return ui::warning("There is no \"" + transfer.definition + "\".");
    ui::note(definition->description());
    if (!definition->source().empty()) ui::finePrint(definition->source());
    if (transfer.isFile) {
        ui::finePrint(transfer.definition);
        ui::actionButton(workspace.actions, "transfers.reload");
    }
    for (const TransferParameter& parameter : definition->parameters()) {
        auto given = transfer.arguments.find(parameter.name);
        LibraryTransfer::Argument argument =
            given != transfer.arguments.end()
                ? given->second
                : argumentOf(parameter,
                             parameter.initial ? *parameter.initial : suggestedFor(parameter, inspection.box()));
        const LibraryTransfer::Argument before = argument;
        ParameterRow(inspection, parameter, argument).draw();
        // What was left out stays left out until it is edited.
        if (!(argument == before)) transfer.arguments[parameter.name] = argument;
    }
}

}  // namespace voledit
