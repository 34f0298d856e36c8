// GLSL functions of backward maps.

#include "core/stf/affine.h"
#include "core/stf/composite_maps.h"
#include "core/stf/field_maps.h"
#include "core/stf/formula_map.h"
#include "core/stf/mapped_cells.h"
#include "render/term_writer.h"

namespace voledit {

namespace {

class MapWriter final : public TransferVisitor {
public:
    MapWriter(TermWriter& writer, const TransferPtr& map, bool lit, GlslBody& body)
        : writer_(writer), map_(map), lit_(lit), body_(body) {}

    void visit(const AffineMap& map) override {
        const std::string matrix = glslText(writer_.matrix(writer_.between(*map.affine())));
        body_ << "q = placed(" + matrix + ", p);";
        if (lit_) body_ << "j = linearPart(" + matrix + ");";
        body_ << "return true;";
    }

    void visit(const FormulaMap& map) override {
        const FormulaGraph& graph = lit_ ? map.withDerivatives() : map.formula();
        const int outputs = map.formula().outputCount();
        int base = 0;
        const GlslFunction formula = writer_.formula(graph, map.parameters(), base);
        const std::string from = glslText(writer_.matrix(writer_.fromLocal(map.formulaFromWorld())));
        const std::string to = glslText(writer_.matrix(writer_.toLocal(map.worldFromFormula())));
        body_ << "vec3 u = placed(" + from + ", p);"
              << "float o[" + glslText(graph.outputCount()) + "];"
              << body_.call(formula) + "(" + glslText(base) + ", float[3](u.x, u.y, u.z), o);"
              << "vec3 given = vec3(o[0], o[1], o[2]);";
        const std::string condition = map.hasCondition() ? "o[3]" : "0.0";
        if (lit_) {
            std::string derivatives = "mat3(";
            for (int column = 0; column < 3; ++column)
                for (int row = 0; row < 3; ++row)
                    derivatives += "o[" + glslText(outputs + 3 * row + column) + (column + row == 4 ? "])" : "], ");
            body_ << "j = formulaJacobian(" + to + ", " + derivatives + ", " + from + ", isPoint(given) && " +
                         condition + " == 0.0);";
        }
        body_ << "return formulaMapped(" + to + ", given, " + condition + ", " +
                     glslText(map.outside() == Outside::Keep) + ", p, q);";
    }

    void visit(const FieldsMap& map) override {
        static const std::array<std::string, 3> names{"x", "y", "z"};
        for (std::size_t a = 0; a < 3; ++a) {
            const GlslFunction field = writeField(writer_, map.fields()[a], lit_);
            body_ << (lit_ ? "vec4 " : "float ") + names[a] + " = " + body_.call(field) + "(p);";
        }
        const std::string displacement = glslText(map.displacement());
        body_ << (lit_ ? "vec3 values = vec3(x.w, y.w, z.w);" : "vec3 values = vec3(x, y, z);");
        if (lit_) body_ << "j = rowsToJacobian(x.xyz, y.xyz, z.xyz, " + displacement + ", isPoint(values));";
        body_ << "return fieldsMapped(" + glslText(writer_.origin()) + ", values, " + displacement + ", " +
                     glslText(map.outside() == Outside::Keep) + ", p, q);";
    }

    void visit(const SequenceMap& map) override {
        body_ << "bool defined = true;"
              << "q = p;";
        if (lit_)
            body_ << "mat3 inner;"
                  << "j = mat3(1.0);";
        for (std::size_t n = map.of().size(); n-- > 0;) {
            const GlslFunction part = writeMap(writer_, map.of()[n], lit_);
            body_ << "defined = " + body_.call(part) + (lit_ ? "(q, q, inner)" : "(q, q)") + " && defined;";
            if (lit_) body_ << "j = inner * j;";
        }
        if (lit_) body_ << "if (!defined) j = mat3(1.0);";
        body_ << "return defined;";
    }

    void visit(const ScaledMap& map) override {
        weight(map.by());
        operand(map.of(), "defined", "q", "j");
        if (lit_) body_ << "j = scaledJacobian(k, gradient, defined, q - p, j);";
        body_ << "return scaledMapped(k, defined, p, q);";
    }

    void visit(const SumMap& map) override {
        body_ << "vec3 sum = vec3(0.0);"
              << "bool all = true;";
        declareOperand();
        if (lit_) body_ << "j = mat3(1.0);";
        for (const TransferPtr& of : map.of()) {
            operand(of, "", "at", "one");
            body_ << "sum += at - p;"
                  << "all = all && given;";
            if (lit_) body_ << "j += one - mat3(1.0);";
        }
        body_ << "q = p + sum;";
        if (lit_) body_ << "if (!all) j = mat3(1.0);";
        body_ << "return all;";
    }

    void visit(const ChosenMap& map) override {
        operand(map.of().front(), "all", "q", "j");
        declareOperand();
        for (const TransferPtr& of : std::span(map.of()).subspan(1)) {
            operand(of, "", "at", "one");
            body_ << "if (beats(" + glslText(map.choice() == ChosenMap::Choice::Larger) + ", p, at, q)) {"
                  << (lit_ ? "    j = one;" : "") << "    q = at;"
                  << "}"
                  << "all = all && given;";
        }
        if (lit_) body_ << "if (!all) j = mat3(1.0);";
        body_ << "return all;";
    }

    void visit(const BlendedMap& map) override {
        weight(map.weight());
        declareOperand();
        operand(map.first(), "defined", "q", "j");
        operand(map.second(), "", "at", "one");
        body_ << "defined = defined && given;";
        if (lit_) body_ << "j = blendedJacobian(k, gradient, defined, at - q, j, one);";
        body_ << "return blendedMapped(k, defined, at, q);";
    }

    void visitCells(const SpatialTransferFunction& map) override {
        const TermWriter::Cells cells = writer_.cells(map_);
        // Where pre-images lie upon each other the first counts, which the last one found need not be.
        if (map.cells()->mayOverlap()) body_ << cells.hint + " = kNowhere;";
        body_ << "return " + std::string(lit_ ? "litCellsMapped" : "cellsMapped") + "(" + cells.arguments + ", " +
                     glslText(map.outside() == Outside::Keep) + ", p, " + cells.hint + (lit_ ? ", q, j);" : ", q);");
    }

private:
    /// k, and its gradient.
    void weight(const FieldPtr& field) {
        const GlslFunction of = writeField(writer_, field, lit_);
        if (lit_)
            body_ << "vec4 weight = " + body_.call(of) + "(p);"
                  << "float k = weight.w;"
                  << "vec3 gradient = weight.xyz;";
        else
            body_ << "float k = " + body_.call(of) + "(p);";
    }
    void declareOperand() {
        body_ << "vec3 at;"
              << "bool given;";
        if (lit_) body_ << "mat3 one;";
    }
    /// What an operand gives at p, in `at`; whether it is defined in a new `defined`, or in `given`.
    void operand(const TransferPtr& of, const std::string& defined, const std::string& at,
                 const std::string& jacobian) {
        const GlslFunction map = writeMap(writer_, of, lit_);
        body_ << (defined.empty() ? "given" : "bool " + defined) + " = " + body_.call(map) + "(p, " + at +
                     (lit_ ? ", " + jacobian : "") + ");";
    }

    TermWriter& writer_;
    const TransferPtr& map_;
    bool lit_;
    GlslBody& body_;
};

}  // namespace

GlslFunction writeMap(TermWriter& writer, const TransferPtr& map, bool lit) {
    return writer.function({map.get(), lit, ""},
                           lit ? "bool NAME(vec3 p, out vec3 q, out mat3 j)" : "bool NAME(vec3 p, out vec3 q)",
                           [&](GlslBody& body) {
                               MapWriter visitor(writer, map, lit, body);
                               map->accept(visitor);
                           });
}

}  // namespace voledit
