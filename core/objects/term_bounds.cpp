#include "core/objects/term_bounds.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/fields/value_bricks.h"
#include "core/objects/evaluation.h"
#include "core/objects/term_cache.h"
#include "core/stf/mesh_field.h"

namespace voledit {

namespace {

constexpr Interval kNothing{kInfinity, -kInfinity};

/// Distances from `center` within `box`.
Interval distancesFrom(const Vec3& center, const Box3& box) {
    const Vec3 nearest = glm::max(glm::max(box.min - center, center - box.max), Vec3(0));
    const Vec3 farthest = glm::max(glm::abs(box.min - center), glm::abs(box.max - center));
    return {glm::length(nearest), glm::length(farthest)};
}

bool visible(const VolumeTerm& node, const Term& term, const Box3& box) {
    return term.cache->visibleBricks(node).mayBeVisible(movedBox(box, node.volume->indexFromWorld()));
}

bool visible(const MeshTerm& node, const Term&, const Box3& box) {
    const Interval values = node.field->range(box);
    return largestOpacity(node.appearance.opacity, values.low, values.high) > 0;
}

bool visible(const SolidTerm& node, const Term& term, const Box3& box) {
    const Box3 part = intersect(box, term.bounds);
    const Interval d = node.distance->range(part);
    if (!(d.low <= node.falloff) || d.low > d.high) return false;
    const Interval r = distancesFrom(node.center, part);
    const std::array<Interval, 5> variables{Interval{part.min.x, part.max.x}, Interval{part.min.y, part.max.y},
                                            Interval{part.min.z, part.max.z}, r,
                                            Interval{d.low, std::min(d.high, node.falloff)}};
    return node.opacity.bounds(variables, node.parameters).front().high > 0;
}

bool visible(const FieldsTerm& node, const Term&, const Box3& box) {
    const Interval opacity = node.opacity->range(intersect(box, node.box));
    return opacity.low <= opacity.high && opacity.high > 0;
}

bool visible(const CvgTerm& node, const Term&, const Box3& box) {
    const auto seen = [&](const TermPtr& of) { return mayBeVisible(*of, box); };
    switch (node.by) {
        case CvgOperator::Union:
        case CvgOperator::Merge:
        case CvgOperator::Blend:
            return std::any_of(node.of.begin(), node.of.end(), seen);
        case CvgOperator::Intersection:
        case CvgOperator::Cap:  // O₁ ≤ O₂ is above 0 only where O₂ is
            return std::all_of(node.of.begin(), node.of.end(), seen);
        case CvgOperator::Difference:
        case CvgOperator::Trim:
            break;
    }
    return seen(node.of.front());
}

bool visible(const RecolorTerm& node, const Term&, const Box3& box) {
    if (!mayBeVisible(*node.of, box)) return false;
    if (!node.opacity || !alwaysHas(*node.of, node.from)) return true;
    // Asking again would double the work at each of many layers.
    const Interval from = node.from == "opacity" ? Interval{0, 1} : attributeRange(*node.of, box, node.from);
    return largestOpacity(*node.opacity, from.low, from.high) > 0;
}

bool visible(const TransferTerm& node, const Term&, const Box3& box) {
    return node.by->anySourceBox(box, [&](const Box3& source) { return mayBeVisible(*node.of, source); });
}

struct AttributeRange {
    const Box3& box;
    const std::string& attribute;

    Interval operator()(const VolumeTerm& node) const {
        if (attribute != "scalar") return kNothing;
        return rangeWithin(*node.volume, node.channel, node.interpolation,
                           movedBox(box, node.volume->indexFromWorld()));
    }
    Interval operator()(const MeshTerm& node) const {
        return attribute == "scalar" ? node.field->range(box) : kNothing;
    }
    Interval operator()(const SolidTerm&) const { return kNothing; }
    Interval operator()(const FieldsTerm& node) const {
        const auto found = node.attributes.find(attribute);
        const Box3 inside = intersect(box, node.box);
        return found == node.attributes.end() || inside.empty() ? kNothing : found->second->range(inside);
    }
    Interval operator()(const CvgTerm& node) const {
        Interval range = kNothing;
        for (const TermPtr& of : node.of) range = join(range, attributeRange(*of, box, attribute));
        return range;
    }
    Interval operator()(const RecolorTerm& node) const { return attributeRange(*node.of, box, attribute); }
    Interval operator()(const TransferTerm& node) const {
        Interval range = kNothing;
        node.by->anySourceBox(box, [&](const Box3& source) {
            range = join(range, attributeRange(*node.of, source, attribute));
            return false;
        });
        return range;
    }
};

struct AlwaysHas {
    const std::string& attribute;
    bool operator()(const VolumeTerm&) const { return attribute == "scalar"; }
    bool operator()(const MeshTerm&) const { return attribute == "scalar"; }
    bool operator()(const SolidTerm&) const { return false; }
    // A field may be undefined at some points.
    bool operator()(const FieldsTerm&) const { return false; }
    bool operator()(const CvgTerm& node) const {
        return std::all_of(node.of.begin(), node.of.end(),
                           [&](const TermPtr& of) { return alwaysHas(*of, attribute); });
    }
    bool operator()(const RecolorTerm& node) const { return alwaysHas(*node.of, attribute); }
    bool operator()(const TransferTerm& node) const { return alwaysHas(*node.of, attribute); }
};

}  // namespace

bool mayBeVisible(const Term& term, const Box3& box) {
    if (intersect(term.bounds, box).empty()) return false;
    return std::visit([&](const auto& node) { return visible(node, term, box); }, term.node);
}

Interval attributeRange(const Term& term, const Box3& box, const std::string& attribute) {
    if (attribute == "opacity") return mayBeVisible(term, box) ? Interval{0, 1} : Interval{0, 0};
    if (ownAttribute(attribute, {})) return {0, 1};
    return std::visit(AttributeRange{box, attribute}, term.node);
}

bool alwaysHas(const Term& term, const std::string& attribute) {
    return ownAttribute(attribute, {}) || std::visit(AlwaysHas{attribute}, term.node);
}

}  // namespace voledit
