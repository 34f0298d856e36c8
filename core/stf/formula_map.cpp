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

using Rows = std::array<std::array<double, kBlock>, 3>;  // coordinates of a block of points, each in a row
using RowPointers = std::array<const double*, 3>;

RowPointers pointersTo(const Rows& rows) {
    return {rows[0].data(), rows[1].data(), rows[2].data()};
}

/// to = m · from for `count` points; `m` is affine.
void transformRows(const Mat4& m, const RowPointers& from, Rows& to, std::size_t count) {
    const bool aligned = m[0][1] == 0 && m[0][2] == 0 && m[1][0] == 0 && m[1][2] == 0 && m[2][0] == 0 && m[2][1] == 0;
    for (int r = 0; r < 3; ++r) {
        double* row = to[std::size_t(r)].data();
        const double offset = m[3][r];
        if (aligned) {  // most frames are boxes
            const double scale = m[r][r];
            const double* x = from[std::size_t(r)];
            for (std::size_t i = 0; i < count; ++i) row[i] = scale * x[i] + offset;
        } else {
            const double mx = m[0][r], my = m[1][r], mz = m[2][r];
            const auto [x, y, z] = from;
            for (std::size_t i = 0; i < count; ++i) row[i] = mx * x[i] + my * y[i] + mz * z[i] + offset;
        }
    }
}

/// A block of points and a graph's outputs for them, each number's values in a row.
class Block {
public:
    /// For at most `capacity` points, which is at most kBlock.
    Block(int outputs, std::size_t capacity) : values_(std::size_t(outputs) * capacity) {
        for (int o = 0; o < outputs; ++o) outputs_.push_back(values_.data() + std::size_t(o) * capacity);
    }

    /// Evaluates `graph` at `p`, moved by formulaFromWorld (null: the identity).
    void evaluate(const FormulaGraph& graph, std::span<const double> parameters, std::span<const Vec3> p,
                  const Mat4* formulaFromWorld) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            points_[0][i] = p[i].x;
            points_[1][i] = p[i].y;
            points_[2][i] = p[i].z;
        }
        if (formulaFromWorld) transformRows(*formulaFromWorld, pointersTo(points_), moved_, p.size());
        graph.evaluate(pointersTo(formulaFromWorld ? moved_ : points_), parameters, outputs_, p.size());
    }

    double output(int o, std::size_t i) const { return outputs_[std::size_t(o)][i]; }

    /// Outputs 0, 1, 2 at point i; kUndefined where they, or the condition in output 3, say so.
    Vec3 point(std::size_t i, bool condition) const {
        const Vec3 q(output(0, i), output(1, i), output(2, i));
        return isShown(q.x, q.y, q.z, condition ? output(3, i) : 0) ? q : kUndefined;
    }

    /// The same for all points, moved by worldFromFormula (null: the identity); where they are undefined, the points
    /// themselves, if `keep`. Points that are undefined themselves stay so.
    void writePoints(std::span<Vec3> q, bool condition, bool keep, const Mat4* worldFromFormula) {
        if (worldFromFormula)
            transformRows(*worldFromFormula, {outputs_[0], outputs_[1], outputs_[2]}, moved_, q.size());
        const auto [x, y, z] =
            worldFromFormula ? pointersTo(moved_) : RowPointers{outputs_[0], outputs_[1], outputs_[2]};
        const auto [px, py, pz] = pointersTo(points_);
        std::array<double, kBlock> shown;  // 1 or 0
        for (std::size_t i = 0; i < q.size(); ++i) shown[i] = isShown(x[i], y[i], z[i], 0) ? 1 : 0;
        if (const double* hidden = condition ? outputs_[3] : nullptr)
            for (std::size_t i = 0; i < q.size(); ++i) shown[i] = hidden[i] != 0 ? 0 : shown[i];
        for (std::size_t i = 0; i < q.size(); ++i) {
            const Vec3 p(px[i], py[i], pz[i]);
            const Vec3 instead = keep ? p : kUndefined;
            // A formula without x, y, z is defined everywhere, but nothing is where p is undefined.
            q[i] = !isDefined(p) ? kUndefined : shown[i] != 0 ? Vec3(x[i], y[i], z[i]) : instead;
        }
    }

private:
    /// A condition that is NaN holds: what cannot be decided is not shown.
    static bool isShown(double x, double y, double z, double hidden) {
        // Differences of equal numbers are 0 where those are finite, else NaN.
        return (x - x) + (y - y) + (z - z) == 0 && hidden == 0;
    }

    Rows points_, moved_;
    std::vector<double> values_;
    std::vector<double*> outputs_;
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
        block_.evaluate(map_.formula(), map_.parameters(), p, nullptr);
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
        const std::size_t count = std::min(kBlock, p.size() - begin);
        block.evaluate(parts_.formula, parts_.parameters, p.subspan(begin, count),
                       aroundIdentity_ ? nullptr : &parts_.formulaFromWorld);
        block.writePoints(q.subspan(begin, count), hasCondition(), parts_.outside == Outside::Keep,
                          aroundIdentity_ ? nullptr : &parts_.worldFromFormula);
    }
}

void FormulaMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    const Mat3 before(parts_.formulaFromWorld), after(parts_.worldFromFormula);
    const int outputs = parts_.formula.outputCount();
    Block block(withDerivatives_.outputCount(), std::min(kBlock, p.size()));
    for (std::size_t begin = 0; begin < p.size(); begin += kBlock) {
        const auto part = p.subspan(begin, std::min(kBlock, p.size() - begin));
        block.evaluate(withDerivatives_, parts_.parameters, part, aroundIdentity_ ? nullptr : &parts_.formulaFromWorld);
        for (std::size_t i = 0; i < part.size(); ++i) {
            Mat3 j;
            bool finite = isDefined(part[i]) && isDefined(block.point(i, outputs > 3));
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
