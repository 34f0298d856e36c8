#include "core/rays/chain_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "core/base/parallel.h"
#include "core/objects/term_bounds.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {

constexpr int kCoarsest = 16;         // boxes along the longest side of the bounds …
constexpr int kLevels = 3;            // … halved so many times less one
constexpr int kUnits = 1 << kLevels;  // places are counted in half sides of the smallest boxes: so many a coarsest side
// Of the maps' interpolation, voxels: found at the middles of edges, between which it may be a little larger.
constexpr double kTolerance = 0.08;

bool finite(const Vec3& v) {
    return std::isfinite(v.x + v.y + v.z);
}

double largestOf(const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Where the maps lead from the 3³ places of a box: its corners, and the middles of its edges, faces and itself.
using Nodes = std::array<Vec3, 27>;

constexpr std::size_t nodeAt(int i, int j, int k) {
    return std::size_t(i + 3 * (j + 3 * k));
}

enum class Kind : std::uint8_t { Empty, Affine, Ragged };

struct BoxCell {
    Index3 first;  // corner, units
    int size = kUnits;
    std::array<Vec3, 8> x{};  // at the corners, i + 2j + 4k
    double error = 0;         // voxels
};

/// Boxes found by one part of the work.
struct Found {
    std::vector<BoxCell> affine, ragged;

    void append(const Found& other) {
        affine.insert(affine.end(), other.affine.begin(), other.affine.end());
        ragged.insert(ragged.end(), other.ragged.begin(), other.ragged.end());
    }
};

/// Calls body(begin, end, result) for parts of [0, count), `grain` long, in parallel; gives the results in order.
template <class Result, class Body>
std::vector<Result> inParts(std::size_t count, std::size_t grain, const Body& body) {
    std::vector<Result> parts((count + grain - 1) / grain);
    parallelFor(parts.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) body(n * grain, std::min((n + 1) * grain, count), parts[n]);
    });
    return parts;
}

Found joined(const std::vector<Found>& parts) {
    Found all;
    for (const Found& part : parts) all.append(part);
    return all;
}

class ChainCells {
public:
    ChainCells(const CellWay& way, const VolumeLook& look)
        : way_(way), skip_(look.skip), domain_(look.volumeTerm().volume->grid().indexDomain()), box_(way.term->bounds) {
        const Vec3 extent = box_.size();
        const double side = std::max({extent.x, extent.y, extent.z}) / kCoarsest;
        if (box_.empty() || !(side > 0) || !std::isfinite(side)) return;
        count_ = glm::clamp(Index3(glm::ceil(extent / side - 0.01)), Index3(1), Index3(kCoarsest));
        unit_ = extent / Vec3(count_ * kUnits);
    }

    PacketCells cells(bool turned) {
        PacketCells result;
        result.origin = box_.empty() ? Vec3(0) : box_.center();
        const Found found = boxes();
        number(found, result);
        append(found.affine, true, result);
        result.firstRagged = std::uint32_t(result.cells.size());
        append(found.ragged, false, result);
        if (!turned) return result;
        result.turn.resize(result.position.size());
        parallelFor(result.position.size(), 512, [&](std::size_t begin, std::size_t end) {
            way_.turns(std::span(result.position).subspan(begin, end - begin),
                       std::span(result.turn).subspan(begin, end - begin));
        });
        return result;
    }

private:
    Vec3 place(Index3 units) const { return box_.min + Vec3(units) * unit_; }

    Found boxes() const {
        Found found = coarsest();
        Found all;
        std::swap(all.affine, found.affine);
        for (int size = kUnits / 2; size >= 2 && !found.ragged.empty(); size /= 2) {
            const std::vector<BoxCell> halved = std::exchange(found.ragged, {});
            found = halves(halved, size);
            all.affine.insert(all.affine.end(), found.affine.begin(), found.affine.end());
        }
        all.ragged = std::move(found.ragged);
        return all;
    }

    Found coarsest() const {
        if (count_.x == 0) return {};
        const Index3 nodes = 2 * count_ + 1;
        std::vector<Vec3> x(std::size_t(nodes.x) * std::size_t(nodes.y) * std::size_t(nodes.z));
        const std::size_t row = std::size_t(nodes.x);
        parallelFor(x.size() / row, 16, [&](std::size_t begin, std::size_t end) {
            const std::span<Vec3> part = std::span(x).subspan(begin * row, (end - begin) * row);
            for (std::size_t n = 0; n < part.size(); ++n) {
                const std::size_t line = begin + n / row;
                part[n] = place(kUnits / 2 * Index3(n % row, line % std::size_t(nodes.y), line / std::size_t(nodes.y)));
            }
            way_.toIndex(part, part);
        });
        const auto columns = std::size_t(count_.x), lines = std::size_t(count_.y);
        const auto decideAll = [&](std::size_t begin, std::size_t end, Found& to) {
            Nodes at;
            for (std::size_t n = begin; n < end; ++n) {
                const Index3 cell(n % columns, n / columns % lines, n / (columns * lines));
                for (int k = 0; k < 3; ++k)
                    for (int j = 0; j < 3; ++j)
                        for (int i = 0; i < 3; ++i) {
                            const Index3 node = 2 * cell + Index3(i, j, k);
                            at[nodeAt(i, j, k)] =
                                x[std::size_t(node.x) +
                                  row * (std::size_t(node.y) + std::size_t(nodes.y) * std::size_t(node.z))];
                        }
                decide(at, kUnits * cell, kUnits, to);
            }
        };
        return joined(inParts<Found>(columns * lines * std::size_t(count_.z), 64, decideAll));
    }

    /// The eight parts of each of `boxes`.
    Found halves(const std::vector<BoxCell>& boxes, int size) const {
        constexpr std::size_t kGrain = 8, kNodes = 125;
        const auto decideAll = [&](std::size_t begin, std::size_t end, Found& to) {
            std::array<Vec3, kGrain * kNodes> x;
            for (std::size_t n = begin; n < end; ++n)
                for (std::size_t m = 0; m < kNodes; ++m)
                    x[(n - begin) * kNodes + m] = place(boxes[n].first + size / 2 * Index3(m % 5, m / 5 % 5, m / 25));
            const std::span<Vec3> part = std::span(x).first((end - begin) * kNodes);
            way_.toIndex(part, part);
            Nodes at;
            for (std::size_t n = begin; n < end; ++n)
                for (int child = 0; child < 8; ++child) {
                    const Index3 corner(child & 1, child >> 1 & 1, child >> 2);
                    for (int k = 0; k < 3; ++k)
                        for (int j = 0; j < 3; ++j)
                            for (int i = 0; i < 3; ++i) {
                                const Index3 node = 2 * corner + Index3(i, j, k);
                                at[nodeAt(i, j, k)] =
                                    part[(n - begin) * kNodes + std::size_t(node.x + 5 * (node.y + 5 * node.z))];
                            }
                    decide(at, boxes[n].first + size * corner, size, to);
                }
        };
        return joined(inParts<Found>(boxes.size(), kGrain, decideAll));
    }

    void decide(const Nodes& x, Index3 first, int size, Found& to) const {
        BoxCell cell{first, size, {}, 0};
        const Kind kind = kindOf(x, cell);
        if (kind == Kind::Empty) return;
        for (int c = 0; c < 8; ++c) cell.x[std::size_t(c)] = x[nodeAt(2 * (c & 1), 2 * (c >> 1 & 1), 2 * (c >> 2))];
        (kind == Kind::Affine ? to.affine : to.ragged).push_back(cell);
    }

    Kind kindOf(const Nodes& x, BoxCell& cell) const {
        Box3 hull;
        int defined = 0;
        for (const Vec3& at : x)
            if (finite(at)) {
                hull = join(hull, at);
                ++defined;
            }
        if (defined == 0) {
            // What is smaller than the distance of the coarsest places may hide between them.
            const Box3 box{place(cell.first), place(cell.first + cell.size)};
            return cell.size == kUnits && mayBeVisible(*way_.term, box) ? Kind::Ragged : Kind::Empty;
        }
        const bool whole = defined == int(x.size());
        cell.error = whole ? errorOf(x) : 0;
        const double margin = 0.01 + (whole ? 2 * cell.error : 4 * largestStep(x));
        if (!skip_.mayBeVisible(intersect({hull.min - margin, hull.max + margin}, domain_))) return Kind::Empty;
        return whole && cell.error <= kTolerance ? Kind::Affine : Kind::Ragged;
    }

    /// How far the maps are from what lies between the corners along the tetrahedra's edges: at their middles.
    static double errorOf(const Nodes& x) {
        double error = 0;
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i) {
                    if (i != 1 && j != 1 && k != 1) continue;
                    const auto end = [&](int to) {
                        return x[nodeAt(i == 1 ? to : i, j == 1 ? to : j, k == 1 ? to : k)];
                    };
                    error = std::max(error, largestOf(x[nodeAt(i, j, k)] - 0.5 * (end(0) + end(2))));
                }
        return error;
    }

    /// The largest step between neighbours of which both are defined.
    static double largestStep(const Nodes& x) {
        double step = 0;
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i) {
                    const Vec3& at = x[nodeAt(i, j, k)];
                    const auto look = [&](const Vec3& other) {
                        const double length = largestOf(other - at);
                        if (std::isfinite(length)) step = std::max(step, length);
                    };
                    if (i < 2) look(x[nodeAt(i + 1, j, k)]);
                    if (j < 2) look(x[nodeAt(i, j + 1, k)]);
                    if (k < 2) look(x[nodeAt(i, j, k + 1)]);
                }
        return step;
    }

    std::size_t vertexIndex(Index3 units) const {
        const Index3 node = units / 2, nodes = kUnits / 2 * count_ + 1;
        return std::size_t(node.x) +
               std::size_t(nodes.x) * (std::size_t(node.y) + std::size_t(nodes.y) * std::size_t(node.z));
    }

    static Index3 cornerOf(const BoxCell& cell, int c) {
        return cell.first + cell.size * Index3(c & 1, c >> 1 & 1, c >> 2);
    }

    /// Gives the boxes' corners numbers and places.
    void number(const Found& found, PacketCells& result) {
        if (found.affine.empty() && found.ragged.empty()) return;
        const Index3 nodes = kUnits / 2 * count_ + 1;
        vertices_.assign(std::size_t(nodes.x) * std::size_t(nodes.y) * std::size_t(nodes.z), ~0U);
        for (const auto* boxes : {&found.affine, &found.ragged})
            for (const BoxCell& cell : *boxes)
                for (int c = 0; c < 8; ++c) {
                    const Index3 corner = cornerOf(cell, c);
                    std::uint32_t& vertex = vertices_[vertexIndex(corner)];
                    if (vertex != ~0U) continue;
                    vertex = std::uint32_t(result.position.size());
                    result.position.push_back(place(corner));
                }
    }

    /// The tetrahedra of `boxes` that can be seen.
    void append(const std::vector<BoxCell>& boxes, bool affine, PacketCells& result) const {
        const auto parts =
            inParts<PacketCells>(boxes.size(), 128, [&](std::size_t begin, std::size_t end, PacketCells& to) {
                for (std::size_t n = begin; n < end; ++n) appendBox(boxes[n], affine, result, to);
            });
        for (const PacketCells& part : parts) {
            result.cells.insert(result.cells.end(), part.cells.begin(), part.cells.end());
            result.corners.insert(result.corners.end(), part.corners.begin(), part.corners.end());
            result.beyond.insert(result.beyond.end(), part.beyond.begin(), part.beyond.end());
        }
    }

    void appendBox(const BoxCell& box, bool affine, const PacketCells& places, PacketCells& to) const {
        for (const auto& t : kHexahedronTetrahedra) {
            std::array<std::uint32_t, 4> corners{};
            std::array<Vec3, 4> p, x;
            Box3 hull;
            for (std::size_t v = 0; v < 4; ++v) {
                corners[v] = vertices_[vertexIndex(cornerOf(box, t[v]))];
                p[v] = places.position[corners[v]] - places.origin;
                x[v] = affine ? box.x[std::size_t(t[v])] : p[v];
                hull = join(hull, x[v]);
            }
            const double margin = 2 * box.error;
            if (affine && !skip_.mayBeVisible(intersect({hull.min - margin, hull.max + margin}, domain_))) continue;
            to.cells.push_back(packetCell(p, x));
            to.corners.push_back(corners);
            to.beyond.push_back(affine ? sidesBeyond(hull, domain_) : std::uint8_t(0));
        }
    }

    const CellWay& way_;
    const SkipGrid& skip_;
    Box3 domain_, box_;
    Index3 count_{0};
    Vec3 unit_{0};
    std::vector<std::uint32_t> vertices_;  // numbers of the corners that boxes have
};

}  // namespace

PacketCells chainCells(const CellWay& way, const VolumeLook& look, bool turned) {
    return ChainCells(way, look).cells(turned);
}

}  // namespace voledit
