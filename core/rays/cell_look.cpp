#include "core/rays/cell_look.h"

#include <algorithm>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/rays/chain_cells.h"
#include "core/stf/source_solid.h"

namespace voledit {

namespace {

constexpr double kOnEnd = 1e-3;  // voxels: how far from a face of their solid cells at it may lie

/// Where cells' sources lie in index space, and which of them can be seen.
class Sources {
public:
    Sources(const CellWay& way, const VolumeLook& look)
        : cells_(*way.by.front()->cells()),
          skip_(look.skip()),
          domain_(look.volumeTerm().volume->grid().indexDomain()),
          index_(cells_.source().size()) {
        for (std::size_t v = 0; v < index_.size(); ++v)
            index_[v] = transformPoint(way.indexFromRest, cells_.source()[v]);
    }

    const Vec3& operator[](std::uint32_t vertex) const { return index_[vertex]; }

    /// Tetrahedra that can be seen, in order.
    std::vector<std::uint32_t> visibleOnes() const {
        const std::uint32_t perCell = cells_.tetrahedraPerCell();
        std::vector<std::uint8_t> seen(cells_.tetrahedra().size(), 0);
        parallelFor(cells_.cellCount(), 512, [&](std::size_t begin, std::size_t end) {
            for (std::size_t cell = begin; cell < end; ++cell) {
                if (!visible(box(cells_.cellVertices(cell)))) continue;
                for (std::size_t t = cell * perCell; t < (cell + 1) * perCell; ++t)
                    seen[t] = cells_.determinants()[t] != 0 && visible(cells_.tetrahedra()[t]);
            }
        });
        std::vector<std::uint32_t> result;
        for (std::size_t t = 0; t < seen.size(); ++t)
            if (seen[t]) result.push_back(std::uint32_t(t));
        return result;
    }

    std::uint8_t beyond(const std::array<std::uint32_t, 4>& corners) const {
        return sidesBeyond(box(corners), domain_);
    }

private:
    template <class Corners>
    Box3 box(const Corners& corners) const {
        Box3 box;
        for (const std::uint32_t v : corners) box = join(box, index_[v]);
        return box;
    }
    /// By the boxes of a tetrahedron's halves: its own reaches far beyond it.
    bool visible(const std::array<std::uint32_t, 4>& corners) const {
        if (!visible(box(corners))) return false;
        Box3 inner;
        for (std::size_t a = 0; a < 4; ++a) {
            Box3 outer;
            for (std::size_t b = 0; b < 4; ++b) outer = join(outer, 0.5 * (index_[corners[a]] + index_[corners[b]]));
            if (visible(outer)) return true;
            for (std::size_t b = a + 1; b < 4; ++b)
                inner = join(inner, 0.5 * (index_[corners[a]] + index_[corners[b]]));
        }
        return visible(inner);
    }
    bool visible(const Box3& box) const { return skip_.mayBeVisible(intersect(box, domain_)); }

    const MappedCells& cells_;
    const SkipGrid& skip_;
    Box3 domain_;
    std::vector<Vec3> index_;
};

PacketCells mappedCells(const CellWay& way, const VolumeLook& look, bool turned) {
    const MappedCells& mapped = *way.by.front()->cells();
    const Sources sources(way, look);
    const std::vector<std::uint32_t> which = sources.visibleOnes();
    PacketCells result;
    result.origin = mapped.bounds().empty() ? Vec3(0) : mapped.bounds().center();
    result.position.assign(mapped.deformed().begin(), mapped.deformed().end());
    result.turn.resize(turned ? result.position.size() : 0);
    parallelFor(result.turn.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) result.turn[v] = way.turnOf(mapped.jacobians()[v]);
    });
    result.cells.resize(which.size());
    result.corners.resize(which.size());
    result.beyond.resize(which.size());
    const Box3 domain = look.volumeTerm().volume->grid().indexDomain();
    const std::vector<Vec4> ends =
        turned ? facesThrough(sourceFacesIn(mapped, way.indexFromRest), domain) : std::vector<Vec4>();
    if (!ends.empty()) result.atEnd.resize(which.size());
    parallelFor(which.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
            const auto& corners = mapped.tetrahedra()[which[n]];
            std::array<Vec3, 4> p, x;
            for (std::size_t v = 0; v < 4; ++v) {
                p[v] = mapped.deformed()[corners[v]] - result.origin;
                x[v] = sources[corners[v]];
            }
            result.cells[n] = packetCell(p, x);
            result.corners[n] = corners;
            result.beyond[n] = sources.beyond(corners);
            if (!ends.empty()) result.atEnd[n] = touchesAny(ends, x, kOnEnd);
        }
    });
    return result;
}

}  // namespace

bool CellWay::isMappedCells() const {
    return by.size() == 1 && by.front()->cells() && by.front()->outside() == Outside::Hide;
}

const MappedCells* CellWay::outerCells() const {
    const MappedCells* cells = by.front()->cells();
    return cells && by.front()->outside() == Outside::Hide && !cells->hexahedra().empty() ? cells : nullptr;
}

void CellWay::toIndex(std::span<const Vec3> q, std::span<Vec3> x) const {
    if (q.data() != x.data()) std::copy(q.begin(), q.end(), x.begin());
    for (std::size_t n = outerCells() ? 1 : 0; n < by.size(); ++n) by[n]->map(x, x);
    for (Vec3& at : x) at = transformPoint(indexFromRest, at);
}

void CellWay::turns(std::span<const Vec3> q, std::span<const Mat3> outer, std::span<GradientTurn> turn) const {
    std::vector<Vec3> at(q.begin(), q.end());
    std::vector<Mat3> whole(q.size(), Mat3(1)), jacobian(q.size());
    std::copy(outer.begin(), outer.end(), whole.begin());
    for (std::size_t n = outerCells() ? 1 : 0; n < by.size(); ++n) {
        by[n]->jacobian(at, jacobian);
        for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = jacobian[i] * whole[i];
        if (n + 1 < by.size()) by[n]->map(at, at);
    }
    for (std::size_t i = 0; i < whole.size(); ++i) turn[i] = turnOf(whole[i]);
}

GradientTurn CellWay::turnOf(const Mat3& jacobian) const {
    return gradientTurn(glm::transpose(Mat3(indexFromRest) * jacobian * Mat3(cellsFromWorld)));
}

std::shared_ptr<const CellLook> cellLook(const CellWay& way, std::shared_ptr<const VolumeLook> look, CellWish wish,
                                         const std::shared_ptr<const CellLook>& previous) {
    auto result = std::make_shared<CellLook>();
    if (previous && previous->look->grid == look->grid && previous->turned >= wish.turned &&
        previous->rough <= wish.rough && previous->way == way) {
        if (previous->look == look) return previous;
        *result = *previous;
        result->look = std::move(look);
        return result;
    }
    result->way = way;
    result->look = std::move(look);
    result->turned = wish.turned;
    result->rough = wish.rough && !way.isMappedCells();
    PacketCells cells =
        way.isMappedCells() ? mappedCells(way, *result->look, wish.turned) : chainCells(way, *result->look, wish);
    for (int a = 0; a < 3; ++a)
        cells.last[std::size_t(a)] = float(result->look->volumeTerm().volume->grid().size[a] - 1);
    cells.findBounds();
    result->packed = std::make_shared<const PacketCells>(std::move(cells));
    return result;
}

}  // namespace voledit
