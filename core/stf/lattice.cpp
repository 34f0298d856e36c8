#include "core/stf/lattice.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/stf/lattice_basis.h"

namespace voledit {

namespace {

/// A point with its derivatives along u, v, w.
struct Jet {
    Vec3 point{0}, du{0}, dv{0}, dw{0};
};

std::array<double, 3> clamped(const Vec3& u) {
    return {std::clamp(u.x, 0.0, 1.0), std::clamp(u.y, 0.0, 1.0), std::clamp(u.z, 0.0, 1.0)};
}

/// Lattices are evaluated as displacements from rest: so the rest lattice is the identity to the bit, and an affine one
/// affine, whatever the rounding of the basis' sum to one.
std::vector<Vec3> displacements(const Lattice& lattice) {
    std::vector<Vec3> result = restControlPoints(lattice.basis, lattice.points, lattice.frame);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = lattice.control[i] - result[i];
    return result;
}

/// Basis functions of one axis at each of `parameters`.
std::vector<BasisValues> table(LatticeBasis basis, int points, std::span<const double> parameters) {
    std::vector<BasisValues> result;
    result.reserve(parameters.size());
    for (const double u : parameters) result.push_back(basisValues(basis, points, u));
    return result;
}

/// Displacement and its derivatives on a whole grid of parameters, i fastest, axis after axis: the cost is that of
/// nx·ny·nz control points for a line of them, not for each vertex.
std::vector<Jet> displacementGrid(const Lattice& lattice, const std::array<std::vector<double>, 3>& parameters) {
    const std::vector<Vec3> control = displacements(lattice);
    const Index3 n = lattice.points;
    const auto bu = table(lattice.basis, n.x, parameters[0]), bv = table(lattice.basis, n.y, parameters[1]),
               bw = table(lattice.basis, n.z, parameters[2]);
    struct Line {
        Vec3 point{0}, du{0};
    };
    const std::size_t lines = std::size_t(n.y) * std::size_t(n.z);
    std::vector<Line> alongX(bu.size() * lines);  // [line][u]
    for (std::size_t line = 0; line < lines; ++line)
        for (std::size_t u = 0; u < bu.size(); ++u)
            for (std::size_t i = 0; i < bu[u].value.size(); ++i) {
                const Vec3& c = control[line * std::size_t(n.x) + bu[u].first + i];
                alongX[line * bu.size() + u].point += bu[u].value[i] * c;
                alongX[line * bu.size() + u].du += bu[u].derivative[i] * c;
            }
    struct Plane {
        Vec3 point{0}, du{0}, dv{0};
    };
    const std::size_t planeSize = bu.size() * bv.size();
    std::vector<Plane> alongY(planeSize * std::size_t(n.z));  // [k][v][u]
    for (std::size_t k = 0; k < std::size_t(n.z); ++k)
        for (std::size_t v = 0; v < bv.size(); ++v)
            for (std::size_t j = 0; j < bv[v].value.size(); ++j)
                for (std::size_t u = 0; u < bu.size(); ++u) {
                    const Line& from = alongX[(k * std::size_t(n.y) + bv[v].first + j) * bu.size() + u];
                    Plane& to = alongY[k * planeSize + v * bu.size() + u];
                    to.point += bv[v].value[j] * from.point;
                    to.du += bv[v].value[j] * from.du;
                    to.dv += bv[v].derivative[j] * from.point;
                }
    std::vector<Jet> result(planeSize * bw.size());
    parallelFor(bw.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t w = begin; w < end; ++w)
            for (std::size_t k = 0; k < bw[w].value.size(); ++k)
                for (std::size_t vu = 0; vu < planeSize; ++vu) {
                    const Plane& from = alongY[(bw[w].first + k) * planeSize + vu];
                    Jet& to = result[w * planeSize + vu];
                    to.point += bw[w].value[k] * from.point;
                    to.du += bw[w].value[k] * from.du;
                    to.dv += bw[w].value[k] * from.dv;
                    to.dw += bw[w].derivative[k] * from.point;
                }
    });
    return result;
}

/// dq/dp from dP/dq. Where the map nearly flattens space the inverse would drown all Jacobians that it is interpolated
/// with, so its growth is bounded there; its direction, which is what normals need, stays.
Mat3 boundedInverse(const Mat3& m) {
    const Mat3 adjugate = glm::transpose(Mat3(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])));
    const double determinant = glm::dot(m[0], glm::cross(m[1], m[2]));
    const double size = std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
    const double smallest = 1e-5 * size * size * size;
    if (smallest == 0) return Mat3(1);
    return adjugate / std::copysign(std::max(std::abs(determinant), smallest), determinant);
}

MappedCells::Data sampledCells(const Lattice& lattice, Index3 cells) {
    assert(lattice.control.size() ==
           std::size_t(lattice.points.x) * std::size_t(lattice.points.y) * std::size_t(lattice.points.z));
    MappedCells::Data data = gridCells(lattice.frame, cells);
    std::array<std::vector<double>, 3> parameters;
    for (int a = 0; a < 3; ++a)
        for (int i = 0; i <= cells[a]; ++i) parameters[std::size_t(a)].push_back(double(i) / cells[a]);
    const std::vector<Jet> jets = displacementGrid(lattice, parameters);
    const Mat3 normalisedFromRest(normalisedFromWorld(lattice.frame));
    data.jacobian.resize(jets.size());
    for (std::size_t i = 0; i < jets.size(); ++i) {
        data.deformed[i] = data.source[i] + jets[i].point;
        const Mat3 stretch = Mat3(1.0) + Mat3(jets[i].du, jets[i].dv, jets[i].dw) * normalisedFromRest;
        data.jacobian[i] = boundedInverse(stretch);
    }
    return data;
}

}  // namespace

std::vector<Vec3> restControlPoints(LatticeBasis basis, Index3 points, const Frame& frame) {
    const auto u = restParameters(basis, points.x), v = restParameters(basis, points.y),
               w = restParameters(basis, points.z);
    std::vector<Vec3> control;
    control.reserve(u.size() * v.size() * w.size());
    for (const double c : w)
        for (const double b : v)
            for (const double a : u)
                control.push_back(frame.corner + a * frame.edge[0] + b * frame.edge[1] + c * frame.edge[2]);
    return control;
}

Vec3 evaluate(const Lattice& lattice, const Vec3& u) {
    Mat3 ignored;
    return evaluate(lattice, u, ignored);
}

Vec3 evaluate(const Lattice& lattice, const Vec3& u, Mat3& dPdu) {
    const auto at = clamped(u);
    const Jet jet = displacementGrid(lattice, {{{at[0]}, {at[1]}, {at[2]}}}).front();
    dPdu = Mat3(lattice.frame.edge[0] + jet.du, lattice.frame.edge[1] + jet.dv, lattice.frame.edge[2] + jet.dw);
    return lattice.frame.corner + at[0] * lattice.frame.edge[0] + at[1] * lattice.frame.edge[1] +
           at[2] * lattice.frame.edge[2] + jet.point;
}

LatticeMap::LatticeMap(Lattice lattice, Index3 cells, Outside outside)
    : CellMap(sampledCells(lattice, cells), outside), lattice_(std::move(lattice)), count_(cells) {}

Box3 LatticeMap::imageOf(const Box3& rest) const {
    if (rest.empty()) return rest;
    Box3 hull = outside() == Outside::Keep ? rest : Box3{};
    for (const Vec3& c : lattice_.control) hull = join(hull, c);
    return hull;
}

std::vector<std::size_t> LatticeMap::foldingPoints() const {
    std::vector<std::size_t> found;
    const auto determinants = cells()->determinants();
    for (std::size_t t = 0; t < determinants.size(); ++t) {
        if (!(determinants[t] < 0)) continue;
        const std::size_t hexahedron = t / 6, nx = std::size_t(count_.x), ny = std::size_t(count_.y);
        const Index3 cell(hexahedron % nx, hexahedron / nx % ny, hexahedron / (nx * ny));
        Index3 strongest;
        for (int a = 0; a < 3; ++a) {
            const BasisValues basis = basisValues(lattice_.basis, lattice_.points[a], (cell[a] + 0.5) / count_[a]);
            const auto largest = std::max_element(basis.value.begin(), basis.value.end());
            strongest[a] = int(basis.first) + int(largest - basis.value.begin());
        }
        found.push_back(lattice_.indexOf(strongest));
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

}  // namespace voledit
