// GLSL functions of scalar fields.

#include <glm/gtc/matrix_transform.hpp>

#include "core/fields/simple_fields.h"
#include "core/fields/text_field.h"
#include "core/objects/attribute_field.h"
#include "core/stf/component_field.h"
#include "core/stf/mesh_field.h"
#include "render/term_writer.h"

namespace voledit {

namespace {

class FieldWriter final : public FieldVisitor {
public:
    FieldWriter(TermWriter& writer, const FieldPtr& field, bool lit, GlslBody& body)
        : writer_(writer), field_(field), lit_(lit), body_(body) {}

    void visit(const ConstantField& field) override {
        const std::string value = "quad(" + glslText(writer_.group(Vec4(field.value(), 0, 0, 0))) + ").x";
        body_ << "return " + (lit_ ? "vec4(vec3(0.0), " + value + ")" : value) + ";";
    }

    void visit(const ExpressionField& field) override {
        int base = 0;
        const FormulaGraph& graph = lit_ ? field.withGradient() : field.formula();
        const GlslFunction formula = writer_.formula(graph, field.parameters(), base);
        body_ << "vec3 x = p + quad(" + glslText(writer_.origin()) + ").xyz;"
              << "float o[" + glslText(graph.outputCount()) + "];"
              << body_.call(formula) + "(" + glslText(base) + ", float[3](x.x, x.y, x.z), o);";
        if (lit_)
            body_ << "vec3 g = vec3(o[1], o[2], o[3]);"
                  << "return vec4(isNan(o[0]) || !isPoint(g) ? vec3(0.0) : g, o[0]);";
        else
            body_ << "return o[0];";
    }

    void visit(const VolumeField& field) override {
        int scale = 0;
        const std::string grid = writer_.volume(field.volume(), field.channel(), scale);
        const int matrix = writer_.matrix(writer_.fromLocal(field.volume()->indexFromWorld()));
        const std::string kind = nameOf(field.interpolation());
        const std::string arguments = "(" + grid + ", " + glslText(scale) + ", index)";
        body_ << "vec3 index = placed(" + glslText(matrix) + ", p);"
              << "float value = " + kind + "Value" + arguments + ";";
        if (lit_)
            body_ << "vec3 g = turned(" + glslText(matrix) + ", " + kind + "Gradient" + arguments + ");"
                  << "return vec4(isNan(value) || !isPoint(g) ? vec3(0.0) : g, value);";
        else
            body_ << "return value;";
    }

    void visit(const MapField& field) override {
        const GlslFunction of = writeField(writer_, field.of(), lit_);
        const std::string table = glslText(writer_.table({}, field.table()));
        if (lit_)
            body_ << "vec4 v = " + body_.call(of) + "(p);"
                  << "float slope = isNan(v.w) ? 0.0 : tableSlope(" + table + ", v.w);"
                  << "return vec4(slope * v.xyz, mapped(" + table + ", v.w));";
        else
            body_ << "return mapped(" + table + ", " + body_.call(of) + "(p));";
    }

    void visit(const TextField& field) override;

    void visit(const MeshField& field) override {
        const auto mesh = std::static_pointer_cast<const MeshField>(field_);
        (void)field;
        const TermWriter::Cells cells = writer_.cells(mesh);
        body_ << "vec4 v = meshAt(" + cells.arguments + ", p, " + cells.hint + ");"
              << (lit_ ? "return v.yzwx;" : "return v.x;");
    }

    void visit(const ComponentField& field) override {
        const GlslFunction map = writeMap(writer_, field.of(), lit_);
        const std::string axis = "[" + glslText(field.axis()) + "]";
        body_ << "vec3 q;";
        if (lit_) body_ << "mat3 j;";
        body_ << "bool defined = " + body_.call(map) + (lit_ ? "(p, q, j);" : "(p, q);");
        body_ << "float value = " +
                     (field.displacement() ? "q" + axis + " - p" + axis
                                           : "q" + axis + " + quad(" + glslText(writer_.origin()) + ")" + axis) +
                     ";"
              << "value = defined ? value : undefinedValue();";
        if (!lit_) {
            body_ << "return value;";
            return;
        }
        if (field.displacement()) body_ << "j -= mat3(1.0);";
        body_ << "vec3 g = vec3(j[0]" + axis + ", j[1]" + axis + ", j[2]" + axis + ");"
              << "return vec4(defined ? g : vec3(0.0), value);";
    }

    void visit(const AttributeField& field) override {
        const std::string own = ownAttribute(field.name());
        const GlslFunction of = writeTerm(writer_, field.of(), false, own.empty() ? field.name() : "");
        const std::string member = own.empty() ? "value" : own;
        if (!lit_) {
            body_ << "return " + body_.call(of) + "(p)." + member + ";";
            return;
        }
        // One loop, so that compilers put the object in place once.
        const std::string step = "quad(" + glslText(writer_.group(Vec4(field.step(), 0, 0, 0))) + ").x";
        body_ << "float at[7];"
              << "for (int n = 0; n < 7; ++n) {"
              << "    vec3 x = p;"
              << "    if (n > 0) x[(n - 1) / 2] += (n % 2 == 1 ? -1.0 : 1.0) * " + step + ";"
              << "    at[n] = " + body_.call(of) + "(x)." + member + ";"
              << "}"
              << "return vec4(slopeOf(at[1], at[0], at[2], " + step + "), slopeOf(at[3], at[0], at[4], " + step +
                     "), slopeOf(at[5], at[0], at[6], " + step + "), at[0]);";
    }

private:
    static std::string nameOf(Interpolation interpolation) {
        return interpolation == Interpolation::Linear    ? "linear"
               : interpolation == Interpolation::Nearest ? "nearest"
                                                         : "cubic";
    }

    TermWriter& writer_;
    const FieldPtr& field_;
    bool lit_;
    GlslBody& body_;
};

void FieldWriter::visit(const TextField& field) {
    int scale = 0;
    const std::string grid = writer_.volume(field.outline(), 0, scale);
    const Vec3 spacing = field.outline()->grid().spacing();
    const int matrix = writer_.matrix(writer_.fromLocal(field.outline()->indexFromWorld()));
    const int shape = writer_.group({spacing.x, 0.5 * field.depth(), spacing.z, writer_.originPoint().y});
    body_ << "return " + std::string(lit_ ? "litTextDistance" : "textDistance") + "(" + grid + ", " + glslText(scale) +
                 ", " + glslText(matrix) + ", " + glslText(shape) + ", p);";
}

}  // namespace

GlslFunction writeField(TermWriter& writer, const FieldPtr& field, bool lit) {
    return writer.function({field.get(), lit, ""}, lit ? "vec4 NAME(vec3 p)" : "float NAME(vec3 p)",
                           [&](GlslBody& body) {
                               FieldWriter visitor(writer, field, lit, body);
                               field->accept(visitor);
                           });
}

}  // namespace voledit
