#include "core/stf/scaled_cells.h"

#include <algorithm>
#include <cassert>

#include "core/base/parallel.h"

namespace voledit {

namespace {

MappedCells::Data scaledCells(const MappedCells& cells, double amount) {
    MappedCells::Data data;
    data.deformed.assign(cells.deformed().begin(), cells.deformed().end());
    data.source.assign(cells.source().begin(), cells.source().end());
    data.jacobian.assign(cells.jacobians().begin(), cells.jacobians().end());
    data.hexahedra.assign(cells.hexahedra().begin(), cells.hexahedra().end());
    for (std::size_t v = 0; v < data.source.size(); ++v)
        data.source[v] = data.deformed[v] + amount * (data.source[v] - data.deformed[v]);
    for (Mat3& jacobian : data.jacobian) jacobian = Mat3(1) + amount * (jacobian - Mat3(1));
    return data;
}

constexpr std::size_t kGrain = 1024;

}  // namespace

ScaledCells::ScaledCells(const SpatialTransferFunction& map, double amount)
    : cells_(scaledCells(*map.cells(), amount)), outside_(map.outside()) {}

void ScaledCells::map(std::span<const Vec3> p, std::span<Vec3> q) const {
    if (outside_ == Outside::Hide) return cells_.map(p, q);
    const std::vector<Vec3> before(p.begin(), p.end());  // q may alias p
    cells_.map(p, q);
    for (std::size_t i = 0; i < q.size(); ++i)
        if (!isDefined(q[i]) && isDefined(before[i])) q[i] = before[i];
}

void ScaledCells::jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const {
    assert(p.size() == jacobian.size());
    parallelFor(p.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        CellLocation at;
        for (std::size_t i = begin; i < end; ++i)
            jacobian[i] = isDefined(p[i]) && cells_.locate(p[i], at) ? cells_.jacobianAt(at) : Mat3(1);
    });
}

Box3 ScaledCells::imageOf(const Box3& rest) const {
    Box3 image = outside_ == Outside::Keep ? rest : Box3{};
    for (const auto& hexahedron : cells_.hexahedra()) {
        Box3 source, deformed;
        for (const auto vertex : hexahedron) {
            source = join(source, cells_.source()[vertex]);
            deformed = join(deformed, cells_.deformed()[vertex]);
        }
        if (!intersect(source, rest).empty()) image = join(image, deformed);
    }
    return image;
}

}  // namespace voledit
