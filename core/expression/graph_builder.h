#pragma once
// Grows a graph of scalar operations: equal nodes are one, constants are folded, identities that hold to the bit are
// used. Internal to core/expression.

#include <unordered_map>

#include "core/expression/formula_graph.h"

namespace voledit {

class GraphBuilder {
public:
    GraphBuilder() = default;
    /// Starts from the nodes of `graph`, which keep their numbers.
    explicit GraphBuilder(const std::vector<FormulaNode>& nodes);

    int constant(double value);
    int variable(int slot);
    int parameter(int slot);
    /// The node for `op` of existing nodes; may be one that computes the same.
    int make(Op op, int a, int b = -1, int c = -1, std::uint64_t payload = 0);
    /// x^n, with multiplications for a constant whole n of at most 16.
    int power(int x, int n);
    /// 1 where `a` is a number other than 0, else 0.
    int truth(int a);
    int noise(const std::array<int, 3>& point, const std::array<int, 3>& order);

    const std::vector<FormulaNode>& nodes() const { return nodes_; }
    const FormulaNode& node(int n) const { return nodes_[static_cast<std::size_t>(n)]; }
    bool isConstant(int n) const { return node(n).op == Op::Constant; }
    bool isConstant(int n, double value) const;  // this very number, also of its sign

private:
    struct Hash {
        std::size_t operator()(const FormulaNode& node) const;
    };
    int add(const FormulaNode& node);
    int simplified(const FormulaNode& node);  // −1: nothing simpler
    int simplifiedArithmetic(const FormulaNode& node);
    int simplifiedLogic(const FormulaNode& node);

    std::vector<FormulaNode> nodes_;
    std::unordered_map<FormulaNode, int, Hash> numbers_;
};

/// What the outputs need of the builder's nodes, renumbered, ready to be evaluated.
std::shared_ptr<const FormulaGraph::Nodes> finished(const GraphBuilder& builder, const std::vector<int>& outputs,
                                                    int variables, int parameters);

}  // namespace voledit
