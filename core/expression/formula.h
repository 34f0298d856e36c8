#pragma once
// The formula language: text → one graph of scalar operations → values, GLSL, derivatives, bounds (scene-format.md §1,
// "Formulas"). The grammar and every function's definition stand in README.md.

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/interval.h"
#include "core/base/types.h"

namespace voledit {

/// A mistake in a formula. what(): the file or place, line and column, cause and remedy, then the source line and a
/// caret below the mistake, on lines of their own.
class FormulaError : public Error {
public:
    FormulaError(const std::string& message, int line, int column) : Error(message), line_(line), column_(column) {}
    int line() const { return line_; }      // counted from 1
    int column() const { return column_; }  // in characters, counted from 1

private:
    int line_, column_;
};

/// A name that formulas may use, a number (width 1) or a vector (width 3).
struct FormulaSymbol {
    std::string name;
    int width = 1;
    bool operator==(const FormulaSymbol&) const = default;
};

/// What names mean. `pi` and `e` are always there.
struct FormulaSymbols {
    std::vector<FormulaSymbol> variables;   // differ from point to point; a vector takes three slots in a row
    std::vector<FormulaSymbol> parameters;  // the same for all points of a call; slots as for variables
    std::map<std::string, std::vector<double>> constants;  // one or three numbers, folded into the graph
};

/// A formula's text and where it stands, for errors.
struct FormulaText {
    std::string text;
    std::string where;         // file, or file and JSON pointer; may be empty
    int line = 1, column = 1;  // of the text's first character in that file; 1, 1 for a text by itself
};

/// What a formula must give.
enum class FormulaType : std::uint8_t { Number, Vector, Condition };

struct FormulaOutput {
    FormulaText formula;
    FormulaType type = FormulaType::Number;  // a vector makes three outputs, a condition one of 0 or 1
};

/// `let name = formula`, in order; each may use those before it.
struct FormulaLet {
    std::string name;
    FormulaText formula;
};

/// How large formulas may be; beyond it is a FormulaError.
inline constexpr std::size_t kLongestFormula = 100'000;   // characters
inline constexpr std::size_t kDeepestFormula = 200;       // levels of brackets, calls and unary signs
inline constexpr std::size_t kMostFormulaNodes = 20'000;  // scalar operations of a graph, before derivatives

/// GLSL of a graph. `text` defines one function
///   void NAME(const int base, const float v[VARIABLES], out float o[OUTPUTS])
/// (arrays of at least one element) which reads uniform number k as `formulaUniform(base + k)`, a function that the
/// surrounding program defines, and calls only functions of shaders/common/formula.glsl. Undefined results are NaN
/// (bit pattern tests: `formulaIsNaN`).
struct FormulaGlsl {
    std::string text;
    int uniforms = 0;
};

/// A compiled set of formulas: outputs as a graph of scalar operations over variables and parameters, constants folded,
/// equal sub-terms shared. Immutable; copies share. Division by zero, roots and logarithms of negative numbers give
/// infinities and NaN as IEEE has them.
class FormulaGraph {
public:
    /// Parses, checks and lowers. Throws FormulaError.
    FormulaGraph(const std::vector<FormulaLet>& lets, const std::vector<FormulaOutput>& outputs,
                 const FormulaSymbols& symbols);

    int variableCount() const;   // slots
    int parameterCount() const;  // slots
    int outputCount() const;     // numbers

    /// outputs[o][i] = output o at point i, from variables[v][i]. Each pointer is to `count` numbers; outputs must not
    /// alias variables. Runs in the calling thread, in blocks; safe from many threads.
    void evaluate(std::span<const double* const> variables, std::span<const double> parameters,
                  std::span<double* const> outputs, std::size_t count) const;
    /// The same over all cores, for large counts.
    void evaluateParallel(std::span<const double* const> variables, std::span<const double> parameters,
                          std::span<double* const> outputs, std::size_t count) const;

    /// A graph of this one's outputs followed by derivatives: number outputCount() + o · |by| + n is d output o /
    /// d variable slot by[n], by forward differentiation: exact where the formula is smooth, one-sided at kinks, 0
    /// through conditions and steps.
    FormulaGraph withDerivatives(std::span<const int> by) const;

    /// Bounds of every output for variables within the given intervals: the true range lies within. Infinite where
    /// nothing better is known.
    std::vector<Interval> bounds(std::span<const Interval> variables, std::span<const double> parameters) const;

    /// Depends on the graph alone, not on the values of parameters: what does not vary from point to point is computed
    /// by `glslUniforms` in double precision and comes as uniforms.
    FormulaGlsl glsl(const std::string& name) const;
    /// The uniforms of `glsl`, in order.
    std::vector<double> glslUniforms(std::span<const double> parameters) const;

    /// True if output o is the same for all points, whatever the parameters.
    bool isConstant(int output) const;

    /// Equal graphs compute the same by the same operations; used to share programs.
    bool operator==(const FormulaGraph& other) const;

    struct Nodes;  // formula_graph.h

private:
    explicit FormulaGraph(std::shared_ptr<const Nodes> nodes) : nodes_(std::move(nodes)) {}
    std::shared_ptr<const Nodes> nodes_;
};

/// `text` printed back from its syntax tree, in one canonical spelling with the fewest brackets; parsing it again gives
/// the same tree. Throws FormulaError.
std::string printedFormula(const FormulaText& text);

}  // namespace voledit
