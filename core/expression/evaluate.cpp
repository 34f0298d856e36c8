#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "core/base/parallel.h"
#include "core/expression/block_kernels.h"
#include "core/expression/formula_graph.h"

namespace voledit {

namespace {

using Kind = FormulaPlace::Kind;

/// One call of `evaluate`: its arrays and the values that are the same for all points.
class Evaluation {
public:
    Evaluation(const FormulaGraph::Nodes& graph, std::span<const double* const> variables,
               std::span<const double> parameters, std::span<double* const> outputs, std::size_t count)
        : program_(graph.program),
          variables_(variables),
          outputs_(outputs),
          uniform_(program_.hasUniforms ? graph.nodes.size() : 0) {
        if (program_.hasUniforms) evaluateUniform(graph, parameters, uniform_);
        stride_ = std::min(count, kFormulaBlock);
        registers_ = std::make_unique_for_overwrite<double[]>(stride_ * static_cast<std::size_t>(program_.registers));
    }

    /// Points from `begin` on, at most kFormulaBlock.
    void run(std::size_t begin, std::size_t n) {
        begin_ = begin;
        for (const FormulaStep& step : program_.steps) runStep(step, n);
        for (const auto& [output, from] : program_.copies) {
            const BlockOperand source = operand(from);
            if (source.values)
                std::copy_n(source.values, n, outputs_[static_cast<std::size_t>(output)] + begin);
            else
                std::fill_n(outputs_[static_cast<std::size_t>(output)] + begin, n, source.uniform);
        }
    }

private:
    BlockOperand operand(const FormulaPlace& place) const {
        const std::size_t index = static_cast<std::size_t>(place.index);
        switch (place.kind) {
            case Kind::Register:
                return {registers_.get() + index * stride_};
            case Kind::Variable:
                return {variables_[index] + begin_};
            case Kind::Output:
                return {outputs_[index] + begin_};
            case Kind::Uniform:
                return {nullptr, uniform_[index]};
            default:
                return {};
        }
    }
    double* target(const FormulaPlace& place) const {
        const std::size_t index = static_cast<std::size_t>(place.index);
        return place.kind == Kind::Output ? outputs_[index] + begin_ : registers_.get() + index * stride_;
    }

    void runStep(const FormulaStep& step, std::size_t n) const {
        const std::array<BlockOperand, 3> in{operand(step.in[0]), operand(step.in[1]), operand(step.in[2])};
        kernel_({.op = step.op,
                 .payload = step.payload,
                 .in = in.data(),
                 .result = target(step.out),
                 .cosine = step.cosine.kind == Kind::None ? nullptr : target(step.cosine)},
                n);
    }

    const BlockKernel kernel_ = blockKernel();
    const FormulaProgram& program_;
    std::span<const double* const> variables_;
    std::span<double* const> outputs_;
    std::vector<double> uniform_;
    std::size_t stride_ = 0, begin_ = 0;
    std::unique_ptr<double[]> registers_;
};

void evaluateRange(const FormulaGraph::Nodes& graph, std::span<const double* const> variables,
                   std::span<const double> parameters, std::span<double* const> outputs, std::size_t begin,
                   std::size_t end) {
    Evaluation evaluation(graph, variables, parameters, outputs, end - begin);
    for (; begin < end; begin += kFormulaBlock) evaluation.run(begin, std::min(kFormulaBlock, end - begin));
}

}  // namespace

void FormulaGraph::evaluate(std::span<const double* const> variables, std::span<const double> parameters,
                            std::span<double* const> outputs, std::size_t count) const {
    assert(variables.size() >= static_cast<std::size_t>(variableCount()));
    assert(parameters.size() >= static_cast<std::size_t>(parameterCount()));
    assert(outputs.size() >= static_cast<std::size_t>(outputCount()));
    if (count) evaluateRange(*nodes_, variables, parameters, outputs, 0, count);
}

void FormulaGraph::evaluateParallel(std::span<const double* const> variables, std::span<const double> parameters,
                                    std::span<double* const> outputs, std::size_t count) const {
    constexpr std::size_t kGrain = 32 * kFormulaBlock;
    parallelFor(count, kGrain, [&](std::size_t begin, std::size_t end) {
        evaluateRange(*nodes_, variables, parameters, outputs, begin, end);
    });
}

}  // namespace voledit
