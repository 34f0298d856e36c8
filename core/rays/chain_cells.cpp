#include "core/rays/chain_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/base/parallel.h"
#include "core/rays/chain_parts.h"
#include "core/stf/source_solid.h"

namespace voledit {

namespace {

constexpr int kCoarsest = 16;  // boxes along the longest side of the bounds, where no cells are given

/// Makes packets' cells of parts.
class PartCells {
public:
    PartCells(const CellWay& way, const Base& base, const ChainParts& chain) : way_(way), base_(base), chain_(chain) {
        Box3 bounds;
        for (const Vec3& p : base.p) bounds = join(bounds, p);
        result_.origin = bounds.empty() ? Vec3(0) : bounds.center();
        if (const MappedCells* cells = way.outerCells()) {
            ends_ = cells->sourceFaces();
            onEnd_ = 1e-6 * glm::length(sourceBox(*cells).size());
        }
    }

    PacketCells cells(const Found& found, bool turned) {
        const auto affine = verticesOf(found.affine), ragged = verticesOf(found.ragged);
        append(found.affine.size(), [&](std::size_t n, PacketCells& to) {
            const Part& part = found.affine[n];
            for (const auto& t : kHexahedronTetrahedra) appendAffine(part, t, affine[n], part.error, to);
        });
        // Tetrahedra of ragged parts that lie beside the cut are affine, too.
        append(found.ragged.size(), [&](std::size_t n, PacketCells& to) {
            for (const auto& t : kHexahedronTetrahedra) {
                const double error = errorOf(found.nodes[n], t);
                if (error <= chain_.tolerance()) appendAffine(found.ragged[n], t, ragged[n], error, to);
            }
        });
        result_.firstRagged = std::uint32_t(result_.cells.size());
        append(found.ragged.size(), [&](std::size_t n, PacketCells& to) {
            for (const auto& t : kHexahedronTetrahedra)
                if (!(errorOf(found.nodes[n], t) <= chain_.tolerance()) && mayShow(found.nodes[n], t))
                    appendRagged(found.ragged[n], t, ragged[n], to);
        });
        if (turned) turn();
        return std::move(result_);
    }

private:
    using Tetrahedron = std::array<int, 4>;
    using Vertices = std::array<std::uint32_t, 8>;

    template <class Body>
    void append(std::size_t parts, const Body& body) {
        const auto portions =
            inPortions<PacketCells>(parts, 128, [&](std::size_t begin, std::size_t end, PacketCells& to) {
                for (std::size_t n = begin; n < end; ++n) body(n, to);
            });
        const auto join = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
        for (const PacketCells& portion : portions) {
            join(result_.cells, portion.cells);
            join(result_.corners, portion.corners);
            join(result_.beyond, portion.beyond);
            join(result_.atEnd, portion.atEnd);
            join(result_.raggedGroup, portion.raggedGroup);
        }
    }

    std::vector<Vertices> verticesOf(const std::vector<Part>& parts) {
        std::vector<std::uint32_t> order(parts.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return parts[a].cell < parts[b].cell; });
        std::vector<Vertices> vertices(parts.size());
        for (const std::uint32_t n : order) vertices[n] = verticesOf(parts[n]);
        return vertices;
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

    /// Calls body(one, middle, other) with the places along each edge of a tetrahedron.
    template <class Body>
    static void forEdges(const Nodes& x, const Tetrahedron& t, const Body& body) {
        const auto at = [&](Index3 node) -> const Vec3& { return x[nodeAt(node.x, node.y, node.z)]; };
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = a + 1; b < 4; ++b) {
                const Index3 one = cornerOf(t[a]), other = cornerOf(t[b]);
                body(at(2 * one), at(one + other), at(2 * other));
            }
    }
    /// As for parts; NaN where a place is undefined.
    static double errorOf(const Nodes& x, const Tetrahedron& t) {
        double error = 0;
        bool whole = true;
        forEdges(x, t, [&](const Vec3& one, const Vec3& middle, const Vec3& other) {
            whole &= finite(one) && finite(middle) && finite(other);
            error = std::max(error, largestOf(middle - 0.5 * (one + other)));
        });
        return whole ? error : kNaN;
    }
    /// False where no place of a tetrahedron is defined, or what is lies away from everything visible.
    bool mayShow(const Nodes& x, const Tetrahedron& t) const {
        Box3 hull;
        double step = 0;
        forEdges(x, t, [&](const Vec3& one, const Vec3& middle, const Vec3& other) {
            for (const Vec3& at : {one, middle, other})
                if (finite(at)) hull = join(hull, at);
            for (const Vec3& at : {one, other})
                if (finite(at) && finite(middle)) step = std::max(step, largestOf(at - middle));
        });
        return !hull.empty() && (step == 0 || chain_.visible(hull, 0.01 + 2 * step));
    }

    void appendAffine(const Part& part, const Tetrahedron& t, const Vertices& vertices, double error,
                      PacketCells& to) const {
        std::array<Vec3, 4> x;
        Box3 hull;
        for (std::size_t v = 0; v < 4; ++v) hull = join(hull, x[v] = part.x[std::size_t(t[v])]);
        if (!chain_.visible(hull, 0.01 + 2 * error)) return;
        appendCell(t, vertices, x, sidesBeyond(hull, chain_.domain()), to);
    }
    void appendRagged(const Part& part, const Tetrahedron& t, const Vertices& vertices, PacketCells& to) const {
        std::array<Vec3, 4> q;
        for (std::size_t v = 0; v < 4; ++v) q[v] = q_[vertices[std::size_t(t[v])]];
        if (appendCell(t, vertices, q, 0, to)) to.raggedGroup.push_back(groupOf(part, t));
    }
    bool appendCell(const Tetrahedron& t, const Vertices& vertices, const std::array<Vec3, 4>& x, std::uint8_t sides,
                    PacketCells& to) const {
        std::array<std::uint32_t, 4> corners{};
        std::array<Vec3, 4> p;
        for (std::size_t v = 0; v < 4; ++v) {
            corners[v] = vertices[std::size_t(t[v])];
            p[v] = result_.position[corners[v]] - result_.origin;
        }
        if (flat(p)) return false;
        to.cells.push_back(packetCell(p, x));
        to.corners.push_back(corners);
        to.beyond.push_back(sides);
        if (!ends_.empty()) {
            std::array<Vec3, 4> q;
            for (std::size_t v = 0; v < 4; ++v) q[v] = q_[corners[v]];
            to.atEnd.push_back(touchesAny(ends_, q, onEnd_));
        }
        return true;
    }

    /// The tetrahedron of the whole cell that a part's lies in; one for all where p is q everywhere.
    std::uint32_t groupOf(const Part& part, const Tetrahedron& t) const {
        if (base_.jacobian.empty()) return 0;
        Index3 middle(0);
        for (const int c : t) middle += part.first + part.size * cornerOf(c);
        return 8 * part.cell + 4 * (middle.x > middle.y) + 2 * (middle.y > middle.z) + (middle.z > middle.x);
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
    const ChainParts& chain_;
    std::span<const Vec4> ends_;  // of the outermost map's cells, where …
    double onEnd_ = 0;            // … parts lie that are no further from them
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
    const ChainParts chain(way, look, base, wish.rough);
    return PartCells(way, base, chain).cells(chain.find(), wish.turned);
}

}  // namespace voledit
