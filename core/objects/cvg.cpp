#include "core/objects/cvg.h"

#include <algorithm>
#include <glm/common.hpp>

namespace voledit {

namespace {

bool hasValue(const ObjectSample& s) {
    return s.value == s.value;
}

bool hasDepth(const ObjectSample& s) {
    return s.depth == s.depth;
}

/// C₁ if O₁ ≥ O₂, else C₂.
Vec3 selected(const ObjectSample& a, const ObjectSample& b) {
    return a.opacity >= b.opacity ? a.color : b.color;
}

/// The two colours by weights; their mean where both are 0.
Vec3 mixed(const Vec3& a, double weightOfA, const Vec3& b, double weightOfB) {
    const double sum = weightOfA + weightOfB;
    return sum > 0 ? (weightOfA * a + weightOfB * b) / sum : 0.5 * (a + b);
}

/// The operand whose scalar counts.
double valueOfLarger(const ObjectSample& a, double opacityOfA, const ObjectSample& b, double opacityOfB) {
    const bool second = opacityOfB > opacityOfA || (opacityOfB == opacityOfA && hasValue(b) && !hasValue(a));
    return second ? b.value : a.value;
}

ObjectSample blended(const ObjectSample& a, const ObjectSample& b, double weight) {
    const double partOfA = (1 - weight) * a.opacity, partOfB = weight * b.opacity;
    const Vec3 color = mixed(a.color, partOfA, b.color, partOfB);
    if (!isDefined(color)) return {};
    return {clampedOpacity(partOfA + partOfB), glm::clamp(color, 0.0, 1.0), valueOfLarger(a, partOfA, b, partOfB),
            partOfB > partOfA ? b.normalGradient : a.normalGradient};
}

}  // namespace

ObjectSample cvg(CvgOperator by, const ObjectSample& a, const ObjectSample& b, double weight) {
    const double value = valueOfLarger(a, a.opacity, b, b.opacity);
    const bool solids = hasDepth(a) && hasDepth(b);
    const Vec3& ofLarger = b.opacity > a.opacity ? b.normalGradient : a.normalGradient;
    // Outside both, the nearer surface is the one that an operator above may lay bare.
    const bool nearerSecond = solids && a.opacity == 0 && b.opacity == 0 && b.depth > a.depth;
    const Vec3& ofShallower = b.depth < a.depth ? b.normalGradient : a.normalGradient;
    switch (by) {
        case CvgOperator::Union:
            return {std::max(a.opacity, b.opacity), selected(a, b), value, nearerSecond ? b.normalGradient : ofLarger,
                    solids ? std::max(a.depth, b.depth) : kNaN};
        case CvgOperator::Intersection:
            return {std::min(a.opacity, b.opacity), selected(a, b), value,
                    solids                  ? ofShallower
                    : b.opacity < a.opacity ? b.normalGradient
                                            : a.normalGradient,
                    solids ? std::min(a.depth, b.depth) : kNaN};
        case CvgOperator::Merge:
            return {std::min(1.0, a.opacity + b.opacity), mixed(a.color, a.opacity, b.color, b.opacity), value,
                    ofLarger};
        case CvgOperator::Difference: {
            const bool bare = solids ? -b.depth < a.depth : b.opacity > 0 && b.normalGradient != Vec3(0);
            return {std::max(0.0, a.opacity - b.opacity), a.color, a.value, bare ? -b.normalGradient : a.normalGradient,
                    solids ? std::min(a.depth, -b.depth) : kNaN};
        }
        case CvgOperator::Cap:
            return {a.opacity <= b.opacity ? a.opacity : 0, a.color, a.value, solids ? ofShallower : a.normalGradient,
                    solids ? std::min(a.depth, b.depth) : kNaN};
        case CvgOperator::Trim:
            return {a.opacity >= b.opacity ? a.opacity : 0, a.color, a.value, a.normalGradient, a.depth};
        case CvgOperator::Blend:
            break;
    }
    return blended(a, b, weight);
}

}  // namespace voledit
