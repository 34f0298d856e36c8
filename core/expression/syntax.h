#pragma once
// Formulas as syntax trees. Internal to core/expression; the grammar stands in README.md.

#include <array>
#include <string>
#include <vector>

#include "core/expression/formula.h"

namespace voledit {

/// What a token or a node of the tree is.
enum class Syntax : std::uint8_t {
    // tree and token
    Number,
    Name,
    // operators with one operand
    Minus,
    Not,
    Member,  // .x .y .z: `component`
    // operators with two operands
    Or,
    And,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Index,  // v[k]
    // any number of operands
    Call,
    Vector,  // [a, b, c]
};

struct SyntaxNode {
    Syntax kind = Syntax::Number;
    double number = 0;
    std::string name{};           // of a name or a call
    int component = 0;            // of a member
    std::vector<int> operands{};  // numbers of earlier nodes
    std::size_t offset = 0;       // bytes into the text, for errors

    /// Offsets apart.
    bool operator==(const SyntaxNode& o) const;
};

/// `let name = node`.
struct SyntaxLet {
    std::string name{};
    int node = -1;
    std::size_t offset = 0;

    bool operator==(const SyntaxLet& o) const { return name == o.name && node == o.node; }
};

/// Nodes in order, each operand before its use: whoever walks the tree needs no recursion, however deep it is.
struct SyntaxTree {
    std::vector<SyntaxNode> nodes;
    std::vector<SyntaxLet> lets;  // in order
    int root = -1;

    bool operator==(const SyntaxTree&) const = default;
};

/// Throws FormulaError.
SyntaxTree parsedFormula(const FormulaText& text);
/// The canonical spelling of a tree.
std::string printed(const SyntaxTree& tree);

/// The error for a mistake `offset` bytes into `text`: place, cause, the line and a caret.
FormulaError formulaError(const FormulaText& text, std::size_t offset, const std::string& cause);

}  // namespace voledit
