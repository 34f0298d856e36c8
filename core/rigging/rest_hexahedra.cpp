#include "core/rigging/rest_hexahedra.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voledit {

RestHexahedron::RestHexahedron(const std::array<Vec3, 8>& c) {
    coefficients_ = {c[0],
                     c[1] - c[0],
                     c[2] - c[0],
                     c[4] - c[0],
                     c[3] - c[2] - c[1] + c[0],
                     c[5] - c[4] - c[1] + c[0],
                     c[6] - c[4] - c[2] + c[0],
                     c[7] - c[6] - c[5] - c[3] + c[4] + c[2] + c[1] - c[0]};
    const auto& k = coefficients_;
    edges_ = Mat3(k[1] + 0.5 * (k[4] + k[5]) + 0.25 * k[7], k[2] + 0.5 * (k[4] + k[6]) + 0.25 * k[7],
                  k[3] + 0.5 * (k[5] + k[6]) + 0.25 * k[7]);
    inverse_ = glm::determinant(edges_) != 0 ? glm::inverse(edges_) : Mat3(kNaN);
}

Vec3 RestHexahedron::local(const Vec3& p) const {
    const auto& k = coefficients_;
    const auto at = [&](const Vec3& c) {
        return k[0] + c.x * k[1] + c.y * k[2] + c.z * k[3] + c.x * c.y * k[4] + c.x * c.z * k[5] + c.y * c.z * k[6] +
               c.x * c.y * c.z * k[7];
    };
    // From the linear map at the middle; a few steps, since tapered boxes are nearly linear.
    constexpr double kConverged = 1e-8;
    Vec3 c = Vec3(0.5) + inverse_ * (p - at(Vec3(0.5)));
    for (int i = 0; i < 8 && isDefined(c); ++i) {
        c = glm::clamp(c, Vec3(-2), Vec3(3));
        const Mat3 j(k[1] + c.y * k[4] + c.z * k[5] + c.y * c.z * k[7],
                     k[2] + c.x * k[4] + c.z * k[6] + c.x * c.z * k[7],
                     k[3] + c.x * k[5] + c.y * k[6] + c.x * c.y * k[7]);
        const double det = glm::determinant(j);
        if (det == 0) return kUndefined;
        const Vec3 step = glm::inverse(j) * (p - at(c));
        c += step;
        if (glm::dot(step, step) < kConverged * kConverged) return c;
    }
    return kUndefined;
}

std::vector<RestHexahedron> restHexahedra(const std::vector<Limb>& limbs, const std::vector<PosedJoint>& rest) {
    RegionOptions options;
    options.cells = {1, 1, 1};
    options.smooth = false;
    const LimbRegions regions = limbRegions(limbs, rest, rest, options);
    std::vector<RestHexahedron> hexahedra;
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        std::array<Vec3, 8> corners;
        const auto& vertices = regions.cells.hexahedra[regions.firstCell[l]];
        for (std::size_t i = 0; i < 8; ++i) corners[i] = regions.cells.source[vertices[i]];
        hexahedra.emplace_back(corners);
    }
    return hexahedra;
}

}  // namespace voledit
