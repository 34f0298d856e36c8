#include "core/objects/combine.h"

#include "core/objects/cvg.h"

namespace voledit {

namespace {

CvgOperator operatorOf(Combine by) {
    return by == Combine::Merge          ? CvgOperator::Merge
           : by == Combine::Intersection ? CvgOperator::Intersection
                                         : CvgOperator::Union;
}

bool hasValue(const ObjectSample& s) {
    return s.value == s.value;
}

}  // namespace

ObjectSample combined(std::span<const ObjectSample> preImages, Combine by) {
    if (preImages.empty()) return {};
    ObjectSample result = preImages.front();
    const ObjectSample *largest = &preImages.front(), *smallest = largest, *scalar = largest;
    for (const ObjectSample& s : preImages.subspan(1)) {
        if (by != Combine::First) result = cvg(operatorOf(by), result, s);
        if (s.opacity > scalar->opacity || (s.opacity == scalar->opacity && hasValue(s) && !hasValue(*scalar)))
            scalar = &s;
        if (s.opacity > largest->opacity) largest = &s;
        if (s.opacity < smallest->opacity) smallest = &s;
    }
    // Of all pre-images at once: a sum of two need not outdo the third.
    result.value = scalar->value;
    if (by == Combine::Union || by == Combine::Merge) result.normalGradient = largest->normalGradient;
    if (by == Combine::Intersection) result.normalGradient = smallest->normalGradient;
    return result;
}

}  // namespace voledit
