#include "core/stf/transfer_definition.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <mutex>

#include "core/fields/simple_fields.h"
#include "core/stf/composite_maps.h"
#include "core/stf/formula_file.h"
#include "core/stf/transfer_arguments.h"
#include "core/stf/transfer_image.h"

namespace voledit {

namespace {

constexpr std::array<int, 3> kCoordinates{0, 1, 2};

/// What a file's formulas become for one choice of axes.
struct Graphs {
    FormulaGraph checks;  // one condition each
    FormulaGraph map, withDerivatives;
    std::optional<TransferImage> image;
};

std::vector<FormulaOutput> mapOutputs(const FormulaFile& file) {
    std::vector<FormulaOutput> outputs;
    if (file.point) {
        outputs.push_back({*file.point, FormulaType::Vector});
    } else {
        outputs.push_back({file.x.value_or(FormulaText{"x", "", 1, 1}), FormulaType::Number});
        outputs.push_back({file.y.value_or(FormulaText{"y", "", 1, 1}), FormulaType::Number});
        outputs.push_back({file.z.value_or(FormulaText{"z", "", 1, 1}), FormulaType::Number});
    }
    if (file.undefined) outputs.push_back({*file.undefined, FormulaType::Condition});
    return outputs;
}

FormulaGraph mapGraph(const FormulaFile& file, FormulaSymbols symbols) {
    const std::string point = file.world ? "p" : "u";
    symbols.variables = {{point, 3}};
    std::vector<FormulaLet> lets;
    for (int c = 0; c < 3; ++c)
        lets.push_back({std::string(1, "xyz"[c]), {point + "[" + std::to_string(c) + "]", "", 1, 1}});
    lets.insert(lets.end(), file.lets.begin(), file.lets.end());
    lets.insert(lets.end(), file.mapLets.begin(), file.mapLets.end());
    return {lets, mapOutputs(file), symbols};
}

/// Also where there are no checks: a let before [map] that needs the point is a mistake there, not where it is used.
FormulaGraph checkGraph(const FormulaFile& file, const FormulaSymbols& symbols) {
    std::vector<FormulaOutput> outputs;
    for (const FormulaFileCheck& check : file.checks) outputs.push_back({check.condition, FormulaType::Condition});
    return {file.lets, outputs, symbols};
}

std::shared_ptr<const Graphs> makeGraphs(const FormulaFile& file, const FormulaSymbols& symbols) {
    FormulaGraph checks = checkGraph(file, symbols);
    FormulaGraph map = mapGraph(file, symbols);
    FormulaGraph withDerivatives = map.withDerivatives(kCoordinates);
    std::optional<TransferImage> image;
    if (file.image) image.emplace(*file.image, file.lets, symbols);
    return std::make_shared<const Graphs>(
        Graphs{std::move(checks), std::move(map), std::move(withDerivatives), std::move(image)});
}

std::vector<std::pair<std::string, std::string>> formulasOf(const FormulaFile& file) {
    std::vector<std::pair<std::string, std::string>> formulas;
    const auto add = [&](const std::string& what, const std::optional<FormulaText>& formula) {
        if (formula) formulas.emplace_back(what, formula->text);
    };
    for (const auto* lets : {&file.lets, &file.mapLets})
        for (const FormulaLet& let : *lets) add("let " + let.name, let.formula);
    add("q", file.point);
    add("x", file.x);
    add("y", file.y);
    add("z", file.z);
    add("undefined", file.undefined);
    for (const FormulaFileCheck& check : file.checks) add("check " + check.message, check.condition);
    if (!file.image) return formulas;
    for (const auto* lets : {&file.image->lets, &file.image->laterLets})
        for (const FormulaLet& let : *lets) add("image let " + let.name, let.formula);
    for (const FormulaFileOver& over : file.image->overs)
        for (const FormulaText& value : over.values) add("image over " + over.name, value);
    add("image point", file.image->point);
    add("image min", file.image->min);
    add("image max", file.image->max);
    return formulas;
}

/// Throws Error for the first check that refuses; gives the warnings that apply.
std::string checked(const FormulaFile& file, const FormulaGraph& checks, const std::vector<double>& parameters,
                    const std::string& name) {
    std::vector<double> results(file.checks.size());
    std::vector<double*> out;
    for (double& r : results) out.push_back(&r);
    checks.evaluate({}, parameters, out, 1);
    std::string warnings;
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (results[i] == 0) continue;
        if (file.checks[i].isError) throw Error(name, file.checks[i].message, "");
        warnings += (warnings.empty() ? "" : "; ") + file.checks[i].message;
    }
    return warnings;
}

}  // namespace

struct TransferDefinition::Formulas {
    explicit Formulas(FormulaFile f) : file(std::move(f)) {}
    const FormulaFile file;

    std::shared_ptr<const Graphs> graphs(const FormulaSymbols& symbols) const {
        // A choice of axes has its own graph; numbers share one, so that a drag compiles nothing.
        constexpr std::size_t kMostChoices = 64;
        const std::lock_guard lock(mutex_);
        const auto found = byAxes_.find(symbols.constants);
        if (found != byAxes_.end()) return found->second;
        auto made = makeGraphs(file, symbols);
        if (byAxes_.size() >= kMostChoices) byAxes_.clear();
        byAxes_.emplace(symbols.constants, made);
        return made;
    }

private:
    mutable std::mutex mutex_;
    mutable std::map<std::map<std::string, std::vector<double>>, std::shared_ptr<const Graphs>> byAxes_;
};

TransferDefinitionPtr TransferDefinition::parse(const std::string& text, const std::string& name,
                                                const std::string& file) {
    FormulaFile read = parseFormulaFile(text, file);
    auto definition = std::shared_ptr<TransferDefinition>(new TransferDefinition());
    definition->name_ = name;
    definition->title_ = read.title.empty() ? name : read.title;
    definition->description_ = read.description;
    definition->source_ = read.source;
    definition->parameters_ = read.parameters;
    definition->usesFrame_ = !read.world;
    definition->usesOutside_ = read.bounded;
    definition->formulas_ = formulasOf(read);
    definition->compiled_ = std::make_shared<const Formulas>(std::move(read));
    // The formulas are compiled once, so that their mistakes show here.
    std::map<std::string, TransferArgument> suggested;
    for (const TransferParameter& parameter : definition->parameters_) suggested[parameter.name] = parameter.suggested;
    definition->compiled_->graphs(symbolsFor(*definition, suggested));
    return definition;
}

const TransferParameter* TransferDefinition::find(const std::string& parameter) const {
    const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                    [&](const TransferParameter& p) { return p.name == parameter; });
    return found == parameters_.end() ? nullptr : &*found;
}

TransferPtr TransferDefinition::make(const Use& use, std::string* warning) const {
    const std::map<std::string, TransferArgument> arguments = completeArguments(*this, use.arguments);
    const auto graphs = compiled_->graphs(symbolsFor(*this, arguments));
    const bool hasStrength =
        std::any_of(parameters_.begin(), parameters_.end(), [](const auto& p) { return p.strength; });
    const std::vector<double> values =
        parameterValues(*this, arguments, use.frame, hasStrength ? use.amount : 1.0, use.time);
    const std::string warnings = checked(compiled_->file, graphs->checks, values, name_);
    if (warning) *warning = warnings;
    FormulaMap::Parts parts{
        graphs->map, values, Mat4(1), Mat4(1), usesOutside_ ? use.outside : Outside::Hide, {}, graphs->withDerivatives};
    if (usesFrame_) {
        parts.formulaFromWorld = normalisedFromWorld(use.frame);
        parts.worldFromFormula = worldFromNormalised(use.frame);
    }
    if (graphs->image)
        parts.image = [graphs, values, from = parts.formulaFromWorld, to = parts.worldFromFormula](const Box3& rest) {
            return transformed(graphs->image->of(transformed(rest, from), values), to);
        };
    TransferPtr map = std::make_shared<FormulaMap>(std::move(parts));
    if (hasStrength || use.amount == 1) return map;
    return std::make_shared<ScaledMap>(std::make_shared<ConstantField>(use.amount), std::move(map));
}

TransferPtr makeExpressionMap(const ExpressionUse& use) {
    FormulaSymbols symbols;
    symbols.variables = {{"x", 1}, {"y", 1}, {"z", 1}};
    symbols.parameters = {{"t", 1}};
    std::vector<FormulaOutput> outputs{
        {use.x, FormulaType::Number}, {use.y, FormulaType::Number}, {use.z, FormulaType::Number}};
    if (use.undefined) outputs.push_back({*use.undefined, FormulaType::Condition});
    FormulaMap::Parts parts{
        FormulaGraph(use.lets, outputs, symbols), {use.time}, Mat4(1), Mat4(1), Outside::Hide, {}, std::nullopt};
    if (!use.world) {
        parts.formulaFromWorld = normalisedFromWorld(use.frame);
        parts.worldFromFormula = worldFromNormalised(use.frame);
    }
    if (use.image) parts.image = [box = boundsOf(*use.image)](const Box3&) { return box; };
    return std::make_shared<FormulaMap>(std::move(parts));
}

}  // namespace voledit
