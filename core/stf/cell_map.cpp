#include "core/stf/cell_map.h"

#include <cassert>

namespace voledit {

void CellMap::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    if (outside_ == Outside::Hide) return cells_.map(p, q);
    const std::vector<Vec3> before(p.begin(), p.end());  // q may alias p
    cells_.map(p, q);
    for (std::size_t i = 0; i < q.size(); ++i)
        if (!isDefined(q[i]) && isDefined(before[i])) q[i] = before[i];
}

void CellMap::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    CellLocation at{};
    std::uint32_t hint = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        jacobian[i] = cells_.cellCount() > 0 && cells_.locateNear(p[i], hint, at) ? cells_.jacobianAt(at) : Mat3(1.0);
}

Box3 CellMap::imageOf(const Box3& rest) const {
    Box3 image = outside_ == Outside::Keep ? rest : Box3{};
    for (std::size_t c = 0; c < cells_.cellCount(); ++c) {
        Box3 source, deformed;
        for (const auto vertex : cells_.cellVertices(c)) {
            source = join(source, cells_.source()[vertex]);
            deformed = join(deformed, cells_.deformed()[vertex]);
        }
        if (!intersect(source, rest).empty()) image = join(image, deformed);
    }
    return image;
}

bool CellMap::anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const {
    if (outside_ == Outside::Keep && found(box)) return true;
    return cells_.anySourceBox(box, found);
}

TransferPtr scaledCells(const SpatialTransferFunction& map, double amount) {
    const MappedCells& cells = *map.cells();
    MappedCells::Data data;
    data.deformed.assign(cells.deformed().begin(), cells.deformed().end());
    data.source.assign(cells.source().begin(), cells.source().end());
    data.jacobian.assign(cells.jacobians().begin(), cells.jacobians().end());
    data.hexahedra.assign(cells.hexahedra().begin(), cells.hexahedra().end());
    if (data.hexahedra.empty()) data.tetrahedra.assign(cells.tetrahedra().begin(), cells.tetrahedra().end());
    for (std::size_t v = 0; v < data.source.size(); ++v)
        data.source[v] = data.deformed[v] + amount * (data.source[v] - data.deformed[v]);
    for (Mat3& jacobian : data.jacobian) jacobian = Mat3(1) + amount * (jacobian - Mat3(1));
    return std::make_shared<CellMap>(std::move(data), map.outside());
}

}  // namespace voledit
