#include "core/stf/field_maps.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/stf/displacement_image.h"

namespace voledit {

namespace {

constexpr int kPieces = 8;  // an axis, for the largest |Δ|

using Fields = std::array<FieldPtr, 3>;

Box3 commonDomain(const Fields& fields) {
    Box3 domain = fields[0]->domain();
    for (int a = 1; a < 3; ++a) domain = intersect(domain, fields[std::size_t(a)]->domain());
    return domain;
}

bool isBounded(const Box3& box) {
    for (int a = 0; a < 3; ++a)
        if (!std::isfinite(box.min[a]) || !std::isfinite(box.max[a])) return false;
    return true;
}

/// Box of the fields' values in `box`; empty where one is undefined in all of it.
Box3 valuesIn(const Fields& fields, const Box3& box) {
    Box3 values;
    for (int a = 0; a < 3; ++a) {
        const Interval range = fields[std::size_t(a)]->range(box);
        values.min[a] = range.low;
        values.max[a] = range.high;
    }
    return values;
}

/// Largest length of a vector in `values`; 0 where there is none.
double farthest(const Box3& values) {
    return values.empty() ? 0 : glm::length(glm::max(glm::abs(values.min), glm::abs(values.max)));
}

/// The same for the fields in `box`, cut into pieces, for their three largest values need not meet in one point.
double largestIn(const Fields& fields, const Box3& box) {
    double largest = 0;
    const Vec3 piece = box.size() / double(kPieces);
    for (int n = 0; n < kPieces * kPieces * kPieces; ++n) {
        const Vec3 first(n % kPieces, n / kPieces % kPieces, n / (kPieces * kPieces));
        const Vec3 low = box.min + first * piece;
        largest = std::max(largest, farthest(valuesIn(fields, {low, glm::min(low + piece, box.max)})));
    }
    return largest;
}

}  // namespace

FieldsMap::FieldsMap(std::array<FieldPtr, 3> fields, bool displacement, Outside outside)
    : fields_(std::move(fields)), displacement_(displacement), outside_(outside) {
    assert(fields_[0] && fields_[1] && fields_[2]);
}

void FieldsMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    assert(p.size() == q.size());
    std::array<std::vector<double>, 3> value;
    for (std::size_t a = 0; a < 3; ++a) {
        value[a].resize(p.size());
        fields_[a]->sample(p, value[a]);
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 at(value[0][i], value[1][i], value[2][i]);
        if (isDefined(at) && isDefined(p[i]))
            q[i] = displacement_ ? p[i] + at : at;
        else
            q[i] = outside_ == Outside::Keep && isDefined(p[i]) ? p[i] : kUndefined;
    }
}

void FieldsMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    std::vector<double> value(p.size());
    std::vector<Vec3> gradient(p.size());
    std::vector<char> defined(p.size(), 1);
    std::fill(jacobian.begin(), jacobian.end(), Mat3(displacement_ ? 1 : 0));
    for (int row = 0; row < 3; ++row) {
        const ScalarField& field = *fields_[std::size_t(row)];
        field.sample(p, value);
        field.gradient(p, gradient);
        for (std::size_t i = 0; i < p.size(); ++i) {
            if (value[i] != value[i]) defined[i] = 0;
            for (int column = 0; column < 3; ++column) jacobian[i][column][row] += gradient[i][column];
        }
    }
    for (std::size_t i = 0; i < p.size(); ++i)
        if (!defined[i]) jacobian[i] = Mat3(1);
}

Box3 FieldsMap::imageOf(const Box3& rest) const {
    const Box3 domain = commonDomain(fields_);
    if (!displacement_) {
        if (!isBounded(domain)) return rest;
        return outside_ == Outside::Keep ? join(domain, rest) : domain;
    }
    if (rest.empty() || domain.empty() || !isBounded(rest)) return rest;
    const double everywhere = farthest(valuesIn(fields_, domain));
    if (!std::isfinite(everywhere)) return imageByDisplacement(*this, rest, rest);
    // All images lie within that reach; what is farther off need not be looked at, twice.
    Box3 image = grown(rest, everywhere);
    for (int round = 0; round < 2; ++round) {
        const Box3 where = intersect(image, domain);
        if (where.empty()) return rest;
        image = grown(rest, std::min(everywhere, largestIn(fields_, where)));
    }
    return image;
}

bool FieldsMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    if (outside_ == Outside::Keep && found(box)) return true;
    const Box3 values = valuesIn(fields_, box);
    return !values.empty() && found(displacement_ ? combination(1, box, 1, values) : values);
}

}  // namespace voledit
