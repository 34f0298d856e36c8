#include "core/stf/transfer_image.h"

#include <cmath>

namespace voledit {

namespace {

FormulaSymbols withBox(const FormulaSymbols& symbols, const std::vector<FormulaFileOver>& overs) {
    FormulaSymbols result = symbols;
    result.variables = {{"low", 3}, {"high", 3}};
    for (const FormulaFileOver& over : overs) result.variables.push_back({over.name, 1});
    return result;
}

std::vector<FormulaLet> joined(std::vector<FormulaLet> a, const std::vector<FormulaLet>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

FormulaGraph resultGraph(const FormulaFileImage& image, const std::vector<FormulaLet>& lets,
                         const FormulaSymbols& symbols) {
    std::vector<FormulaOutput> outputs;
    for (const auto* part : {&image.point, &image.min, &image.max})
        if (*part) outputs.push_back({**part, FormulaType::Vector});
    return {joined(joined(lets, image.lets), image.laterLets), outputs, withBox(symbols, image.overs)};
}

/// A graph's outputs for one set of variables.
std::vector<double> valuesOf(const FormulaGraph& graph, const std::vector<double>& variables,
                             std::span<const double> parameters) {
    std::vector<double> values(std::size_t(graph.outputCount()));
    std::vector<const double*> in;
    std::vector<double*> out;
    for (const double& v : variables) in.push_back(&v);
    for (double& v : values) out.push_back(&v);
    graph.evaluate(in, parameters, out, 1);
    return values;
}

}  // namespace

TransferImage::TransferImage(const FormulaFileImage& image, const std::vector<FormulaLet>& lets,
                             const FormulaSymbols& symbols)
    : result_(resultGraph(image, lets, symbols)) {
    std::vector<FormulaOutput> values;
    for (const FormulaFileOver& over : image.overs) {
        overSizes_.push_back(over.values.size());
        for (const FormulaText& value : over.values) values.push_back({value, FormulaType::Number});
    }
    if (!values.empty()) overs_.emplace(joined(lets, image.lets), values, withBox(symbols, {}));
}

Box3 TransferImage::of(const Box3& rest, std::span<const double> parameters) const {
    std::vector<double> variables{rest.min.x, rest.min.y, rest.min.z, rest.max.x, rest.max.y, rest.max.z};
    const std::vector<double> lists = overs_ ? valuesOf(*overs_, variables, parameters) : std::vector<double>();
    std::size_t combinations = 1;
    for (const std::size_t size : overSizes_) combinations *= size;
    variables.resize(6 + overSizes_.size());
    Box3 image;
    for (std::size_t combination = 0; combination < combinations; ++combination) {
        std::size_t left = combination, begin = 0;
        for (std::size_t o = 0; o < overSizes_.size(); ++o) {
            variables[6 + o] = lists[begin + left % overSizes_[o]];
            left /= overSizes_[o];
            begin += overSizes_[o];
        }
        const std::vector<double> corners = valuesOf(result_, variables, parameters);
        for (const double v : corners)
            if (!std::isfinite(v)) return rest;
        for (std::size_t c = 0; c + 2 < corners.size(); c += 3)
            image = join(image, Vec3(corners[c], corners[c + 1], corners[c + 2]));
    }
    return image;
}

}  // namespace voledit
