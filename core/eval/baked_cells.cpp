#include "core/eval/baked_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"

namespace voledit {

namespace {

/// How far outside a tetrahedron a node still belongs to it, as a weight of its vertices: neighbours share faces.
constexpr double kSlack = 1e-7;
/// The same as a distance, cells.
constexpr double kBeside = 1e-6;
constexpr std::size_t kPart = 1024;  // tetrahedra
constexpr int kLayersAtOnce = 4;

/// ceil(x) of |x| < 1e9; no call.
int ceilOf(double x) {
    const int n = int(x);
    return n + (x > n);
}

}  // namespace

bool CellBaker::Tetrahedron::setUp(const std::array<Vec3, 4>& corner, const std::array<Vec3, 4>& place) {
    const Vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], e3 = corner[3] - corner[0];
    const Vec3 across = glm::cross(e2, e3);
    const double volume = glm::dot(e1, across);
    if (volume == 0) return false;
    const double perVolume = 1 / volume;
    std::array<Vec3, 4> rate{Vec3(0), perVolume * across, perVolume * glm::cross(e3, e1),
                             perVolume * glm::cross(e1, e2)};
    rate[0] = -(rate[1] + rate[2] + rate[3]);
    for (std::size_t n = 0; n < 4; ++n) {
        faces.start[n] = (n == 0) - glm::dot(rate[n], corner[0]) + kSlack;
        faces.rateY[n] = rate[n].y;
        faces.rateZ[n] = rate[n].z;
        faces.inverse[n] = rate[n].x == 0 ? -1e100 : -1 / rate[n].x;
        faces.from[n] = rate[n].x >= 0 ? kInfinity : -kInfinity;
        faces.to[n] = rate[n].x >= 0 ? kInfinity : -kInfinity;
    }
    low = glm::min(glm::min(corner[0], corner[1]), glm::min(corner[2], corner[3]));
    high = glm::max(glm::max(corner[0], corner[1]), glm::max(corner[2], corner[3]));
    placeRate = glm::outerProduct(place[1] - place[0], rate[1]) + glm::outerProduct(place[2] - place[0], rate[2]) +
                glm::outerProduct(place[3] - place[0], rate[3]);
    placeStart = place[0] - placeRate * corner[0];
    return true;
}

template <class Filled>
void CellBaker::Tetrahedron::fillRow(double offset, double y, double z, int count, const Filled& filled) const {
    double from = std::max(low.x - kBeside, offset), to = std::min(high.x + kBeside, count - 1 + offset);
    for (std::size_t n = 0; n < 4; ++n) {
        const double zero = (faces.start[n] + y * faces.rateY[n] + z * faces.rateZ[n]) * faces.inverse[n];
        from = std::max(from, std::min(zero, faces.from[n]));
        to = std::min(to, std::max(zero, faces.to[n]));
    }
    if (!(from <= to)) return;
    const Vec3 place = placeStart + placeRate * Vec3(offset, y, z);
    const int last = int(to - offset);
    for (int i = ceilOf(from - offset); i <= last; ++i) filled(i, place + double(i) * placeRate[0]);
}

void CellBaker::Part::add(const Tetrahedron& t) {
    tetrahedra.push_back(t);
    layers.push_back({float(t.low.z) - 1e-3F, float(t.high.z) + 1e-3F});
}

CellBaker::CellBaker(const BakedCells& from, const BakeGrid& grid) : grid_(grid) {
    const MappedCells& cells = *from.cells;
    const Mat4 gridFromDeformed = grid.gridFromWorld() * from.worldFromDeformed;
    std::vector<Vec3> corner(cells.deformed().size()), place(corner.size());
    parallelFor(corner.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            corner[v] = transformPoint(gridFromDeformed, cells.deformed()[v]);
            place[v] = transformPoint(from.placeFromSource, cells.source()[v]);
        }
    });
    const auto addWanted = [&](std::size_t n, Part& part) {
        if (cells.determinants()[n] == 0) return;
        std::array<Vec3, 4> at, q;
        for (std::size_t c = 0; c < 4; ++c) {
            at[c] = corner[cells.tetrahedra()[n][c]];
            q[c] = place[cells.tetrahedra()[n][c]];
        }
        Tetrahedron t;
        if (!t.setUp(at, q)) return;
        // Rays are straight from a node's cell to another one two cells away, and cells differ in how they stretch.
        const Mat3& j = t.placeRate;
        const Vec3 reach = 5.0 * (glm::abs(j[0]) + glm::abs(j[1]) + glm::abs(j[2])) + 1.0;
        const Vec3 low = glm::min(glm::min(q[0], q[1]), glm::min(q[2], q[3]));
        const Vec3 high = glm::max(glm::max(q[0], q[1]), glm::max(q[2], q[3]));
        if (from.wanted({low - reach, high + reach})) part.add(t);
    };
    const std::size_t count = cells.tetrahedra().size();
    parts_.resize((count + kPart - 1) / kPart);
    parallelFor(parts_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            for (std::size_t n = p * kPart; n < std::min((p + 1) * kPart, count); ++n) addWanted(n, parts_[p]);
    });
}

template <class Filled>
void CellBaker::fill(const Points& points, const Filled& filled) const {
    const Index3& count = points.count;
    const std::size_t row = std::size_t(count.x);
    const auto fillLayer = [&](const Tetrahedron& t, int k) {
        const double z = k + points.offset;
        if (t.low.z > z + kBeside || t.high.z < z - kBeside) return;
        const int first = std::max(ceilOf(t.low.y - points.offset - kBeside), 0);
        const double last = std::min(t.high.y - points.offset + kBeside, double(count.y - 1));
        for (int j = first; j <= last; ++j) {
            const std::size_t at = row * (std::size_t(j) + std::size_t(count.y) * std::size_t(k));
            t.fillRow(points.offset, j + points.offset, z, count.x,
                      [&](int i, const Vec3& place) { filled(at + std::size_t(i), Index3(i, j, k), place); });
        }
    };
    const int layers = (count.z + points.every - 1) / points.every;
    parallelFor(std::size_t(layers), kLayersAtOnce, [&](std::size_t begin, std::size_t end) {
        const float first = float(begin) * float(points.every) + float(points.offset);
        const float last = float(end - 1) * float(points.every) + float(points.offset);
        for (const Part& part : parts_)
            for (std::size_t n = 0; n < part.tetrahedra.size(); ++n) {
                const auto [from, to] = part.layers[n];
                if (from > last || to < first) continue;
                for (std::size_t layer = begin; layer < end; ++layer)
                    fillLayer(part.tetrahedra[n], int(layer) * points.every);
            }
    });
}

BakedMap CellBaker::bake() const {
    BakedMap map{grid_, std::vector<Vec4f>(grid_.nodeCount(), Vec4f(0))};
    fill({grid_.nodes, 0, 1},
         [&](std::size_t n, const Index3&, const Vec3& place) { map.node[n] = Vec4f(Vec3f(place), 1); });
    map.continueOutwards(1);
    return map;
}

std::vector<BakedMap::Known> CellBaker::centres(const std::vector<std::uint8_t>& seen) const {
    constexpr int kEvery = 4;
    const Index3 count = grid_.nodes - 1;
    std::vector<std::vector<BakedMap::Known>> layers(std::size_t(count.z / kEvery + 1));
    fill({count, 0.5, kEvery}, [&](std::size_t n, const Index3& cell, const Vec3& place) {
        if (seen[n]) layers[std::size_t(cell.z / kEvery)].push_back({Vec3(cell) + 0.5, place});
    });
    std::vector<BakedMap::Known> all;
    for (const auto& layer : layers) all.insert(all.end(), layer.begin(), layer.end());
    return all;
}

}  // namespace voledit
