#include "core/skeleton/limb_interior.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

namespace voledit {
namespace {

/// One limb's side of a joint: its faces there, and its derivative along the bone.
struct Side {
    const LimbMotion& limb;
    const Quad &restFace, &posedFace;
    Vec3 normal;  // of the rest face, along the bone
};

/// What one side's map makes of the face's normal, less the normal itself, and the part of the rest derivative along
/// it.
struct NormalImage {
    Vec3 change{0};
    double along = 0;  // ≤ 0 where the rest region is turned inside out, of which nothing is made
};

NormalImage normalImage(const Side& side, double u, double v) {
    const auto derivative = [&](const LimbShape& shape) {
        return pointOf(shape.end, u, v) - pointOf(shape.start, u, v);
    };
    const Vec3 restAlong = derivative(side.limb.rest), posedAlong = derivative(side.limb.posed);
    const Vec3 restU = alongU(side.restFace, v), restV = alongV(side.restFace, u);
    const double along = glm::dot(restAlong, side.normal);
    const Vec3 tangential = restAlong - along * side.normal;
    const double uu = glm::dot(restU, restU), vv = glm::dot(restV, restV), uv = glm::dot(restU, restV);
    const double gram = uu * vv - uv * uv;
    if (!(along > 1e-3 * glm::length(restAlong)) || !(gram > 1e-12 * uu * vv)) return {};
    const double tu = glm::dot(tangential, restU), tv = glm::dot(tangential, restV);
    const double alpha = (tu * vv - tv * uv) / gram, beta = (tv * uu - tu * uv) / gram;
    const Vec3 movedU = alongU(side.posedFace, v) - restU, movedV = alongV(side.posedFace, u) - restV;
    return {(posedAlong - restAlong - alpha * movedU - beta * movedV) / along, along};
}

/// The zone in which a limb is bent: about as long as it is thick, three cells and no more than half of it.
double zoneOf(const LimbMotion& limb, const Quad& face, int cells) {
    const double thick = std::max(glm::length(alongU(face, 0.5)), glm::length(alongV(face, 0.5)));
    const double length = glm::length(limb.rest.boneEnd - limb.rest.boneStart);
    return std::min(0.5, std::max(thick / length, 3.0 / cells));
}

double sixVolume(const std::array<Vec3, 8>& p, const std::array<int, 4>& t) {
    const Vec3& origin = p[std::size_t(t[0])];
    return glm::dot(p[std::size_t(t[1])] - origin,
                    glm::cross(p[std::size_t(t[2])] - origin, p[std::size_t(t[3])] - origin));
}

/// A layer's area, of the polygon about it, times the part of `along` across it: the volume it sweeps.
double sweptVolume(const LimbGrid& grid, std::span<const Vec3> layer, const Vec3& along) {
    const std::size_t nx = std::size_t(grid.cells.x), ny = std::size_t(grid.cells.y), row = nx + 1;
    const Vec3 origin = layer[0];
    Vec3 twice(0);
    const auto edge = [&](std::size_t a, std::size_t b) { twice += glm::cross(layer[a] - origin, layer[b] - origin); };
    for (std::size_t i = 0; i < nx; ++i) edge(i, i + 1);
    for (std::size_t j = 0; j < ny; ++j) edge(nx + row * j, nx + row * (j + 1));
    for (std::size_t i = nx; i > 0; --i) edge(i + row * ny, i - 1 + row * ny);
    for (std::size_t j = ny; j > 0; --j) edge(row * j, row * (j - 1));
    return 0.5 * glm::dot(twice, along);
}

/// A layer's bone point with the corrections, and the derivative along the bone there.
struct BonePoint {
    Vec3 at, along;
};
BonePoint bonePoint(const LimbShape& shape, const EndCorrection& start, const EndCorrection& end, double w) {
    const Vec3 at = shape.bone(w) + start.atBone * start.weight(w) + end.atBone * end.weight(1 - w);
    const Vec3 along = shape.boneEnd - shape.boneStart + start.atBone * start.slope(w) - end.atBone * end.slope(1 - w);
    return {at, along};
}

}  // namespace

double EndCorrection::weight(double x) const {
    if (x >= zone) return 0;
    const double rest = 1 - x / zone;
    return x * rest * rest;
}

double EndCorrection::slope(double x) const {
    if (x >= zone) return 0;
    return (1 - x / zone) * (1 - 3 * x / zone);
}

JointCorrections jointCorrections(const LimbMotion& first, const LimbMotion& second, const JointFaces& rest,
                                  const JointFaces& posed, const LimbGrid& grid) {
    const Side a{first, rest.end, posed.end, rest.normal};
    const Side b{second, rest.start, posed.start, rest.turn * rest.normal};
    const Quat back = glm::conjugate(posed.turn);
    const Vec3 turnedNormal = back * b.normal - glm::conjugate(rest.turn) * b.normal;
    const auto corrections = [&](double u, double v, double bu, double bv) {
        const NormalImage atA = normalImage(a, u, v), atB = normalImage(b, bu, bv);
        if (atA.along <= 0 || atB.along <= 0) return std::array<Vec3, 2>{Vec3(0), Vec3(0)};
        const Vec3 half = 0.5 * (back * atB.change + turnedNormal - atA.change);
        return std::array<Vec3, 2>{-atA.along * half, -atB.along * (posed.turn * half)};
    };
    JointCorrections result;
    result.end.at.reserve(grid.layerSize());
    result.start.at.reserve(grid.layerSize());
    for (int j = 0; j <= grid.cells.y; ++j)
        for (int i = 0; i <= grid.cells.x; ++i) {
            const double u = double(i) / grid.cells.x, v = double(j) / grid.cells.y;
            const auto [end, start] = corrections(u, v, u, v);
            result.end.at.push_back(end);
            result.start.at.push_back(start);
        }
    const auto [end, start] = corrections(first.bone[0], first.bone[1], second.bone[0], second.bone[1]);
    result.end.atBone = end;
    result.start.atBone = start;
    result.end.zone = zoneOf(first, rest.end, grid.cells.z);
    result.start.zone = zoneOf(second, rest.start, grid.cells.z);
    return result;
}

void fillTrilinear(const LimbShape& shape, const LimbGrid& grid, std::span<Vec3> positions) {
    const std::size_t layer = grid.layerSize();
    std::vector<Vec3> start(layer), end(layer);
    for (int j = 0, n = 0; j <= grid.cells.y; ++j)
        for (int i = 0; i <= grid.cells.x; ++i, ++n) {
            const double u = double(i) / grid.cells.x, v = double(j) / grid.cells.y;
            start[std::size_t(n)] = pointOf(shape.start, u, v);
            end[std::size_t(n)] = pointOf(shape.end, u, v);
        }
    for (int k = 0; k <= grid.cells.z; ++k) {
        const double w = double(k) / grid.cells.z;
        for (std::size_t n = 0; n < layer; ++n) positions[std::size_t(k) * layer + n] = (1 - w) * start[n] + w * end[n];
    }
}

void addCorrection(const LimbGrid& grid, EndCorrection& correction, bool atEnd, std::span<Vec3> positions) {
    if (correction.at.empty()) return;
    const std::size_t layer = grid.layerSize(), row = std::size_t(grid.cells.x) + 1;
    const auto weightOf = [&](int k) {
        const double w = double(k) / grid.cells.z;
        return correction.weight(atEnd ? 1 - w : w);
    };
    // A cell's eight vertices with `amount` of the correction.
    const auto cellAt = [&](std::size_t base, int k, double amount) {
        std::array<Vec3, 8> p;
        for (std::size_t c = 0; c < 8; ++c) {
            const std::size_t inLayer = base + (c & 1) + row * (c >> 1 & 1), up = c >> 2;
            p[c] = positions[(std::size_t(k) + up) * layer + inLayer] +
                   amount * weightOf(k + int(up)) * correction.at[inLayer];
        }
        return p;
    };
    const auto holds = [&](double amount) {
        for (int k = 0; k < grid.cells.z; ++k) {
            if (weightOf(k) == 0 && weightOf(k + 1) == 0) continue;
            for (int j = 0; j < grid.cells.y; ++j)
                for (int i = 0; i < grid.cells.x; ++i) {
                    const std::size_t base = std::size_t(i) + row * std::size_t(j);
                    const auto before = cellAt(base, k, 0), after = cellAt(base, k, amount);
                    for (const auto& t : kHexahedronTetrahedra) {
                        const double volume = sixVolume(before, t);
                        if (volume > 0 && !(sixVolume(after, t) >= 0.1 * volume)) return false;
                    }
                }
        }
        return true;
    };
    double amount = 1;
    if (!holds(1)) {
        double low = 0, high = 1;
        for (int step = 0; step < 10; ++step) (holds((low + high) / 2) ? low : high) = (low + high) / 2;
        amount = low;
    }
    for (Vec3& v : correction.at) v *= amount;
    correction.atBone *= amount;
    for (int k = 0; k <= grid.cells.z; ++k) {
        const double weight = weightOf(k);
        if (weight == 0) continue;
        for (std::size_t n = 0; n < layer; ++n) positions[std::size_t(k) * layer + n] += weight * correction.at[n];
    }
}

std::vector<double> layerScales(const LimbMotion& limb, const LimbGrid& grid, const EndCorrection& start,
                                const EndCorrection& end, std::span<const Vec3> rest, std::span<const Vec3> posed) {
    const std::size_t layer = grid.layerSize();
    const EndCorrection none;
    std::vector<double> scales;
    for (int k = 0; k <= grid.cells.z; ++k) {
        const double w = double(k) / grid.cells.z;
        const auto volume = [&](std::span<const Vec3> positions, const BonePoint& bone) {
            return sweptVolume(grid, positions.subspan(std::size_t(k) * layer, layer), bone.along);
        };
        const double before = volume(rest, bonePoint(limb.rest, none, none, w));
        const double after = volume(posed, bonePoint(limb.posed, start, end, w));
        if (!(before > 0)) {
            scales.push_back(1);
            continue;
        }
        scales.push_back(std::sqrt(before / std::clamp(after, before / 16, before * 16)));
    }
    return scales;
}

void scaleLayers(const LimbMotion& limb, const LimbGrid& grid, const EndCorrection& start, const EndCorrection& end,
                 std::span<const double> scales, std::span<Vec3> posed) {
    const std::size_t layer = grid.layerSize();
    for (int k = 0; k <= grid.cells.z; ++k) {
        const Vec3 about = bonePoint(limb.posed, start, end, double(k) / grid.cells.z).at;
        const double more = scales[std::size_t(k)] - 1;
        for (Vec3& p : posed.subspan(std::size_t(k) * layer, layer)) p += more * (p - about);
    }
}

}  // namespace voledit
