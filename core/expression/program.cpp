#include "core/expression/program.h"

#include <algorithm>
#include <map>

#include "core/expression/formula_graph.h"

namespace voledit {

namespace {

using Kind = FormulaPlace::Kind;

/// Lays the nodes out one after the other, giving each a register that is free again after its last use.
class Layout {
public:
    explicit Layout(const FormulaGraph::Nodes& graph)
        : graph_(graph), place_(graph.nodes.size()), lastUse_(graph.nodes.size(), -1) {
        for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
            const FormulaNode& node = graph.nodes[n];
            if (graph.uniform[n])
                place_[n] = {Kind::Uniform, static_cast<int>(n)};
            else if (node.op == Op::Variable)
                place_[n] = {Kind::Variable, static_cast<int>(node.payload)};
            else if (node.op == Op::Sine || node.op == Op::Cosine)
                (node.op == Op::Sine ? sineOf_ : cosineOf_).emplace(node.in[0], static_cast<int>(n));
        }
        for (std::size_t n = 0; n < graph.nodes.size(); ++n)
            for (const int in : graph.nodes[n].in)
                if (in >= 0) lastUse_[index(in)] = std::max(lastUse_[index(in)], whenDone(static_cast<int>(n)));
    }

    FormulaProgram run() {
        placeOutputs();
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
            if (!graph_.uniform[n] && graph_.nodes[n].op != Op::Variable && !done(n)) addStep(static_cast<int>(n));
        return std::move(program_);
    }

private:
    static std::size_t index(int n) { return static_cast<std::size_t>(n); }
    bool done(std::size_t n) const { return n < isDone_.size() && isDone_[n]; }

    /// Sine and cosine of one operand are computed together, where the first of them stands: (sine, cosine).
    std::pair<int, int> pair(int n) const {
        const FormulaNode& node = graph_.nodes[index(n)];
        if (graph_.uniform[index(n)] || (node.op != Op::Sine && node.op != Op::Cosine)) return {n, -1};
        const auto sine = sineOf_.find(node.in[0]), cosine = cosineOf_.find(node.in[0]);
        if (sine == sineOf_.end() || cosine == cosineOf_.end()) return {n, -1};
        return {sine->second, cosine->second};
    }
    int whenDone(int n) const {
        const auto [first, second] = pair(n);
        return second < 0 ? n : std::min(first, second);
    }

    void placeOutputs() {
        for (std::size_t o = 0; o < graph_.outputs.size(); ++o) {
            FormulaPlace& place = place_[index(graph_.outputs[o])];
            if (place.kind != Kind::None)
                copy(static_cast<int>(o), place);
            else
                place = {Kind::Output, static_cast<int>(o)};
        }
        isDone_.assign(graph_.nodes.size(), 0);
    }

    void copy(int output, const FormulaPlace& from) {
        program_.copies.emplace_back(output, from);
        program_.hasUniforms = program_.hasUniforms || from.kind == Kind::Uniform;
    }

    void addStep(int n) {
        const FormulaNode& node = graph_.nodes[index(n)];
        FormulaStep step{.op = node.op, .payload = node.payload};
        const auto [result, cosine] = pair(n);
        if (cosine >= 0) step.op = Op::Sine;
        for (std::size_t i = 0; i < 3; ++i)
            if (node.in[i] >= 0) {
                step.in[i] = place_[index(node.in[i])];
                program_.hasUniforms = program_.hasUniforms || step.in[i].kind == Kind::Uniform;
            }
        // An operand's register may take the result: every step reads a point's operands before it writes there.
        for (std::size_t i = 0; i < 3; ++i)
            if (node.in[i] >= 0 && lastUse_[index(node.in[i])] <= n) release(place_[index(node.in[i])]);
        step.out = take(result);
        if (cosine >= 0) step.cosine = take(cosine);
        program_.steps.push_back(step);
    }

    FormulaPlace take(int n) {
        isDone_[index(n)] = 1;
        FormulaPlace& place = place_[index(n)];
        if (place.kind != Kind::None) return place;
        if (free_.empty()) {
            place = {Kind::Register, program_.registers++};
        } else {
            place = {Kind::Register, free_.back()};
            free_.pop_back();
        }
        return place;
    }

    void release(FormulaPlace& place) {
        if (place.kind != Kind::Register) return;
        free_.push_back(place.index);
        place.kind = Kind::None;
    }

    const FormulaGraph::Nodes& graph_;
    std::vector<FormulaPlace> place_;
    std::vector<int> lastUse_;
    std::vector<std::uint8_t> isDone_;
    std::map<int, int> sineOf_, cosineOf_;  // operand → node
    std::vector<int> free_;
    FormulaProgram program_;
};

}  // namespace

FormulaProgram makeProgram(const FormulaGraph::Nodes& graph) {
    return Layout(graph).run();
}

}  // namespace voledit
