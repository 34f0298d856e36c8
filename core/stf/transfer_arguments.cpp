#include "core/stf/transfer_arguments.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voledit {

namespace {

using Kind = TransferParameter::Kind;

/// The fewest digits that give the number back.
std::string shown(double number) {
    std::array<char, 32> text;
    // −0 is written as 0.
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number + 0.0).ptr};
}

std::string expectedFor(const TransferParameter& parameter) {
    switch (parameter.kind) {
        case Kind::Number:
            return "a number";
        case Kind::Pair:
            return "two numbers";
        case Kind::Vector:
            return parameter.uniform ? "one number or three" : "three numbers";
        case Kind::Line:
            return "a line: a point and a direction other than 0";
        case Kind::Axis:
            return "an axis";
        case Kind::Axes:
            break;
    }
    return "a list of axes";
}

std::size_t numberCount(Kind kind) {
    return kind == Kind::Number ? 1 : kind == Kind::Pair ? 2 : kind == Kind::Vector ? 3 : 0;
}

bool isFinite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether `value` has the parameter's form; one number for a uniform vector is made three.
bool takesForm(const TransferParameter& parameter, TransferArgument& value) {
    if (auto* numbers = std::get_if<std::vector<double>>(&value)) {
        if (parameter.uniform && numbers->size() == 1) numbers->assign(3, double(numbers->front()));
        return numbers->size() == numberCount(parameter.kind);
    }
    if (const auto* axes = std::get_if<std::vector<int>>(&value))
        return (parameter.kind == Kind::Axes || (parameter.kind == Kind::Axis && axes->size() == 1)) &&
               std::all_of(axes->begin(), axes->end(), [](int a) { return a >= 0 && a < 3; });
    const LineValue& line = std::get<LineValue>(value);
    return parameter.kind == Kind::Line && isFinite(line.point) && isFinite(line.direction) &&
           line.direction != Vec3(0);
}

/// `v` of length 1, whatever its length was.
Vec3 direction(const Vec3& v) {
    // Scaled first: squares of very long or short vectors leave the range of numbers.
    const Vec3 scaled = v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return scaled / glm::length(scaled);
}

void append(std::vector<double>& values, const Vec3& v) {
    values.insert(values.end(), {v.x, v.y, v.z});
}

}  // namespace

std::string allowedInWords(const Interval& allowed) {
    // An end that is left out is stored as the number next to it, which is longer to write.
    const auto end = [](double v, double beyond, const char* closed, const char* open) {
        const std::string here = shown(v), next = shown(std::nextafter(v, beyond));
        return next.size() < here.size() ? open + next : closed + here;
    };
    const bool low = std::isfinite(allowed.low), high = std::isfinite(allowed.high);
    if (!low && !high) return "any number";
    std::string text = low ? end(allowed.low, -kInfinity, "at least ", "above ") : "";
    if (high) text += (low ? " and " : "") + end(allowed.high, kInfinity, "at most ", "below ");
    return text;
}

TransferArguments completeArguments(const TransferDefinition& definition, const TransferArguments& given) {
    TransferArguments result;
    for (const TransferParameter& parameter : definition.parameters()) {
        const std::string where = definition.name() + ", \"" + parameter.name + "\"";
        const auto found = given.find(parameter.name);
        if (found == given.end() && !parameter.initial)
            throw Error(where, "is missing", "give " + expectedFor(parameter) + ": " + parameter.description);
        TransferArgument value = found == given.end() ? *parameter.initial : found->second;
        if (!takesForm(parameter, value))
            throw Error(where, "has another form than expected", "give " + expectedFor(parameter));
        if (const auto* numbers = std::get_if<std::vector<double>>(&value))
            for (const double v : *numbers)
                if (!std::isfinite(v) || !parameter.allowed.contains(v))
                    throw Error(where, shown(v) + " is not allowed",
                                "give " + (std::isfinite(v) ? "numbers " + allowedInWords(parameter.allowed)
                                                            : "finite numbers"));
        result[parameter.name] = std::move(value);
    }
    for (const auto& [name, value] : given)
        if (!definition.find(name)) {
            std::string known;
            for (const TransferParameter& p : definition.parameters()) known += (known.empty() ? "" : ", ") + p.name;
            throw Error(definition.name() + ", \"" + name + "\"", "there is no such parameter",
                        known.empty() ? "it has none" : "it has " + known);
        }
    return result;
}

FormulaSymbols symbolsFor(const TransferDefinition& definition, const TransferArguments& arguments) {
    FormulaSymbols symbols;
    for (const TransferParameter& parameter : definition.parameters()) {
        if (parameter.kind == Kind::Axis || parameter.kind == Kind::Axes) {
            const auto& axes = std::get<std::vector<int>>(arguments.at(parameter.name));
            std::vector<double> constant(parameter.kind == Kind::Axes ? 3 : 1, 0.0);
            for (const int a : axes)
                (parameter.kind == Kind::Axes ? constant[std::size_t(a)] : constant[0]) =
                    parameter.kind == Kind::Axes ? 1.0 : double(a);
            symbols.constants[parameter.name] = constant;
        } else if (parameter.kind == Kind::Line) {
            symbols.parameters.push_back({parameter.name + "_point", 3});
            symbols.parameters.push_back({parameter.name + "_direction", 3});
        } else {
            symbols.parameters.push_back({parameter.name, parameter.kind == Kind::Number ? 1 : 3});
        }
    }
    if (definition.usesFrame()) symbols.parameters.insert(symbols.parameters.end(), {{"size", 3}, {"hand", 1}});
    symbols.parameters.push_back({"t", 1});
    return symbols;
}

std::vector<double> parameterValues(const TransferDefinition& definition, const TransferArguments& arguments,
                                    const Frame& frame, double amount, double time) {
    std::vector<double> values;
    for (const TransferParameter& parameter : definition.parameters()) {
        const TransferArgument& argument = arguments.at(parameter.name);
        if (const auto* line = std::get_if<LineValue>(&argument)) {
            append(values, line->point);
            append(values, direction(line->direction));
        } else if (const auto* numbers = std::get_if<std::vector<double>>(&argument)) {
            for (double v : *numbers) {
                // Whole strength is the value itself, to the bit.
                if (parameter.strength && amount != 1) v = parameter.identity + amount * (v - parameter.identity);
                values.push_back(parameter.unit == "degrees" ? v * (kPi / 180) : v);
            }
            if (numbers->size() == 2) values.push_back(0);
        }
    }
    if (definition.usesFrame()) {
        append(values, {glm::length(frame.edge[0]), glm::length(frame.edge[1]), glm::length(frame.edge[2])});
        values.push_back(glm::determinant(Mat3(frame.edge[0], frame.edge[1], frame.edge[2])) < 0 ? -1.0 : 1.0);
    }
    values.push_back(time);
    return values;
}

TransferArgument suggestedFor(const TransferParameter& parameter, const Box3& box) {
    if (box.empty() || (parameter.initial && parameter.suggested == *parameter.initial)) return parameter.suggested;
    const Vec3 size = box.size();
    TransferArgument result = parameter.suggested;
    if (auto* line = std::get_if<LineValue>(&result)) line->point = box.min + line->point * size;
    auto* numbers = std::get_if<std::vector<double>>(&result);
    if (!numbers) return result;
    const double side = std::max({size.x, size.y, size.z});
    for (std::size_t i = 0; i < numbers->size(); ++i) {
        const bool each = numbers->size() == 3;
        if (parameter.unit == "length") (*numbers)[i] *= each ? size[int(i)] : side;
        if (parameter.unit == "position" && each) (*numbers)[i] = box.min[int(i)] + (*numbers)[i] * size[int(i)];
    }
    return result;
}

Interval sliderFor(const TransferParameter& parameter, const Box3& box) {
    if (box.empty()) return parameter.slider;
    const Vec3 size = box.size();
    const double side = std::max({size.x, size.y, size.z});
    if (parameter.unit == "length") return {parameter.slider.low * side, parameter.slider.high * side};
    if (parameter.unit != "position") return parameter.slider;
    const double low = std::min({box.min.x, box.min.y, box.min.z}), high = std::max({box.max.x, box.max.y, box.max.z});
    return {low + parameter.slider.low * (high - low), low + parameter.slider.high * (high - low)};
}

}  // namespace voledit
