#include "core/eval/baked_map.h"

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

/// A tetrahedron in grid coordinates: weights of its vertices and the place as affine functions.
struct GridTetrahedron {
    Vec3 low, high;  // box
    std::array<Vec3, 4> rate;
    std::array<double, 4> start;  // weights at the grid's origin
    Mat3 placeRate;               // columns: along the grid's axes
    Vec3 placeStart;
};

bool setUp(const std::array<Vec3, 4>& corner, const std::array<Vec3, 4>& place, GridTetrahedron& t) {
    const Vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], e3 = corner[3] - corner[0];
    const double volume = glm::dot(e1, glm::cross(e2, e3));
    if (volume == 0) return false;
    t.rate[1] = glm::cross(e2, e3) / volume;
    t.rate[2] = glm::cross(e3, e1) / volume;
    t.rate[3] = glm::cross(e1, e2) / volume;
    t.rate[0] = -(t.rate[1] + t.rate[2] + t.rate[3]);
    t.low = t.high = corner[0];
    for (std::size_t n = 0; n < 4; ++n) {
        t.start[n] = (n == 0) - glm::dot(t.rate[n], corner[0]);
        t.low = glm::min(t.low, corner[n]);
        t.high = glm::max(t.high, corner[n]);
    }
    t.placeRate = Mat3(0);
    for (std::size_t n = 1; n < 4; ++n) t.placeRate += glm::outerProduct(place[n] - place[0], t.rate[n]);
    t.placeStart = place[0] - t.placeRate * corner[0];
    return true;
}

/// The tetrahedra that are wanted, in their order.
std::vector<GridTetrahedron> wantedTetrahedra(const BakedCells& from, const BakeGrid& grid) {
    const MappedCells& cells = *from.cells;
    const Mat4 gridFromDeformed = grid.gridFromWorld() * from.worldFromDeformed;
    const std::size_t count = cells.tetrahedra().size();
    std::vector<Vec3> corner(cells.deformed().size()), place(corner.size());
    parallelFor(corner.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            corner[v] = transformPoint(gridFromDeformed, cells.deformed()[v]);
            place[v] = transformPoint(from.placeFromSource, cells.source()[v]);
        }
    });
    std::vector<GridTetrahedron> made(count);
    std::vector<char> taken(count, 0);
    parallelFor(count, 2048, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            if (cells.determinants()[n] == 0) continue;
            std::array<Vec3, 4> at, q;
            Box3 box;
            for (std::size_t c = 0; c < 4; ++c) {
                at[c] = corner[cells.tetrahedra()[n][c]];
                q[c] = place[cells.tetrahedra()[n][c]];
                box = join(box, q[c]);
            }
            if (!setUp(at, q, made[n])) continue;
            // Rays are straight from a node's cell to another one two cells away, and cells differ in how they stretch.
            const Mat3& j = made[n].placeRate;
            const Vec3 reach = 5.0 * (glm::abs(j[0]) + glm::abs(j[1]) + glm::abs(j[2])) + 1.0;
            taken[n] = from.wanted({box.min - reach, box.max + reach});
        }
    });
    std::size_t kept = 0;
    for (std::size_t n = 0; n < count; ++n)
        if (taken[n]) made[kept++] = made[n];
    made.resize(kept);
    return made;
}

/// Calls filled(i, place) for the points (i + offset, y, z) of one row, 0 ≤ i < count, that lie in the tetrahedron.
template <class Filled>
void fillRow(const GridTetrahedron& t, double offset, double y, double z, int count, const Filled& filled) {
    double low = t.low.x - offset - 1e-6, high = t.high.x - offset + 1e-6;
    for (std::size_t n = 0; n < 4; ++n) {
        const double weight = t.start[n] + t.rate[n].x * offset + t.rate[n].y * y + t.rate[n].z * z + kSlack;
        const double rate = t.rate[n].x;
        if (rate > 0)
            low = std::max(low, -weight / rate);
        else if (rate < 0)
            high = std::min(high, -weight / rate);
        else if (weight < 0)
            return;
    }
    const int first = std::max(int(std::ceil(low)), 0), last = std::min(int(std::floor(high)), count - 1);
    for (int i = first; i <= last; ++i) filled(i, t.placeStart + t.placeRate * Vec3(i + offset, y, z));
}

/// Fills layer k of nodes.
void fillLayer(const std::vector<GridTetrahedron>& tetrahedra, int k, BakedMap& map) {
    const Index3& nodes = map.grid.nodes;
    for (const GridTetrahedron& t : tetrahedra) {
        if (t.low.z > k + 1e-6 || t.high.z < k - 1e-6) continue;
        const int first = std::max(int(std::ceil(t.low.y - 1e-6)), 0);
        const int last = std::min(int(std::floor(t.high.y + 1e-6)), nodes.y - 1);
        for (int j = first; j <= last; ++j) {
            Vec4f* row = map.node.data() + map.grid.indexOf({0, j, k});
            fillRow(t, 0, j, k, nodes.x, [&](int i, const Vec3& place) { row[i] = Vec4f(Vec3f(place), 1); });
        }
    }
}

/// Continues runs of known nodes along a line linearly by kBakeBorder nodes at both ends, which get `mark`.
void continueLine(Vec4f* line, std::size_t stride, int count, float mark) {
    const auto at = [&](int n) -> Vec4f& { return line[std::size_t(n) * stride]; };
    /// Gives how many nodes it filled.
    const auto extend = [&](int edge, int direction, bool single) {
        const Vec4f rate = single ? Vec4f(0) : at(edge) - at(edge - direction);
        for (int r = 1; r <= kBakeBorder; ++r) {
            const int n = edge + direction * r;
            if (n < 0 || n >= count || at(n).w > 0) return r - 1;
            at(n) = Vec4f(Vec3f(at(edge) + float(r) * rate), mark);
        }
        return kBakeBorder;
    };
    for (int n = 0; n < count; ++n) {
        if (!(at(n).w > 0)) continue;
        int end = n;
        while (end + 1 < count && at(end + 1).w > 0) ++end;
        const bool single = n == end;
        extend(n, -1, single);
        n = end + extend(end, 1, single);
    }
}

void continueOutwards(BakedMap& map, float mark) {
    const Index3& nodes = map.grid.nodes;
    const std::size_t row = std::size_t(nodes.x), layer = row * std::size_t(nodes.y);
    parallelFor(std::size_t(nodes.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            for (int j = 0; j < nodes.y; ++j)
                continueLine(map.node.data() + k * layer + std::size_t(j) * row, 1, nodes.x, mark);
            for (int i = 0; i < nodes.x; ++i)
                continueLine(map.node.data() + k * layer + std::size_t(i), row, nodes.y, mark);
        }
    });
    parallelFor(std::size_t(nodes.y), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j)
            for (int i = 0; i < nodes.x; ++i)
                continueLine(map.node.data() + j * row + std::size_t(i), layer, nodes.z, mark);
    });
}

}  // namespace

Mat4 BakeGrid::gridFromWorld() const {
    Mat4 m(1 / cell);
    m[3] = Vec4(-origin / cell, 1);
    return m;
}

BakeGrid bakeGrid(const Box3& bounds, int most) {
    BakeGrid grid;
    const Vec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z, 1e-30});
    grid.cell = longest / std::max(most - 1 - 2 * kBakeBorder, 1);
    for (int a = 0; a < 3; ++a)
        grid.nodes[a] = std::max(int(std::ceil(size[a] / grid.cell - 1e-9)), 1) + 1 + 2 * kBakeBorder;
    grid.origin = bounds.center() - 0.5 * grid.cell * Vec3(grid.nodes - 1);
    return grid;
}

Mat3 BakedMap::jacobianAt(Index3 n) const {
    Mat3 j(0);
    const Vec4f& here = node[grid.indexOf(n)];
    if (!(here.w > 0)) return j;
    for (int a = 0; a < 3; ++a) {
        const auto neighbour = [&](int d) {
            Index3 other = n;
            other[a] += d;
            const bool within = other[a] >= 0 && other[a] < grid.nodes[a];
            return within ? node[grid.indexOf(other)] : Vec4f(0);
        };
        const Vec4f ahead = neighbour(1), behind = neighbour(-1);
        const Vec4f& to = ahead.w > 0 ? ahead : here;
        const Vec4f& from = behind.w > 0 ? behind : here;
        const int cells = (ahead.w > 0) + (behind.w > 0);
        if (cells > 0) j[a] = Vec3(Vec3f(to) - Vec3f(from)) / (cells * grid.cell);
    }
    return j;
}

bool BakedMap::at(const Vec3& p, Vec3& place) const {
    const Vec3 x = glm::clamp((p - grid.origin) / grid.cell, Vec3(0), Vec3(grid.nodes - 1));
    const Index3 below = glm::min(Index3(x), grid.nodes - 2);
    const Vec3 f = x - Vec3(below);
    place = Vec3(0);
    for (int c = 0; c < 8; ++c) {
        const Index3 corner(c & 1, c >> 1 & 1, c >> 2);
        const Vec4f& n = node[grid.indexOf(below + corner)];
        if (!(n.w > 0)) return false;
        const Vec3 w = glm::mix(1.0 - f, f, Vec3(corner));
        place += w.x * w.y * w.z * Vec3(Vec3f(n));
    }
    return true;
}

bool BakedMap::surelyKnownAt(const Vec3& p) const {
    const Index3 below = glm::clamp(Index3((p - grid.origin) / grid.cell), Index3(0), grid.nodes - 2);
    for (int c = 0; c < 8; ++c)
        if (node[grid.indexOf(below + Index3(c & 1, c >> 1 & 1, c >> 2))].w < 1) return false;
    return true;
}

BakedMap bake(const BakedCells& cells, const BakeGrid& grid) {
    BakedMap map{grid, std::vector<Vec4f>(grid.nodeCount(), Vec4f(0))};
    const auto tetrahedra = wantedTetrahedra(cells, grid);
    parallelFor(std::size_t(grid.nodes.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) fillLayer(tetrahedra, int(k), map);
    });
    continueOutwards(map, 1);
    return map;
}

namespace {

/// How far interpolation is from `exact`, the place of p.
double errorAt(const BakedMap& map, const Vec3& p, const Vec3& exact, double straight) {
    Vec3 place;
    if (straight == 0) return map.at(p, place) ? glm::length(place - exact) : 0;
    double worst = 0;
    for (int a = 0; a < 3; ++a) {
        Vec3 half(0), other;
        half[a] = straight / 2;
        if (map.at(p - half, place) && map.at(p + half, other))
            worst = std::max(worst, glm::length(0.5 * (place + other) - exact));
    }
    return worst;
}

}  // namespace

double bakeError(const BakedMap& map, const BakedCells& cells, const std::vector<std::uint8_t>& seen, double straight) {
    constexpr int kEvery = 4;
    const BakeGrid& grid = map.grid;
    const Index3 count = grid.nodes - 1;
    const auto tetrahedra = wantedTetrahedra(cells, grid);
    const std::size_t layers = std::size_t((count.z + kEvery - 1) / kEvery);
    std::vector<double> worst(layers, 0);
    parallelFor(layers, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t layer = begin; layer < end; ++layer) {
            const int k = int(layer) * kEvery;
            for (const GridTetrahedron& t : tetrahedra) {
                if (t.low.z > k + 0.5 || t.high.z < k + 0.5) continue;
                const int first = std::max(int(std::ceil(t.low.y - 0.5)), 0);
                const int last = std::min(int(std::floor(t.high.y - 0.5)), count.y - 1);
                for (int j = first; j <= last; ++j) {
                    const std::uint8_t* row =
                        seen.data() + std::size_t(count.x) * (std::size_t(j) + std::size_t(count.y) * std::size_t(k));
                    fillRow(t, 0.5, j + 0.5, k + 0.5, count.x, [&](int i, const Vec3& exact) {
                        const Vec3 p = grid.origin + grid.cell * (Vec3(i, j, k) + 0.5);
                        if (row[i]) worst[layer] = std::max(worst[layer], errorAt(map, p, exact, straight));
                    });
                }
            }
        }
    });
    return worst.empty() ? 0 : *std::max_element(worst.begin(), worst.end());
}

BakedMap bake(const PlaceMap& exact, const BakeGrid& grid) {
    BakedMap map{grid, std::vector<Vec4f>(grid.nodeCount(), Vec4f(0))};
    parallelFor(std::size_t(grid.nodes.y) * std::size_t(grid.nodes.z), 8, [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> p;
        for (std::size_t row = begin; row < end; ++row)
            for (int i = 0; i < grid.nodes.x; ++i)
                p.push_back(grid.origin + grid.cell * Vec3(i, int(row) % grid.nodes.y, int(row) / grid.nodes.y));
        exact(p, p);
        Vec4f* node = map.node.data() + begin * std::size_t(grid.nodes.x);
        for (const Vec3& place : p) {
            if (isDefined(place)) *node = Vec4f(Vec3f(place), 1);
            ++node;
        }
    });
    continueOutwards(map, BakedMap::kContinued);
    return map;
}

double bakeError(const BakedMap& map, const PlaceMap& exact, const std::vector<std::uint8_t>& seen, double straight) {
    const BakeGrid& grid = map.grid;
    const Index3 count = grid.nodes - 1;
    std::vector<double> worst(std::size_t(count.z), 0);
    parallelFor(std::size_t(count.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            std::vector<Vec3> p, place;
            const std::uint8_t* flag = seen.data() + k * std::size_t(count.x) * std::size_t(count.y);
            for (int j = 0; j < count.y; ++j)
                for (int i = 0; i < count.x; ++i)
                    if (*flag++) p.push_back(grid.origin + grid.cell * (Vec3(i, j, int(k)) + 0.5));
            place.resize(p.size());
            exact(p, place);
            for (std::size_t n = 0; n < p.size(); ++n)
                worst[k] = std::max(worst[k], isDefined(place[n]) && map.surelyKnownAt(p[n])
                                                  ? errorAt(map, p[n], place[n], straight)
                                                  : kInfinity);
        }
    });
    return worst.empty() ? 0 : *std::max_element(worst.begin(), worst.end());
}

}  // namespace voledit
