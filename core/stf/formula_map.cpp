#include "core/stf/formula_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace voledit {

namespace {

constexpr std::size_t kBlock = 256;
constexpr std::array<int, 3> kCoordinates{0, 1, 2};

/// Coordinates of a block of points and a graph's outputs for them, each number's values in a row.
class Block {
public:
    /// For at most `capacity` points, which is at most kBlock.
    Block(int outputs, std::size_t capacity) : values_(std::size_t(outputs) * capacity) {
        for (int o = 0; o < outputs; ++o) pointers_.push_back(values_.data() + std::size_t(o) * capacity);
    }

    void setPoints(std::span<const Vec3> p, const Mat4* formulaFromWorld) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Vec3 u = formulaFromWorld ? transformPoint(*formulaFromWorld, p[i]) : p[i];
            for (int c = 0; c < 3; ++c) points_[std::size_t(c)][i] = u[c];
        }
    }
    void evaluate(const FormulaGraph& graph, std::span<const double> parameters, std::size_t count) {
        const std::array<const double*, 3> variables{points_[0].data(), points_[1].data(), points_[2].data()};
        graph.evaluate(variables, parameters, pointers_, count);
    }
    double output(int o, std::size_t i) const { return pointers_[std::size_t(o)][i]; }

    /// Outputs 0, 1, 2 at point i; kUndefined where they, or the condition in output 3, say so.
    Vec3 point(std::size_t i, bool condition) const {
        const Vec3 q(output(0, i), output(1, i), output(2, i));
        const bool defined = std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
        // A condition that is NaN holds: what cannot be decided is not shown.
        return defined && !(condition && output(3, i) != 0) ? q : kUndefined;
    }

private:
    std::array<std::array<double, kBlock>, 3> points_;
    std::vector<double> values_;
    std::vector<double*> pointers_;
};

bool isFinite(const Box3& box) {
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(box.min[c]) || !std::isfinite(box.max[c])) return false;
    return true;
}

/// `transformed`, where infinite boxes stay infinite instead of becoming 0 · ∞.
Box3 moved(const Box3& box, const Mat4& m) {
    return isFinite(box) ? transformed(box, m) : Box3{Vec3(-kInfinity), Vec3(kInfinity)};
}

/// Where a box of the formula's coordinates comes from.
class SourceSearch {
public:
    SourceSearch(const FormulaMap& map, const std::function<bool(const Box3&)>& found, bool identity)
        : map_(map), found_(found), identity_(identity), block_(map.formula().outputCount(), 9) {}

    bool any(const Box3& box, int splits) {
        const std::array<Interval, 3> point{{{box.min.x, box.max.x}, {box.min.y, box.max.y}, {box.min.z, box.max.z}}};
        const std::vector<Interval> bounds = map_.formula().bounds(point, map_.parameters());
        const bool nowhere = map_.hasCondition() && (bounds[3].low > 0 || bounds[3].high < 0);
        if (nowhere) return keeps() && found_(inWorld(box));
        const Box3 source{{bounds[0].low, bounds[1].low, bounds[2].low},
                          {bounds[0].high, bounds[1].high, bounds[2].high}};
        if (splits > 0 && isFinite(box) && isLoose(box, source)) {
            const Vec3 size = box.size();
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            Box3 low = box, high = box;
            low.max[axis] = high.min[axis] = box.center()[axis];
            return any(low, splits - 1) || any(high, splits - 1);
        }
        if (keeps() && found_(inWorld(box))) return true;
        return !source.empty() && found_(inWorld(source));
    }

private:
    bool keeps() const { return map_.outside() == Outside::Keep; }
    Box3 inWorld(const Box3& box) const { return identity_ ? box : moved(box, map_.worldFromFormula()); }

    /// Whether `source` is far larger than where the corners and the centre of `box` come from.
    bool isLoose(const Box3& box, const Box3& source) {
        std::array<Vec3, 9> p;
        for (int c = 0; c < 8; ++c) p[std::size_t(c)] = box.corner(c);
        p[8] = box.center();
        block_.setPoints(p, nullptr);
        block_.evaluate(map_.formula(), map_.parameters(), p.size());
        Box3 hull;
        for (std::size_t i = 0; i < p.size(); ++i)
            if (const Vec3 q = block_.point(i, map_.hasCondition()); isDefined(q)) hull = join(hull, q);
        if (hull.empty()) return true;
        const Vec3 most = 1.5 * hull.size() + 1e-9 * (glm::abs(hull.min) + glm::abs(hull.max));
        const Vec3 size = source.max - source.min;
        return !(size.x <= most.x && size.y <= most.y && size.z <= most.z);
    }

    const FormulaMap& map_;
    const std::function<bool(const Box3&)>& found_;
    bool identity_;
    Block block_;
};

}  // namespace

FormulaMap::FormulaMap(Parts parts)
    : parts_(std::move(parts)),
      withDerivatives_(parts_.withDerivatives ? *parts_.withDerivatives : parts_.formula.withDerivatives(kCoordinates)),
      aroundIdentity_(parts_.formulaFromWorld == Mat4(1) && parts_.worldFromFormula == Mat4(1)) {
    assert(parts_.formula.variableCount() == 3 && parts_.formula.outputCount() >= 3);
    assert(int(parts_.parameters.size()) == parts_.formula.parameterCount());
}

void FormulaMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    assert(p.size() == q.size());
    Block block(parts_.formula.outputCount(), std::min(kBlock, p.size()));
    for (std::size_t begin = 0; begin < p.size(); begin += kBlock) {
        const auto part = p.subspan(begin, std::min(kBlock, p.size() - begin));
        block.setPoints(part, aroundIdentity_ ? nullptr : &parts_.formulaFromWorld);
        block.evaluate(parts_.formula, parts_.parameters, part.size());
        for (std::size_t i = 0; i < part.size(); ++i) {
            const Vec3 from = part[i], given = block.point(i, hasCondition());
            // A formula without x, y, z is defined everywhere, but nothing is where p is undefined.
            Vec3& to = q[begin + i];
            if (!isDefined(from))
                to = kUndefined;
            else if (isDefined(given))
                to = aroundIdentity_ ? given : transformPoint(parts_.worldFromFormula, given);
            else
                to = parts_.outside == Outside::Keep ? from : kUndefined;
        }
    }
}

void FormulaMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    const Mat3 before(parts_.formulaFromWorld), after(parts_.worldFromFormula);
    const int outputs = parts_.formula.outputCount();
    Block block(withDerivatives_.outputCount(), std::min(kBlock, p.size()));
    for (std::size_t begin = 0; begin < p.size(); begin += kBlock) {
        const auto part = p.subspan(begin, std::min(kBlock, p.size() - begin));
        block.setPoints(part, aroundIdentity_ ? nullptr : &parts_.formulaFromWorld);
        block.evaluate(withDerivatives_, parts_.parameters, part.size());
        for (std::size_t i = 0; i < part.size(); ++i) {
            Mat3 j;
            bool finite = isDefined(part[i]) && isDefined(block.point(i, hasCondition()));
            for (int o = 0; o < 3; ++o)
                for (int n = 0; n < 3; ++n) {
                    j[n][o] = block.output(outputs + 3 * o + n, i);
                    finite = finite && std::isfinite(j[n][o]);
                }
            jacobian[begin + i] = !finite ? Mat3(1) : aroundIdentity_ ? j : after * j * before;
        }
    }
}

Box3 FormulaMap::imageOf(const Box3& rest) const {
    if (rest.empty()) return rest;
    const Box3 image = parts_.image ? parts_.image(rest) : rest;
    return parts_.outside == Outside::Keep ? join(image, rest) : image;
}

bool FormulaMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    if (box.empty()) return false;
    return SourceSearch(*this, found, aroundIdentity_)
        .any(aroundIdentity_ ? box : moved(box, parts_.formulaFromWorld), 3);
}

}  // namespace voledit
