#include "core/rays/chain_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/objects/term_bounds.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {

constexpr int kCoarsest = 16;           // boxes along the longest side of the bounds, where no cells are given …
constexpr int kHalvings = 2;            // … and how often boxes and cells may be halved
constexpr int kUnits = 2 << kHalvings;  // places in a cell are counted in half sides of the smallest parts
// Of the maps' interpolation, voxels: found at the middles of edges, between which it may be a little larger.
constexpr double kTolerance = 0.1, kRoughTolerance = 0.5;

bool finite(const Vec3& v) {
    return std::isfinite(v.x + v.y + v.z);
}

double largestOf(const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Hexahedra to begin with: at each vertex its place p, and the place q where the maps go on from there.
struct Base {
    std::span<const Vec3> p, q;
    std::span<const Mat3> jacobian;  // dq/dp; empty where q = p
    std::span<const std::array<std::uint32_t, 8>> cells;
};

/// A value within a hexahedron that is affine in each of its six tetrahedra, at `units`, from those at its corners.
/// Halves of such hexahedra are such hexahedra again: their tetrahedra lie within those of the whole.
template <class T>
T within(std::span<const T> values, const std::array<std::uint32_t, 8>& cell, Index3 units) {
    std::array<int, 3> axes{0, 1, 2};
    const auto order = [&](std::size_t a, std::size_t b) {
        if (units[axes[b]] > units[axes[a]]) std::swap(axes[a], axes[b]);
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    T result = values[cell[0]];
    std::size_t corner = 0;
    for (const int axis : axes) {
        if (units[axis] == 0) break;
        const std::size_t next = corner + (std::size_t(1) << axis);
        result += double(units[axis]) / kUnits * (values[cell[next]] - values[cell[corner]]);
        corner = next;
    }
    return result;
}

/// Where the maps lead from the 3³ places of a part: its corners, and the middles of its edges, faces and itself.
using Nodes = std::array<Vec3, 27>;

constexpr std::size_t nodeAt(int i, int j, int k) {
    return std::size_t(i + 3 * (j + 3 * k));
}
Index3 cornerOf(int c) {
    return {c & 1, c >> 1 & 1, c >> 2};
}

enum class Kind : std::uint8_t { Empty, Affine, Ragged };

/// A cell or a part of one.
struct Part {
    std::uint32_t cell = 0;
    Index3 first{0};  // corner, units
    int size = kUnits;
    std::array<Vec3, 8> x{};  // index space, at the corners
    double error = 0;         // voxels
};

/// Parts found by one portion of the work.
struct Found {
    std::vector<Part> affine, ragged;
    std::vector<Nodes> nodes;  // of the ragged ones

    void append(const Found& other) {
        affine.insert(affine.end(), other.affine.begin(), other.affine.end());
        ragged.insert(ragged.end(), other.ragged.begin(), other.ragged.end());
        nodes.insert(nodes.end(), other.nodes.begin(), other.nodes.end());
    }
};

/// Calls body(begin, end, result) for portions of [0, count), `grain` long, in parallel; gives the results in order.
template <class Result, class Body>
std::vector<Result> inPortions(std::size_t count, std::size_t grain, const Body& body) {
    std::vector<Result> portions((count + grain - 1) / grain);
    parallelFor(portions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) body(n * grain, std::min((n + 1) * grain, count), portions[n]);
    });
    return portions;
}

Found joined(const std::vector<Found>& portions) {
    Found all;
    std::size_t affine = 0, ragged = 0;
    for (const Found& portion : portions) {
        affine += portion.affine.size();
        ragged += portion.ragged.size();
    }
    all.affine.reserve(affine);
    all.ragged.reserve(ragged);
    all.nodes.reserve(ragged);
    for (const Found& portion : portions) all.append(portion);
    return all;
}

/// How far the maps are from what lies between the corners along the tetrahedra's edges: at their middles.
double errorOf(const Nodes& x) {
    double error = 0;
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                if (i != 1 && j != 1 && k != 1) continue;
                const auto end = [&](int to) { return x[nodeAt(i == 1 ? to : i, j == 1 ? to : j, k == 1 ? to : k)]; };
                error = std::max(error, largestOf(x[nodeAt(i, j, k)] - 0.5 * (end(0) + end(2))));
            }
    return error;
}

/// The largest step between neighbours of which both are defined.
double largestStep(const Nodes& x) {
    double step = 0;
    const auto compare = [&](const Vec3& one, const Vec3& other) {
        const double length = largestOf(other - one);
        if (std::isfinite(length)) step = std::max(step, length);
    };
    for (int k = 0; k < 3; ++k)
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                const Vec3& at = x[nodeAt(i, j, k)];
                if (i < 2) compare(at, x[nodeAt(i + 1, j, k)]);
                if (j < 2) compare(at, x[nodeAt(i, j + 1, k)]);
                if (k < 2) compare(at, x[nodeAt(i, j, k + 1)]);
            }
    return step;
}

class ChainCells {
public:
    ChainCells(const CellWay& way, const VolumeLook& look, const Base& base, bool rough)
        : way_(way),
          base_(base),
          tolerance_(rough ? kRoughTolerance : kTolerance),
          smallest_(rough ? kUnits / 2 : 2),
          skip_(look.skip()),
          domain_(look.volumeTerm().volume->grid().indexDomain()) {}

    /// Sorts all cells into affine and ragged parts.
    Found parts() const {
        std::vector<Vec3> x(base_.q.size());
        parallelFor(x.size(), 512, [&](std::size_t begin, std::size_t end) {
            way_.toIndex(base_.q.subspan(begin, end - begin), std::span(x).subspan(begin, end - begin));
        });
        Found found =
            joined(inPortions<Found>(base_.cells.size(), 32, [&](std::size_t begin, std::size_t end, Found& to) {
                Asked asked;
                for (std::size_t n = begin; n < end; ++n) {
                    Nodes at;
                    for (int c = 0; c < 8; ++c) at[cornerNode(c)] = x[base_.cells[n][std::size_t(c)]];
                    ask({std::uint32_t(n), Index3(0), kUnits, {}, 0}, at, asked);
                }
                decide(asked, to);
            }));
        std::vector<Part> affine = std::move(found.affine);
        for (int size = kUnits / 2; size >= smallest_ && !found.ragged.empty(); size /= 2) {
            const Found halved = std::exchange(found, {});
            found =
                joined(inPortions<Found>(halved.ragged.size(), 8, [&](std::size_t begin, std::size_t end, Found& to) {
                    Asked asked;
                    for (std::size_t n = begin; n < end; ++n) askHalves(halved.ragged[n], halved.nodes[n], asked);
                    decide(asked, to);
                }));
            affine.insert(affine.end(), found.affine.begin(), found.affine.end());
        }
        found.affine = std::move(affine);
        return found;
    }

    bool visible(const Box3& box, double margin) const {
        return skip_.mayBeVisible(intersect({box.min - margin, box.max + margin}, domain_));
    }
    const Box3& domain() const { return domain_; }

private:
    /// Parts whose corners are known; the places at their middles stand in `places`, part after part.
    struct Asked {
        std::vector<Part> parts;
        std::vector<Nodes> nodes;
        std::vector<Vec3> places;
    };
    static constexpr std::size_t cornerNode(int c) { return nodeAt(2 * (c & 1), 2 * (c >> 1 & 1), 2 * (c >> 2)); }
    static bool isCorner(std::size_t node) { return node % 3 != 1 && node / 3 % 3 != 1 && node / 9 != 1; }

    /// Asks for a part's middles, unless its corners tell that it cannot be near anything visible.
    void ask(const Part& part, const Nodes& corners, Asked& asked) const {
        Box3 hull;
        bool whole = true;
        for (int c = 0; c < 8; ++c) {
            whole &= finite(corners[cornerNode(c)]);
            hull = join(hull, corners[cornerNode(c)]);
        }
        if (whole && !visible(hull, 0.5 * largestOf(hull.max - hull.min))) return;
        asked.parts.push_back(part);
        asked.nodes.push_back(corners);
        for (std::size_t m = 0; m < 27; ++m)
            if (!isCorner(m))
                asked.places.push_back(within(base_.q, base_.cells[part.cell],
                                              part.first + part.size / 2 * Index3(m % 3, m / 3 % 3, m / 9)));
    }
    void askHalves(const Part& part, const Nodes& x, Asked& asked) const {
        for (int half = 0; half < 8; ++half) {
            Nodes corners;
            for (int c = 0; c < 8; ++c) {
                const Index3 node = cornerOf(half) + cornerOf(c);
                corners[cornerNode(c)] = x[nodeAt(node.x, node.y, node.z)];
            }
            const int size = part.size / 2;
            ask({part.cell, part.first + size * cornerOf(half), size, {}, 0}, corners, asked);
        }
    }

    void decide(Asked& asked, Found& to) const {
        way_.toIndex(asked.places, asked.places);
        std::size_t next = 0;
        for (std::size_t n = 0; n < asked.parts.size(); ++n) {
            Nodes& x = asked.nodes[n];
            for (std::size_t m = 0; m < x.size(); ++m)
                if (!isCorner(m)) x[m] = asked.places[next++];
            Part& part = asked.parts[n];
            const Kind kind = kindOf(x, part);
            if (kind == Kind::Empty) continue;
            for (int c = 0; c < 8; ++c) part.x[std::size_t(c)] = x[cornerNode(c)];
            (kind == Kind::Affine ? to.affine : to.ragged).push_back(part);
            if (kind == Kind::Ragged) to.nodes.push_back(x);
        }
    }

    Kind kindOf(const Nodes& x, Part& part) const {
        Box3 hull;
        int defined = 0;
        for (const Vec3& at : x)
            if (finite(at)) {
                hull = join(hull, at);
                ++defined;
            }
        if (defined == 0) return part.size == kUnits && mayHide(part) ? Kind::Ragged : Kind::Empty;
        const bool whole = defined == int(x.size());
        part.error = whole ? errorOf(x) : 0;
        if (!visible(hull, 0.01 + (whole ? 2 * part.error : 2 * largestStep(x)))) return Kind::Empty;
        return whole && part.error <= tolerance_ ? Kind::Affine : Kind::Ragged;
    }

    /// Whether something smaller than the distance of a whole cell's places may hide between them.
    bool mayHide(const Part& part) const {
        Box3 box;
        for (const std::uint32_t v : base_.cells[part.cell]) box = join(box, base_.p[v]);
        return mayBeVisible(*way_.term, box);
    }

    const CellWay& way_;
    const Base& base_;
    double tolerance_;  // voxels
    int smallest_;      // size of parts
    const SkipGrid& skip_;
    Box3 domain_;
};

/// Makes packets' cells of parts.
class PartCells {
public:
    PartCells(const CellWay& way, const Base& base, const ChainCells& chain) : way_(way), base_(base), chain_(chain) {
        Box3 bounds;
        for (const Vec3& p : base.p) bounds = join(bounds, p);
        result_.origin = bounds.empty() ? Vec3(0) : bounds.center();
    }

    PacketCells cells(const Found& found, bool turned) {
        append(found.affine, true);
        result_.firstRagged = std::uint32_t(result_.cells.size());
        append(found.ragged, false);
        if (turned) turn();
        return std::move(result_);
    }

private:
    /// The six tetrahedra of each part, without those that show nothing.
    void append(const std::vector<Part>& parts, bool affine) {
        std::vector<std::uint32_t> order(parts.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return parts[a].cell < parts[b].cell; });
        std::vector<std::array<std::uint32_t, 8>> vertices(parts.size());
        for (const std::uint32_t n : order) vertices[n] = verticesOf(parts[n]);
        const auto portions =
            inPortions<PacketCells>(parts.size(), 128, [&](std::size_t begin, std::size_t end, PacketCells& to) {
                for (std::size_t n = begin; n < end; ++n) appendPart(parts[n], vertices[n], affine, to);
            });
        for (const PacketCells& portion : portions) {
            result_.cells.insert(result_.cells.end(), portion.cells.begin(), portion.cells.end());
            result_.corners.insert(result_.corners.end(), portion.corners.begin(), portion.corners.end());
            result_.beyond.insert(result_.beyond.end(), portion.beyond.begin(), portion.beyond.end());
        }
    }

    /// Numbers of a part's corners, shared by the parts of a cell.
    std::array<std::uint32_t, 8> verticesOf(const Part& part) {
        if (part.cell != cell_) numbers_.fill(~0U);
        cell_ = part.cell;
        std::array<std::uint32_t, 8> result{};
        for (int c = 0; c < 8; ++c) {
            const Index3 units = part.first + part.size * cornerOf(c), at = units / 2;
            std::uint32_t& number = numbers_[std::size_t(at.x + kSide * (at.y + kSide * at.z))];
            if (number == ~0U) {
                number = std::uint32_t(result_.position.size());
                const auto& corners = base_.cells[part.cell];
                result_.position.push_back(within(base_.p, corners, units));
                q_.push_back(within(base_.q, corners, units));
                if (!base_.jacobian.empty()) result_.outer.push_back(within(base_.jacobian, corners, units));
            }
            result[std::size_t(c)] = number;
        }
        return result;
    }

    void appendPart(const Part& part, const std::array<std::uint32_t, 8>& vertices, bool affine,
                    PacketCells& to) const {
        for (const auto& t : kHexahedronTetrahedra) {
            std::array<std::uint32_t, 4> corners{};
            std::array<Vec3, 4> p, x;
            Box3 hull;
            for (std::size_t v = 0; v < 4; ++v) {
                corners[v] = vertices[std::size_t(t[v])];
                p[v] = result_.position[corners[v]] - result_.origin;
                x[v] = affine ? part.x[std::size_t(t[v])] : q_[corners[v]];
                hull = join(hull, x[v]);
            }
            if (flat(p) || (affine && !chain_.visible(hull, 0.01 + 2 * part.error))) continue;
            to.cells.push_back(packetCell(p, x));
            to.corners.push_back(corners);
            to.beyond.push_back(affine ? sidesBeyond(hull, chain_.domain()) : std::uint8_t(0));
        }
    }

    static bool flat(const std::array<Vec3, 4>& p) {
        const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
        const double longest = std::max({glm::length(a), glm::length(b), glm::length(c)});
        return !(std::abs(glm::dot(glm::cross(a, b), c)) > 1e-9 * longest * longest * longest);
    }

    void turn() {
        result_.turn.resize(q_.size());
        parallelFor(q_.size(), 256, [&](std::size_t begin, std::size_t end) {
            const std::size_t count = end - begin;
            way_.turns(std::span(q_).subspan(begin, count),
                       result_.outer.empty() ? std::span<const Mat3>() : std::span(result_.outer).subspan(begin, count),
                       std::span(result_.turn).subspan(begin, count));
        });
    }

    static constexpr int kSide = kUnits / 2 + 1;
    const CellWay& way_;
    const Base& base_;
    const ChainCells& chain_;
    PacketCells result_;
    std::vector<Vec3> q_;       // of the vertices
    std::uint32_t cell_ = ~0U;  // whose corners have …
    std::array<std::uint32_t, std::size_t(kSide* kSide* kSide)> numbers_{};
};

/// Boxes over the bounds of what is shown.
MappedCells::Data boxes(const Box3& bounds) {
    const Vec3 extent = bounds.size();
    const double side = std::max({extent.x, extent.y, extent.z}) / kCoarsest;
    if (bounds.empty() || !(std::min({extent.x, extent.y, extent.z}) > 0) || !std::isfinite(side)) return {};
    return gridCells(frameOf(bounds),
                     glm::clamp(Index3(glm::ceil(extent / side - 0.01)), Index3(1), Index3(kCoarsest)));
}

}  // namespace

PacketCells chainCells(const CellWay& way, const VolumeLook& look, CellWish wish) {
    MappedCells::Data data;
    Base base;
    if (const MappedCells* cells = way.outerCells()) {
        base = {cells->deformed(), cells->source(), cells->jacobians(), cells->hexahedra()};
    } else {
        data = boxes(way.term->bounds);
        base = {data.deformed, data.source, {}, data.hexahedra};
    }
    const ChainCells chain(way, look, base, wish.rough);
    return PartCells(way, base, chain).cells(chain.parts(), wish.turned);
}

}  // namespace voledit
