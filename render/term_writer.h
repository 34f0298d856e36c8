#pragma once
// What writing a term program takes: numbers, resources, and functions, one for each node.

#include <functional>
#include <initializer_list>
#include <map>

#include "render/term_program.h"

namespace voledit {

/// A generated function.
struct GlslFunction {
    std::string name;
    std::size_t size = 0;  // statements with those of all it calls
};

/// Numbers and truths as GLSL spells them.
inline std::string glslText(int number) {
    return std::to_string(number);
}
inline std::string glslText(bool truth) {
    return truth ? "true" : "false";
}

/// Text of one function's body, and how large it is.
class GlslBody {
public:
    /// A line of text.
    GlslBody& operator<<(const std::string& line);
    /// The name of a function for a call, whose size is added.
    std::string call(const GlslFunction& function);

    const std::string& text() const { return text_; }
    std::size_t size() const { return size_; }

private:
    std::string text_;
    std::size_t size_ = 0;
};

/// Which function of a node is meant.
struct NodeKey {
    const void* node = nullptr;
    bool lit = false;       // with gradient or Jacobian
    std::string attribute;  // terms: `value` is this one; empty: none is asked for
    auto operator<=>(const NodeKey&) const = default;
};

/// Collects the parts of a TermProgram. Functions come in the order in which they are finished, so callees first.
class TermWriter {
public:
    explicit TermWriter(const TermPtr& root);

    /// The function of a node: written by `write`, which fills the body, if it was not before. `signature` has NAME for
    /// its name. Throws Error where the program becomes too large.
    GlslFunction function(const NodeKey& key, const std::string& signature,
                          const std::function<void(GlslBody&)>& write);
    /// The function of a formula's graph (FormulaGraph::glsl), and the group at which `parameters`' uniforms begin.
    GlslFunction formula(const FormulaGraph& graph, std::span<const double> parameters, int& base);

    /// Group of four numbers.
    int group(const Vec4& numbers);
    int group(const Vec3& xyz, double w = 0) { return group(Vec4(xyz, w)); }
    /// An affine matrix: three groups.
    int matrix(const Mat4& m);
    /// A box, less the origin: two groups.
    int box(const Box3& box);
    /// The origin itself.
    int origin();
    const Vec3& originPoint() const { return program_.origin; }
    /// `m` between world points as one between points less the origin, on the side(s) that are points of the term.
    Mat4 fromLocal(const Mat4& m) const;
    Mat4 toLocal(const Mat4& m) const;
    Mat4 between(const Mat4& m) const { return toLocal(fromLocal(m)); }

    /// Name of the sampler of a volume's channel; `scale` is set to its group.
    std::string volume(const std::shared_ptr<const Volume>& volume, int channel, int& scale);
    /// Group of a table. `node` tells it from others.
    int table(ColorTable color, PiecewiseLinear value, std::optional<Interval> range = std::nullopt);
    /// Cells: their number and grid's group, as the first arguments of functions of term/cells.glsl, and the name of
    /// their hint.
    struct Cells {
        std::string arguments, hint;
    };
    Cells cells(const TransferPtr& map);
    Cells cells(const std::shared_ptr<const MeshField>& mesh);

    /// The program, complete.
    TermProgram finish(const GlslFunction& term, const GlslFunction& lit, const GlslFunction& within);

private:
    Cells cells(const void* key, const ProgramCells& made);

    TermProgram program_;
    std::string formulas_, functions_;
    int named_ = 0, depth_ = 0, origin_ = -1;
    std::map<NodeKey, GlslFunction> written_;
    std::map<std::string, GlslFunction> formulaOf_;  // by text
    std::map<std::pair<const void*, bool>, int> cellsOf_;
};

/// An attribute that every object has ("opacity", "r", "g", "b") as a member of GLSL's Sample; empty for others.
std::string ownAttribute(const std::string& name);

/// Functions of nodes (write_terms.cpp, write_maps.cpp, write_fields.cpp):
///   `Sample NAME(vec3 p)`; lit: with the gradient
GlslFunction writeTerm(TermWriter& writer, const TermPtr& term, bool lit, const std::string& attribute = "");
///   `bool NAME(vec3 p)`: whether p is within data, seen or not (core/objects/seen_part); of several objects any
GlslFunction writeWithin(TermWriter& writer, const TermPtr& term);
///   `bool NAME(vec3 p, out vec3 q)`; lit: `bool NAME(vec3 p, out vec3 q, out mat3 j)`
GlslFunction writeMap(TermWriter& writer, const TransferPtr& map, bool lit);
///   `float NAME(vec3 p)`; lit: `vec4 NAME(vec3 p)`, the gradient and the value
GlslFunction writeField(TermWriter& writer, const FieldPtr& field, bool lit);

}  // namespace voledit
