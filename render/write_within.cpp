// GLSL functions that tell where data end: what cut faces are the boundary of (core/objects/seen_part).

#include "core/objects/seen_part.h"
#include "core/stf/mesh_field.h"
#include "render/term_writer.h"

namespace voledit {

namespace {

/// Tells these functions from those of samples.
const std::string kWithin = "\nwithin";

class WithinBody {
public:
    WithinBody(TermWriter& writer, const TermPtr& term, GlslBody& body) : writer_(writer), term_(term), body_(body) {}

    void operator()(const VolumeTerm& node) {
        int scale = 0;
        const std::string grid = writer_.volume(node.volume, node.channel, scale);
        const int matrix = writer_.matrix(writer_.fromLocal(node.volume->indexFromWorld()));
        body_ << "return insideGrid(" + grid + ", placed(" + glslText(matrix) + ", p));";
    }
    void operator()(const MeshTerm& node) {
        body_ << "return !isNan(" + body_.call(writeField(writer_, node.field, true)) + "(p).w);";
    }
    void operator()(const SolidTerm&) { body_ << "return " + opacityOf(term_) + " > 0.0;"; }
    void operator()(const FieldsTerm& node) {
        body_ << "return withinBox(" + glslText(writer_.box(node.box)) + ", p);";
    }
    void operator()(const RecolorTerm& node) { body_ << "return " + within(node.of) + ";"; }
    void operator()(const TransferTerm& node) {
        body_ << "vec3 q;"
              << "bool defined = " + body_.call(writeMap(writer_, node.by, false)) + "(p, q);"
              << "return " + body_.call(writeWithin(writer_, node.of)) + "(q) && defined;";
    }
    void operator()(const CvgTerm& node) {
        if (operandsJoin(node.by)) {
            body_ << "bool any = false;";
            for (const TermPtr& of : node.of) body_ << "any = " + within(of) + " || any;";
            body_ << "return any;";
            return;
        }
        const std::size_t cut = operandThatIsCut(node);
        body_ << "bool all = " + within(node.of[cut]) + ";";
        for (std::size_t n = 0; n < node.of.size(); ++n) {
            if (n == cut || holdsData(*node.of[n])) continue;
            body_ << "all = all && " + opacityOf(node.of[n]) + (leavesItsInside(node, n) ? " > 0.0;" : " <= 0.0;");
        }
        body_ << "return all;";
    }

private:
    std::string within(const TermPtr& of) { return body_.call(writeWithin(writer_, of)) + "(p)"; }
    std::string opacityOf(const TermPtr& of) { return body_.call(writeTerm(writer_, of, false)) + "(p).opacity"; }

    TermWriter& writer_;
    const TermPtr& term_;
    GlslBody& body_;
};

}  // namespace

GlslFunction writeWithin(TermWriter& writer, const TermPtr& term) {
    return writer.function({term.get(), false, kWithin}, "bool NAME(vec3 p)",
                           [&](GlslBody& body) { std::visit(WithinBody(writer, term, body), term->node); });
}

}  // namespace voledit
