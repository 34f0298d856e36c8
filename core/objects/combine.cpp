#include "core/objects/combine.h"

#include <algorithm>

namespace voledit {

namespace {

Vec3 selected(const ObjectSample& a, const ObjectSample& b) {
    return a.opacity >= b.opacity ? a.color : b.color;
}

Vec3 mixed(const ObjectSample& a, const ObjectSample& b) {
    const double sum = a.opacity + b.opacity;
    return sum > 0 ? (a.opacity * a.color + b.opacity * b.color) / sum : 0.5 * (a.color + b.color);
}

ObjectSample pair(const ObjectSample& a, const ObjectSample& b, Combine by) {
    ObjectSample result = a;
    switch (by) {
        case Combine::Union:
            result.opacity = std::max(a.opacity, b.opacity);
            result.color = selected(a, b);
            break;
        case Combine::Intersection:
            result.opacity = std::min(a.opacity, b.opacity);
            result.color = selected(a, b);
            break;
        case Combine::Merge:
            result.opacity = std::min(1.0, a.opacity + b.opacity);
            result.color = mixed(a, b);
            break;
        case Combine::First:
            break;
    }
    return result;
}

bool hasValue(const ObjectSample& s) {
    return s.value == s.value;
}

}  // namespace

ObjectSample combined(std::span<const ObjectSample> preImages, Combine by) {
    if (preImages.empty()) return {};
    ObjectSample result = preImages.front();
    const ObjectSample *largest = &preImages.front(), *smallest = largest;
    for (const ObjectSample& s : preImages.subspan(1)) {
        result = pair(result, s, by);
        if (s.opacity > largest->opacity || (s.opacity == largest->opacity && hasValue(s) && !hasValue(*largest)))
            largest = &s;
        if (s.opacity < smallest->opacity) smallest = &s;
    }
    result.value = largest->value;
    if (by == Combine::Union || by == Combine::Merge) result.normalGradient = largest->normalGradient;
    if (by == Combine::Intersection) result.normalGradient = smallest->normalGradient;
    return result;
}

}  // namespace voledit
