// GLSL functions of spatial objects.

#include <array>
#include <glm/common.hpp>

#include "core/fields/value_bricks.h"
#include "core/stf/mesh_field.h"
#include "core/stf/source_solid.h"
#include "render/slice_plan.h"
#include "render/term_writer.h"
#include "render/visibility.h"

namespace voledit {

namespace {

std::string nameOf(CvgOperator by) {
    static const std::array<std::string, 7> names{"Union", "Intersection", "Difference", "Merge",
                                                  "Cap",   "Trim",         "Blend"};
    return "cvg" + names[std::size_t(by)];
}
std::string nameOf(Combine by) {
    static const std::array<std::string, 4> names{"Union", "Merge", "Intersection", "First"};
    return "combine" + names[std::size_t(by)];
}
std::string nameOf(Interpolation by) {
    static const std::array<std::string, 3> names{"linear", "nearest", "cubic"};
    return names[std::size_t(by)];
}

/// Writes the body of one term's function.
class TermBody {
public:
    TermBody(TermWriter& writer, bool lit, const std::string& attribute, GlslBody& body)
        : writer_(writer), lit_(lit), attribute_(attribute), body_(body) {}

    void operator()(const VolumeTerm& node) {
        int scale = 0;
        const std::string grid = writer_.volume(node.volume, node.channel, scale), kind = nameOf(node.interpolation);
        const std::string matrix = glslText(writer_.matrix(writer_.fromLocal(node.volume->indexFromWorld())));
        const std::string arguments = "(" + grid + ", " + glslText(scale) + ", index)";
        body_ << "vec3 index = placed(" + matrix + ", p);"
              << "float value = " + kind + "Value" + arguments + ";";
        const auto [low, high] = finiteRange(node.volume->bricks(node.channel));
        classify(node.appearance, {low, high}, "turned(" + matrix + ", " + kind + "Gradient" + arguments + ")");
    }

    void operator()(const MeshTerm& node) {
        const GlslFunction field = writeField(writer_, node.field, true);
        body_ << "vec4 at = " + body_.call(field) + "(p);"
              << "float value = at.w;";
        classify(node.appearance, node.field->mesh()->range(node.field->channel()), "at.xyz");
    }

    void operator()(const SolidTerm& node) {
        const GlslFunction distance = writeField(writer_, node.distance, lit_);
        int base = 0;
        const GlslFunction opacity = writer_.formula(node.opacity, node.parameters, base);
        const std::string solid = glslText(writer_.group(glm::clamp(node.color, 0.0, 1.0), node.falloff));
        const std::string center = glslText(writer_.group(node.center - writer_.originPoint()));
        const std::string call = body_.call(distance) + "(p);";
        body_ << (lit_ ? "vec4 field = " + call : "float field = " + call)
              << "float d = solidDistance(" + glslText(writer_.box(node.shape)) + ", p, field" + (lit_ ? ".w);" : ");")
              << "vec3 x = p + quad(" + glslText(writer_.origin()) + ").xyz;"
              << "float o[1];"
              << body_.call(opacity) + "(" + glslText(base) + ", float[5](x.x, x.y, x.z, distance(p, quad(" + center +
                     ").xyz), d), o);"
              << "Sample s = solidSample(" + solid + ", d, o[0]);";
        if (lit_) body_ << "s.gradient = isNan(s.depth) ? vec3(0.0) : -field.xyz;";
        body_ << "return s;";
    }

    void operator()(const FieldsTerm& node) {
        static const std::array<std::string, 3> names{"r", "g", "b"};
        const GlslFunction opacity = writeField(writer_, node.opacity, lit_);
        body_ << (lit_ ? "vec4 opacity = " : "float opacity = ") + body_.call(opacity) + "(p);";
        for (std::size_t c = 0; c < 3; ++c)
            body_ << "float " + names[c] + " = " + body_.call(writeField(writer_, node.color[c], false)) + "(p);";
        body_ << "bool inside = withinBox(" + glslText(writer_.box(node.box)) + ", p);"
              << "Sample s = fieldsSample(inside, opacity" + std::string(lit_ ? ".w" : "") + ", vec3(r, g, b));";
        if (lit_) body_ << "s.gradient = s.opacity > 0.0 ? opacity.xyz : vec3(0.0);";
        const auto named = node.attributes.find(attribute_);
        if (named != node.attributes.end())
            body_ << "s.value = inside ? " + body_.call(writeField(writer_, named->second, false)) +
                         "(p) : undefinedValue();";
        body_ << "return s;";
    }

    void operator()(const CvgTerm& node) {
        body_ << "Sample s = " + call(node.of.front()) + "(p);";
        if (node.weight) body_ << "float w = " + body_.call(writeField(writer_, node.weight, false)) + "(p);";
        for (const TermPtr& of : std::span(node.of).subspan(1))
            body_ << "s = " + nameOf(node.by) + "(s, " + call(of) + "(p)" + (node.weight ? ", w);" : ");");
        body_ << "return s;";
    }

    void operator()(const RecolorTerm& node) {
        const std::string own = ownAttribute(node.from);
        const GlslFunction of = writeTerm(writer_, node.of, lit_, own.empty() ? node.from : attribute_);
        const std::string table =
            glslText(writer_.table(node.color.value_or(ColorTable{}), node.opacity.value_or(PiecewiseLinear{})));
        body_ << "Sample s = " + body_.call(of) + "(p);"
              << "recolor(" + table + ", " + glslText(node.color.has_value()) + ", " +
                     glslText(node.opacity.has_value()) + ", " + (own.empty() ? "s.value" : "s." + own) + ", s);";
        if (!attribute_.empty() && own.empty() && attribute_ != node.from)
            body_ << "s.value = " + body_.call(writeTerm(writer_, node.of, false, attribute_)) + "(p).value;";
        body_ << "return s;";
    }

    void operator()(const TransferTerm& node) {
        if (node.by->cells() && node.by->cells()->mayOverlap()) return folded(node);
        const GlslFunction map = writeMap(writer_, node.by, lit_);
        body_ << "vec3 q;";
        if (lit_) body_ << "mat3 j;";
        body_ << "bool defined = " + body_.call(map) + (lit_ ? "(p, q, j);" : "(p, q);")
              << "Sample s = " + call(node.of) + "(q);";
        if (lit_) body_ << "s.gradient = turnedBack(j, s.gradient);";
        body_ << "if (!defined) s = emptySample();"
              << "return s;";
    }

private:
    std::string call(const TermPtr& of) { return body_.call(writeTerm(writer_, of, lit_, attribute_)); }

    /// `value` through a transfer function; `gradient` is an expression.
    void classify(const TransferFunction& look, const Interval& values, const std::string& gradient) {
        const std::string table = glslText(writer_.table(look.color, look.opacity, values));
        const bool steepnessCounts = !look.gradientOpacity.points.empty();
        body_ << "Sample s = classified(" + table + ", value);";
        if (lit_ || steepnessCounts) body_ << "vec3 gradient = " + gradient + ";";
        if (steepnessCounts)
            body_ << "fadeBySteepness(" + glslText(writer_.table({}, look.gradientOpacity)) + ", gradient, s);";
        if (lit_) body_ << "s.gradient = s.opacity > 0.0 && isPoint(gradient) ? gradient : vec3(0.0);";
        if (attribute_ != "scalar") body_ << "s.value = undefinedValue();";
        body_ << "return s;";
    }

    /// All pre-images of a point: the operand at each, in one loop, so that compilers put it in place once.
    void folded(const TransferTerm& node) {
        const TermWriter::Cells cells = writer_.cells(node.by);
        const Vec3 sources = sourceBox(*node.by->cells()).size();
        const double reach = glm::max(glm::max(sources.x, sources.y), sources.z);
        const std::string slack = glslText(writer_.group(Vec4(4e-6 * reach, 0, 0, 0)));
        const GlslFunction of = writeTerm(writer_, node.of, lit_, attribute_);
        const bool keep = node.by->outside() == Outside::Keep;
        body_ << "PreImages found;"
              << "findPreImages(" + cells.arguments + ", " + slack + ", p, found);"
              << "Combined c = firstPreImage(emptySample());"
              << "bool kept = " + glslText(keep) + " && found.count == 0;"
              << "int count = kept ? 1 : found.count;"
              << "for (int n = 0; n < count; ++n) {"
              << "    vec3 q = kept ? p : found.source[n];"
              << "    Sample s = " + body_.call(of) + "(q);";
        if (lit_)
            body_ << "    mat3 j = mat3(1.0);"
                  << "    if (!kept) j = jacobianIn(found.tetrahedron[n], found.weight[n]);"
                  << "    s.gradient = turnedBack(j, s.gradient);";
        body_ << "    if (n == 0) {"
              << "        c = firstPreImage(s);"
              << "    } else {"
              << "        c = " + nameOf(node.combine) + "(c, s);"
              << "    }"
              << "}"
              << "return c.result;";
    }

    TermWriter& writer_;
    bool lit_;
    const std::string& attribute_;
    GlslBody& body_;
};

}  // namespace

std::string ownAttribute(const std::string& name) {
    if (name == "opacity") return name;
    if (name == "r" || name == "g" || name == "b") return "color." + name;
    return "";
}

GlslFunction writeTerm(TermWriter& writer, const TermPtr& term, bool lit, const std::string& attribute) {
    return writer.function({term.get(), lit, attribute}, "Sample NAME(vec3 p)",
                           [&](GlslBody& body) { std::visit(TermBody(writer, lit, attribute, body), term->node); });
}

}  // namespace voledit
