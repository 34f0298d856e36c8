#include "core/objects/attribute_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/objects/term_bounds.h"

namespace voledit {

double AttributeField::step() const {
    const Vec3 size = of_->bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    return longest > 0 && std::isfinite(longest) ? longest / 512 : 1.0 / 512;
}

void AttributeField::sample(std::span<const Vec3> p, std::span<double> value) const {
    assert(p.size() == value.size());
    std::vector<ObjectSample> samples(p.size());
    voledit::sample(*of_, p, samples, false, name_);
    for (std::size_t i = 0; i < p.size(); ++i) value[i] = samples[i].value;
}

void AttributeField::gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const {
    assert(p.size() == gradient.size());
    const double h = step();
    std::vector<Vec3> at;
    at.reserve(7 * p.size());
    for (const Vec3& point : p) {
        at.push_back(point);
        for (int a = 0; a < 3; ++a)
            for (const double side : {-h, h}) {
                at.push_back(point);
                at.back()[a] += side;
            }
    }
    std::vector<double> value(at.size());
    sample(at, value);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double here = value[7 * i];
        for (int a = 0; a < 3; ++a) {
            double behind = value[7 * i + 1 + 2 * std::size_t(a)], ahead = value[7 * i + 2 + 2 * std::size_t(a)];
            double length = 2 * h;
            // One-sided where the object ends.
            if (behind != behind || ahead != ahead) length = h;
            if (behind != behind) behind = here;
            if (ahead != ahead) ahead = here;
            const double slope = (ahead - behind) / length;
            gradient[i][a] = here == here && std::isfinite(slope) ? slope : 0;
        }
    }
}

Interval AttributeField::range(const Box3& box) const {
    return attributeRange(*of_, box, name_);
}

}  // namespace voledit
