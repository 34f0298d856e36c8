#include "core/stf/component_field.h"

#include <cassert>
#include <vector>

#include "core/stf/displacement_image.h"

namespace voledit {

void ComponentField::sample(std::span<const Vec3> p, std::span<double> value) const {
    assert(p.size() == value.size());
    std::vector<Vec3> q(p.size());
    of_->map(p, q);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Vec3 v = displacement_ ? q[i] - p[i] : q[i];
        value[i] = isDefined(v) ? v[axis_] : kNaN;
    }
}

void ComponentField::gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const {
    assert(p.size() == gradient.size());
    std::vector<Vec3> q(p.size());
    std::vector<Mat3> jacobian(p.size());
    of_->map(p, q);
    of_->jacobian(p, jacobian);
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Mat3 of = displacement_ ? jacobian[i] - Mat3(1) : jacobian[i];
        gradient[i] = isDefined(q[i]) ? Vec3(of[0][axis_], of[1][axis_], of[2][axis_]) : Vec3(0);
    }
}

Interval ComponentField::range(const Box3& box) const {
    const Box3 hull = sourceHull(*of_, box);
    if (hull.empty()) return {kInfinity, -kInfinity};
    const Box3 values = displacement_ ? combination(1, hull, -1, box) : hull;
    return {values.min[axis_], values.max[axis_]};
}

}  // namespace voledit
