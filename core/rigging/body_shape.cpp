#include "core/rigging/body_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/rigging/body_frame.h"
#include "core/rigging/grid_steps.h"

namespace voledit {

OpaqueVoxels withoutCavities(OpaqueVoxels voxels) {
    std::vector<bool> outside(voxels.opaque.size());
    std::vector<std::uint32_t> open;
    const auto steps = neighbourSteps(voxels);
    const auto visit = [&](const Index3& c) {
        const std::size_t i = voxels.indexOf(c);
        if (voxels.opaque[i] || outside[i]) return;
        outside[i] = true;
        open.push_back(static_cast<std::uint32_t>(i));
    };
    for (Index3 c(0); c.z < voxels.size.z; ++c.z)
        for (c.y = 0; c.y < voxels.size.y; ++c.y)
            for (c.x = 0; c.x < voxels.size.x; ++c.x)
                if (c.x == 0 || c.y == 0 || c.z == 0 || c.x == voxels.size.x - 1 || c.y == voxels.size.y - 1 ||
                    c.z == voxels.size.z - 1)
                    visit(c);
    while (!open.empty()) {
        const Index3 c = cellOf(voxels, open.back());
        open.pop_back();
        // Across faces only: what is opaque is connected across corners, too.
        for (const NeighbourStep& s : steps)
            if (std::abs(s.by.x) + std::abs(s.by.y) + std::abs(s.by.z) == 1 && isInside(voxels, c + s.by))
                visit(c + s.by);
    }
    for (std::size_t i = 0; i < outside.size(); ++i) voxels.opaque[i] = outside[i] ? 0 : 1;
    return voxels;
}

BodyShape::BodyShape(OpaqueVoxels body, double thinness)
    : voxels(withoutCavities(std::move(body))),
      distance(distanceField(voxels)),
      tree(curveSkeleton(voxels, distance, thinness)),
      box(voxels.bounds()),
      step(std::max({voxels.spacing.x, voxels.spacing.y, voxels.spacing.z})) {
    double count = 0;
    for (std::size_t i = 0; i < voxels.opaque.size(); ++i)
        if (voxels.opaque[i]) {
            mean += voxels.centre(cellOf(voxels, i));
            ++count;
        }
    mean /= std::max(1.0, count);
}

Section BodyShape::sectionAt(const Vec3& p, const Vec3& normal, double reach) const {
    const Index3 low = glm::clamp(cellAt(voxels, p - reach), Index3(0), voxels.size - 1);
    const Index3 high = glm::clamp(cellAt(voxels, p + reach), Index3(0), voxels.size - 1);
    const auto isIn = [&](const Index3& c) {
        const Vec3 d = voxels.centre(c) - p;
        return voxels.opaque[voxels.indexOf(c)] && std::abs(glm::dot(d, normal)) <= 0.5 * step + 1e-9 * step &&
               glm::dot(d, d) <= reach * reach;
    };
    const Index3 n = high - low + 1;
    std::vector<bool> inPlane(std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z));
    const auto local = [&](const Index3& c) {
        const Index3 d = c - low;
        return std::size_t(d.x) + std::size_t(n.x) * (std::size_t(d.y) + std::size_t(n.y) * std::size_t(d.z));
    };
    Index3 start(-1);
    double nearest = kInfinity;
    for (Index3 c = low; c.z <= high.z; ++c.z)
        for (c.y = low.y; c.y <= high.y; ++c.y)
            for (c.x = low.x; c.x <= high.x; ++c.x) {
                if (!isIn(c)) continue;
                inPlane[local(c)] = true;
                if (const double d = glm::length(voxels.centre(c) - p); d < nearest)
                    std::tie(nearest, start) = std::pair(d, c);
            }
    Section section;
    if (start.x < 0) return section;
    std::vector<Index3> open{start};
    inPlane[local(start)] = false;
    while (!open.empty()) {
        const Index3 c = open.back();
        open.pop_back();
        ++section.cells;
        section.mean += voxels.centre(c);
        section.box = join(section.box, voxels.centre(c));
        const Index3 from = glm::max(c - 1, low), to = glm::min(c + 1, high);
        for (Index3 k = from; k.z <= to.z; ++k.z)
            for (k.y = from.y; k.y <= to.y; ++k.y)
                for (k.x = from.x; k.x <= to.x; ++k.x)
                    if (inPlane[local(k)]) {
                        inPlane[local(k)] = false;
                        open.push_back(k);
                    }
    }
    section.mean /= double(section.cells);
    return section;
}

Section BodyShape::levelAt(double y, const Vec3& near) const {
    // The level of cells next to y, so that half a step never takes two.
    const double level = voxels.origin.y + voxels.spacing.y * std::round((y - voxels.origin.y) / voxels.spacing.y);
    const Vec3 size = box.size();
    return sectionAt({near.x, level, near.z}, {0, 1, 0}, 2 * (size.x + size.y + size.z));
}

}  // namespace voledit
