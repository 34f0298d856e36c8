#include "core/objects/term.h"

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "core/objects/combine.h"
#include "core/objects/term_cache.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {

constexpr std::size_t kBlock = 1024;  // points evaluated together: what a level keeps stays in the cache

void evaluate(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, bool withGradient);

/// Gradients of the points of `wanted` (indices into q), in their order.
std::vector<Vec3> gradientsAt(const VolumeTerm& node, std::span<const Vec3> q, std::span<const std::uint32_t> wanted) {
    std::vector<Vec3> at, gradient(wanted.size());
    at.reserve(wanted.size());
    for (const std::uint32_t i : wanted) at.push_back(q[i]);
    node.volume->gradient(at, gradient, node.channel);
    return gradient;
}

void evaluateVolume(const VolumeTerm& node, std::span<const Vec3> q, std::span<ObjectSample> sample,
                    bool withGradient) {
    std::vector<double> value(q.size());
    std::vector<std::uint32_t> visible;
    node.volume->sample(q, value, node.channel);
    for (std::size_t i = 0; i < q.size(); ++i) {
        sample[i] = ObjectSample{.value = value[i]};
        if (value[i] != value[i]) continue;
        sample[i].opacity = std::clamp(node.appearance.opacity(value[i]), 0.0, 1.0);
        if (sample[i].opacity > 0) visible.push_back(std::uint32_t(i));
    }
    const bool steepnessCounts = !node.appearance.gradientOpacity.points.empty();
    const auto gradient = withGradient || steepnessCounts ? gradientsAt(node, q, visible) : std::vector<Vec3>{};
    for (std::size_t n = 0; n < visible.size(); ++n) {
        ObjectSample& s = sample[visible[n]];
        s.color = node.appearance.color(s.value);
        if (withGradient) s.normalGradient = gradient[n];
        if (steepnessCounts)
            s.opacity = std::clamp(s.opacity * node.appearance.gradientOpacity(glm::length(gradient[n])), 0.0, 1.0);
    }
}

/// Several pre-images for a point: all of them are evaluated, then combined.
void evaluateFolded(const TransferTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                    bool withGradient) {
    const MappedCells& cells = *node.by->cells();
    std::vector<CellLocation> found;
    std::vector<std::size_t> ends;
    std::vector<Vec3> q;
    std::vector<Mat3> jacobian;
    for (const Vec3& point : p) {
        found.clear();
        cells.locateAll(point, found);
        for (const CellLocation& at : found) {
            q.push_back(cells.sourceAt(at));
            if (withGradient) jacobian.push_back(cells.jacobianAt(at));
        }
        if (found.empty() && node.by->outside() == Outside::Keep) {
            q.push_back(point);
            if (withGradient) jacobian.push_back(Mat3(1.0));
        }
        ends.push_back(q.size());
    }
    std::vector<ObjectSample> all(q.size());
    for (std::size_t start = 0; start < q.size(); start += kBlock) {
        const std::size_t count = std::min(kBlock, q.size() - start);
        evaluate(*node.of, std::span(q).subspan(start, count), std::span(all).subspan(start, count), withGradient);
    }
    for (std::size_t n = 0; n < all.size() && withGradient; ++n)
        all[n].normalGradient = glm::transpose(jacobian[n]) * all[n].normalGradient;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        sample[i] = combined(std::span(all).subspan(begin, ends[i] - begin), node.combine);
        begin = ends[i];
    }
}

void evaluateTransfer(const TransferTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                      bool withGradient) {
    if (node.by->cells() && node.by->cells()->mayOverlap()) return evaluateFolded(node, p, sample, withGradient);
    std::vector<Vec3> q(p.size());
    node.by->map(p, q);
    evaluate(*node.of, q, sample, withGradient);
    if (!withGradient) return;
    std::vector<std::uint32_t> lit;
    std::vector<Vec3> at;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (sample[i].normalGradient != Vec3(0)) {
            lit.push_back(std::uint32_t(i));
            at.push_back(p[i]);
        }
    std::vector<Mat3> jacobian(at.size());
    node.by->jacobian(at, jacobian);
    for (std::size_t n = 0; n < lit.size(); ++n)
        sample[lit[n]].normalGradient = glm::transpose(jacobian[n]) * sample[lit[n]].normalGradient;
}

void evaluate(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, bool withGradient) {
    if (const auto* volume = std::get_if<VolumeTerm>(&term.node))
        evaluateVolume(*volume, p, sample, withGradient);
    else
        evaluateTransfer(std::get<TransferTerm>(term.node), p, sample, withGradient);  // other kinds follow
}

}  // namespace

void sample(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, bool withGradient) {
    assert(p.size() == sample.size());
    for (std::size_t start = 0; start < p.size(); start += kBlock) {
        const std::size_t count = std::min(kBlock, p.size() - start);
        evaluate(term, p.subspan(start, count), sample.subspan(start, count), withGradient);
    }
}

TermPtr makeVolumeTerm(std::shared_ptr<const Volume> volume, int channel, TransferFunction appearance,
                       Interpolation interpolation) {
    const Box3 bounds = boundsOf(volume->grid().worldFrame());
    return std::make_shared<const Term>(
        Term{VolumeTerm{std::move(volume), channel, std::move(appearance), interpolation}, bounds,
             std::make_shared<const TermCache>()});
}

TermPtr makeTransferTerm(TransferPtr by, TermPtr of, Combine combine, std::string name, TransferRole role) {
    const Box3 bounds = by->imageOf(of->bounds);
    return std::make_shared<const Term>(Term{TransferTerm{std::move(by), std::move(of), combine, std::move(name), role},
                                             bounds, std::make_shared<const TermCache>()});
}

}  // namespace voledit
