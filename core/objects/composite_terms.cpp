// Terms over other terms: transfers, CVG operators, recolouring.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "core/objects/combine.h"
#include "core/objects/cvg.h"
#include "core/objects/evaluation.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {

/// Jᵀ∇; 0 where the Jacobian has no finite answer.
Vec3 turned(const Mat3& jacobian, const Vec3& gradient) {
    const Vec3 result = glm::transpose(jacobian) * gradient;
    return std::isfinite(result.x + result.y + result.z) ? result : Vec3(0);
}

/// Several pre-images for a point: all of them are evaluated, then combined.
void evaluateFolded(const TransferTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                    const Asked& asked) {
    const MappedCells& cells = *node.by->cells();
    std::vector<CellLocation> found;
    std::vector<std::size_t> ends;
    std::vector<Vec3> q;
    std::vector<Mat3> jacobian;
    CellLocation alone{};
    std::uint32_t hint = 0;
    for (const Vec3& point : p) {
        found.clear();
        if (cells.cellCount() > 0 && cells.locateAlone(point, hint, alone))
            found.push_back(alone);
        else
            cells.locateAll(point, found);
        if (!found.empty()) hint = found.front().tetrahedron;
        for (const CellLocation& at : found) {
            q.push_back(cells.sourceAt(at));
            if (asked.gradient) jacobian.push_back(cells.jacobianAt(at));
        }
        if (found.empty() && node.by->outside() == Outside::Keep) {
            q.push_back(point);
            if (asked.gradient) jacobian.push_back(Mat3(1.0));
        }
        ends.push_back(q.size());
    }
    std::vector<ObjectSample> all(q.size());
    for (std::size_t start = 0; start < q.size(); start += kBlock) {
        const std::size_t count = std::min(kBlock, q.size() - start);
        evaluate(*node.of, std::span(q).subspan(start, count), std::span(all).subspan(start, count), asked);
    }
    for (std::size_t n = 0; n < all.size() && asked.gradient; ++n)
        all[n].normalGradient = turned(jacobian[n], all[n].normalGradient);
    std::size_t begin = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        sample[i] = combined(std::span(all).subspan(begin, ends[i] - begin), node.combine);
        begin = ends[i];
    }
}

/// True if a term's operand n > 0 makes no difference where what stands left of it has opacity 0.
bool needsVisibleFirst(CvgOperator by, const Asked& asked) {
    // The depth of all operands counts for an operator above; an intersection's scalar and colour there may be the
    // second's, if anyone asks.
    if (asked.depth) return false;
    return by == CvgOperator::Difference || by == CvgOperator::Cap || by == CvgOperator::Trim ||
           (by == CvgOperator::Intersection && !asked.attribute && !asked.colorEverywhere);
}

/// True for operators that lay bare surfaces of solids.
bool needsDepth(CvgOperator by) {
    return by == CvgOperator::Difference || by == CvgOperator::Cap || by == CvgOperator::Intersection;
}

}  // namespace

void evaluateTransfer(const TransferTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                      const Asked& asked) {
    if (node.by->cells() && node.by->cells()->mayOverlap()) return evaluateFolded(node, p, sample, asked);
    std::vector<Vec3> q(p.size());
    node.by->map(p, q);
    evaluate(*node.of, q, sample, asked);
    if (!asked.gradient) return;
    std::vector<std::uint32_t> lit;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (sample[i].normalGradient != Vec3(0)) lit.push_back(std::uint32_t(i));
    const std::vector<Vec3> at = gathered(p, lit);
    std::vector<Mat3> jacobian(at.size());
    node.by->jacobian(at, jacobian);
    for (std::size_t n = 0; n < lit.size(); ++n) {
        Vec3& gradient = sample[lit[n]].normalGradient;
        gradient = turned(jacobian[n], gradient);
    }
}

void evaluateCvg(const CvgTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample, const Asked& asked) {
    Asked ofOperands = asked;
    ofOperands.depth = asked.depth || (asked.gradient && needsDepth(node.by));
    evaluate(*node.of.front(), p, sample, ofOperands);
    std::vector<double> weight(node.by == CvgOperator::Blend ? p.size() : 0);
    if (node.by == CvgOperator::Blend) node.weight->sample(p, weight);
    std::vector<std::uint32_t> which;
    std::vector<ObjectSample> other;
    for (std::size_t operand = 1; operand < node.of.size(); ++operand) {
        const bool visibleOnly = needsVisibleFirst(node.by, asked);
        which.clear();
        for (std::size_t i = 0; i < p.size(); ++i)
            if (!visibleOnly || sample[i].opacity > 0) which.push_back(std::uint32_t(i));
        if (which.empty()) return;
        other.resize(which.size());
        if (which.size() == p.size())
            evaluate(*node.of[operand], p, other, ofOperands);
        else
            evaluate(*node.of[operand], gathered(p, which), other, ofOperands);
        for (std::size_t n = 0; n < which.size(); ++n) {
            ObjectSample& s = sample[which[n]];
            s = cvg(node.by, s, other[n], weight.empty() ? 0 : weight[n]);
        }
    }
}

void evaluateRecolor(const RecolorTerm& node, std::span<const Vec3> p, std::span<ObjectSample> sample,
                     const Asked& asked) {
    const bool own = ownAttribute(node.from, {}).has_value();
    Asked ofOperand = asked;
    if (!own) ofOperand.attribute = &node.from;
    evaluate(*node.of, p, sample, ofOperand);
    for (ObjectSample& s : sample) {
        const double from = ownAttribute(node.from, s).value_or(s.value);
        if (!(s.opacity > 0) || from != from) continue;
        if (node.color) s.color = glm::clamp((*node.color)(from), 0.0, 1.0);
        if (node.opacity) s.opacity = clampedOpacity((*node.opacity)(from));
    }
    if (!asked.attribute || own || *asked.attribute == node.from) return;
    std::vector<ObjectSample> other(p.size());
    evaluate(*node.of, p, other, {.attribute = asked.attribute});
    for (std::size_t i = 0; i < p.size(); ++i) sample[i].value = other[i].value;
}

}  // namespace voledit
