// `voledit transfers`: the library of formula files, or one file, as text, JSON or the docs' Markdown.

#include <CLI/App.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/cli/commands.h"
#include "core/base/error.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;
using Kind = TransferParameter::Kind;

struct TransfersArguments {
    std::string name;
    bool json = false, markdown = false;
};

std::string kindName(Kind kind) {
    constexpr std::array<const char*, 6> kNames{"number", "pair", "vector", "line", "axis", "axes"};
    return kNames[static_cast<std::size_t>(kind)];
}

/// As scenes write it.
Json toJson(const TransferArgument& value, Kind kind) {
    if (const auto* line = std::get_if<LineValue>(&value))
        return {{"point", {line->point.x, line->point.y, line->point.z}},
                {"direction", {line->direction.x, line->direction.y, line->direction.z}}};
    if (const auto* axes = std::get_if<std::vector<int>>(&value)) {
        Json names = Json::array();
        for (const int axis : *axes) names.push_back(std::string(1, "xyz"[axis]));
        return kind == Kind::Axis ? names[0] : names;
    }
    const auto& numbers = std::get<std::vector<double>>(value);
    return kind == Kind::Number ? Json(numbers.front()) : Json(numbers);
}

Json toJson(const TransferParameter& p) {
    Json json{{"name", p.name}, {"kind", kindName(p.kind)}};
    if (!p.unit.empty()) json["unit"] = p.unit;
    if (p.initial) json["default"] = toJson(*p.initial, p.kind);
    json["suggested"] = toJson(p.suggested, p.kind);
    if (p.kind == Kind::Number || p.kind == Kind::Pair || p.kind == Kind::Vector) {
        json["allowed"] = allowedInWords(p.allowed);
        json["slider"] = {p.slider.low, p.slider.high};
        json["strength"] = p.strength;
        if (p.strength) json["identity"] = p.identity;
    }
    if (p.uniform) json["uniform"] = true;
    json["description"] = p.description;
    return json;
}

Json toJson(const TransferDefinition& d) {
    Json json{{"name", d.name()},
              {"title", d.title()},
              {"description", d.description()},
              {"source", d.source()},
              {"space", d.usesFrame() ? "frame" : "world"},
              {"bounded", d.usesOutside()}};
    json["parameters"] = Json::array();
    for (const TransferParameter& p : d.parameters()) json["parameters"].push_back(toJson(p));
    json["formulas"] = Json::array();
    for (const auto& [what, text] : d.formulas()) json["formulas"].push_back({what, text});
    return json;
}

/// "vector, length, ≥ 0 …": what a value of the parameter is.
std::string formOf(const TransferParameter& p) {
    std::string form = p.uniform ? "number or vector" : kindName(p.kind);
    if (!p.unit.empty()) form += ", " + p.unit;
    if (p.allowed != Interval{}) form += ", " + allowedInWords(p.allowed);
    if (p.strength) form += ", strength";
    return form;
}

/// As a scene has it, whole numbers without ".0".
std::string defaultOf(const TransferParameter& p) {
    if (!p.initial) return "required";
    std::string text = toJson(*p.initial, p.kind).dump();
    for (std::size_t at; (at = text.find(".0,")) != std::string::npos || (at = text.find(".0]")) != std::string::npos;)
        text.erase(at, 2);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    for (std::size_t at = 0; (at = text.find(',', at)) != std::string::npos; at += 2) text.replace(at, 1, ", ");
    return text;
}

std::string spaceOf(const TransferDefinition& d) {
    return std::string(d.usesFrame() ? "in normalised coordinates u of its frame" : "in world coordinates p") +
           (d.usesOutside() ? "; `outside` says what happens where it is undefined" : "");
}

/// The map's own formulas.
std::vector<std::pair<std::string, std::string>> mapFormulas(const TransferDefinition& d) {
    auto formulas = d.formulas();
    std::erase_if(formulas,
                  [](const auto& f) { return f.first.starts_with("check ") || f.first.starts_with("image "); });
    return formulas;
}

void printText(const TransferDefinition& d) {
    std::cout << d.name() << ": " << d.title() << "\n" << d.description() << "\n";
    if (!d.source().empty()) std::cout << "Source: " << d.source() << "\n";
    std::cout << "Formulas " << spaceOf(d) << ".\n\n";
    for (const TransferParameter& p : d.parameters())
        std::cout << "  " << p.name << " (" << formOf(p) << "; " << defaultOf(p) << "): " << p.description << "\n";
    std::cout << "\n";
    for (const auto& [what, text] : mapFormulas(d)) std::cout << "  " << what << " = " << text << "\n";
}

void printMarkdown(const TransferDefinition& d) {
    std::cout << "## " << d.title() << ": `" << d.name() << "`\n" << d.description();
    if (!d.source().empty()) std::cout << " (" << d.source() << ")";
    std::cout << "\n\n| parameter | is | default | |\n| --- | --- | --- | --- |\n";
    for (const TransferParameter& p : d.parameters())
        std::cout << "| `" << p.name << "` | " << formOf(p) << " | " << defaultOf(p) << " | " << p.description
                  << " |\n";
    std::cout << "\n" << char(std::toupper(spaceOf(d)[0])) << spaceOf(d).substr(1) << ":\n\n```\n";
    for (const auto& [what, text] : mapFormulas(d)) {
        std::istringstream lines(text);
        std::string prefix = what + " = ";
        for (std::string line; std::getline(lines, line); prefix.clear())
            std::cout << prefix << line.substr(0, line.find_last_not_of(" \t") + 1) << "\n";
    }
    std::cout << "```\n\n";
}

void printMarkdown(const std::vector<TransferDefinitionPtr>& definitions) {
    std::cout
        << "# Transfers\n\nThe procedural spatial transfer functions that come with voledit, as `voledit transfers "
           "--markdown` prints them from their files in [resources/transfers](../resources/transfers/README.md), "
           "where the format stands for those who write their own.\n\n"
           "Formulas look backwards: `q` is the point of the undeformed object that is shown at the deformed point. "
           "Angles are degrees in scenes and radians in formulas, right-handed about the positive axis. `size` are "
           "the frame's edge lengths. `amount` multiplies what is marked as strength, and where nothing is, the "
           "displacement.\n\n";
    for (const TransferDefinitionPtr& definition : definitions) printMarkdown(*definition);
}

int transfers(const TransfersArguments& a) {
    std::vector<TransferDefinitionPtr> definitions;
    if (a.name.empty()) {
        definitions = transferLibrary();
    } else if (const TransferDefinitionPtr known = libraryTransfer(a.name)) {
        definitions = {known};
    } else if (a.name.ends_with(".stf")) {
        definitions = {TransferDefinition::load(a.name)};
    } else {
        throw Error(a.name, "the library has no such transfer",
                    "see voledit transfers for those it has, or name a file (*.stf)");
    }
    if (a.json) {
        Json json = Json::array();
        for (const TransferDefinitionPtr& definition : definitions) json.push_back(toJson(*definition));
        std::cout << (a.name.empty() ? json : json[0]).dump(2) << "\n";
    } else if (a.markdown) {
        printMarkdown(definitions);
    } else if (!a.name.empty()) {
        printText(*definitions.front());
    } else {
        for (const TransferDefinitionPtr& d : definitions) std::cout << d->name() << ": " << d->description() << "\n";
    }
    return 0;
}

}  // namespace

Command addTransfersCommand(CLI::App& command, const CommonArguments&) {
    auto a = std::make_shared<TransfersArguments>();
    command.add_option("name", a->name, "A transfer's name, or a formula file (*.stf) to check; all without it");
    auto* json = command.add_flag("--json", a->json, "As JSON");
    command.add_flag("--markdown", a->markdown, "As a page of the docs")->excludes(json);
    return [a] { return transfers(*a); };
}

}  // namespace voledit
