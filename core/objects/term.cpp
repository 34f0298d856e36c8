#include "core/objects/term.h"

#include <algorithm>
#include <cassert>

#include "core/objects/evaluation.h"
#include "core/objects/term_cache.h"
#include "core/stf/mesh_field.h"

namespace voledit {

namespace {

TermPtr made(decltype(Term::node) node, const Box3& bounds) {
    return std::make_shared<const Term>(Term{std::move(node), bounds, std::make_shared<const TermCache>()});
}

Box3 boundsOf(const CvgTerm& node) {
    Box3 bounds = node.of.front()->bounds;
    for (const TermPtr& of : std::span(node.of).subspan(1)) {
        if (node.by == CvgOperator::Intersection)
            bounds = intersect(bounds, of->bounds);
        else if (node.by == CvgOperator::Union || node.by == CvgOperator::Merge || node.by == CvgOperator::Blend)
            bounds = join(bounds, of->bounds);
    }
    return bounds;
}

}  // namespace

std::optional<double> ownAttribute(const std::string& name, const ObjectSample& s) {
    if (name == "opacity") return s.opacity;
    if (name == "r") return s.color.r;
    if (name == "g") return s.color.g;
    if (name == "b") return s.color.b;
    return std::nullopt;
}

void evaluate(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked) {
    struct Evaluate {
        std::span<const Vec3> p;
        std::span<ObjectSample> sample;
        const Asked& asked;
        void operator()(const VolumeTerm& node) const { evaluateVolume(node, p, sample, asked); }
        void operator()(const TransferTerm& node) const { evaluateTransfer(node, p, sample, asked); }
        void operator()(const MeshTerm& node) const { evaluateMesh(node, p, sample, asked); }
        void operator()(const SolidTerm& node) const { evaluateSolid(node, p, sample, asked); }
        void operator()(const FieldsTerm& node) const { evaluateFields(node, p, sample, asked); }
        void operator()(const CvgTerm& node) const { evaluateCvg(node, p, sample, asked); }
        void operator()(const RecolorTerm& node) const { evaluateRecolor(node, p, sample, asked); }
    };
    std::visit(Evaluate{p, sample, asked}, term.node);
}

void sample(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, bool withGradient,
            const std::string& attribute) {
    assert(p.size() == sample.size());
    const bool own = ownAttribute(attribute, {}).has_value();
    const Asked asked{.gradient = withGradient,
                      .colorEverywhere = own && attribute != "opacity",
                      .attribute = own || attribute.empty() ? nullptr : &attribute};
    for (std::size_t start = 0; start < p.size(); start += kBlock) {
        const std::size_t count = std::min(kBlock, p.size() - start);
        evaluate(term, p.subspan(start, count), sample.subspan(start, count), asked);
    }
    if (own)
        for (std::size_t i = 0; i < p.size(); ++i)
            sample[i].value = isDefined(p[i]) ? *ownAttribute(attribute, sample[i]) : kNaN;
}

void sample(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> out, bool withGradient) {
    static const std::string kScalar = "scalar";
    sample(term, p, out, withGradient, kScalar);
}

TermPtr makeVolumeTerm(std::shared_ptr<const Volume> volume, int channel, TransferFunction appearance,
                       Interpolation interpolation) {
    const Box3 bounds = boundsOf(volume->grid().worldFrame());
    return made(VolumeTerm{std::move(volume), channel, std::move(appearance), interpolation}, bounds);
}

TermPtr makeMeshTerm(std::shared_ptr<const MeshField> field, TransferFunction appearance) {
    const Box3 bounds = field->domain();
    return made(MeshTerm{std::move(field), std::move(appearance)}, bounds);
}

TermPtr makeSolidTerm(SolidTerm solid) {
    assert(solid.opacity.outputCount() == 1 && solid.opacity.variableCount() == 5 && solid.falloff >= 0);
    const Box3 bounds{solid.shape.min - solid.falloff, solid.shape.max + solid.falloff};
    return made(std::move(solid), bounds);
}

TermPtr makeFieldsTerm(FieldsTerm fields) {
    const Box3 bounds = fields.box;
    return made(std::move(fields), bounds);
}

TermPtr makeCvgTerm(CvgOperator by, std::vector<TermPtr> of, FieldPtr weight) {
    assert(of.size() >= 2 && (by == CvgOperator::Blend) == (weight != nullptr));
    assert(by != CvgOperator::Blend || of.size() == 2);
    CvgTerm node{by, std::move(of), std::move(weight)};
    const Box3 bounds = boundsOf(node);
    return made(std::move(node), bounds);
}

TermPtr makeRecolorTerm(RecolorTerm recolor) {
    const Box3 bounds = recolor.of->bounds;
    return made(std::move(recolor), bounds);
}

TermPtr makeTransferTerm(TransferPtr by, TermPtr of, Combine combine, std::string name, TransferRole role) {
    const Box3 bounds = by->imageOf(of->bounds);
    return made(TransferTerm{std::move(by), std::move(of), combine, std::move(name), role}, bounds);
}

}  // namespace voledit
