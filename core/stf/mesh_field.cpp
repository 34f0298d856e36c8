#include "core/stf/mesh_field.h"

#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "core/base/error.h"

namespace voledit {

namespace {

MappedCells::Data cellsOf(MeshData& mesh) {
    MappedCells::Data data;
    data.source = mesh.points;
    data.deformed = std::move(mesh.points);
    data.jacobian.assign(data.source.size(), Mat3(1));
    data.hexahedra = std::move(mesh.hexahedra);
    data.tetrahedra = std::move(mesh.tetrahedra);
    return data;
}

/// Of the finite values; from infinity to −infinity where there are none.
Interval finiteRange(std::span<const float> values, int channels, int channel) {
    Interval range{kInfinity, -kInfinity};
    for (std::size_t i = std::size_t(channel); i < values.size(); i += std::size_t(channels))
        if (values[i] == values[i]) range = join(range, {values[i], values[i]});
    return range;
}

}  // namespace

Mesh::Mesh(MeshData data) : cells_(cellsOf(data)), values_(std::move(data.values)), channels_(data.channels) {
    const std::size_t points = cells_.deformed().size();
    if (channels_ < 1 || values_.size() != points * std::size_t(channels_))
        throw Error("mesh", std::to_string(values_.size()) + " values for " + std::to_string(points) + " points",
                    "give each point the same number of values, at least one");
    for (float& value : values_)
        if (!std::isfinite(value)) value = std::numeric_limits<float>::quiet_NaN();
    for (int c = 0; c < channels_; ++c) ranges_.push_back(finiteRange(values_, channels_, c));
}

Interval Mesh::range(int channel) const {
    assert(channel >= 0 && channel < channels_);
    return ranges_[std::size_t(channel)];
}

MeshField::MeshField(std::shared_ptr<const Mesh> mesh, int channel) : mesh_(std::move(mesh)), channel_(channel) {
    if (channel_ < 0 || channel_ >= mesh_->channels())
        throw Error("mesh field",
                    "channel " + std::to_string(channel_) + " of a mesh of " + std::to_string(mesh_->channels()),
                    "count channels from 0");
    const MappedCells& cells = mesh_->cells();
    const auto points = cells.deformed();
    gradients_.assign(points.size(), Vec3(0));
    std::vector<double> weight(points.size(), 0);
    for (std::size_t n = 0; n < cells.tetrahedra().size(); ++n) {
        if (cells.determinants()[n] == 0) continue;
        const auto& t = cells.tetrahedra()[n];
        const Vec3 e1 = points[t[1]] - points[t[0]], e2 = points[t[2]] - points[t[0]], e3 = points[t[3]] - points[t[0]];
        const double volume = glm::dot(e1, glm::cross(e2, e3)), first = valueOf(t[0]);
        const Vec3 gradientTimesVolume = (valueOf(t[1]) - first) * glm::cross(e2, e3) +
                                         (valueOf(t[2]) - first) * glm::cross(e3, e1) +
                                         (valueOf(t[3]) - first) * glm::cross(e1, e2);
        // Next to a value that is none the gradient is that of the tetrahedra that have one.
        if (!std::isfinite(glm::dot(gradientTimesVolume, gradientTimesVolume))) continue;
        for (const std::uint32_t v : t) {
            gradients_[v] += std::copysign(1.0, volume) * gradientTimesVolume;
            weight[v] += std::abs(volume);
        }
    }
    for (std::size_t v = 0; v < gradients_.size(); ++v)
        if (weight[v] > 0) gradients_[v] /= weight[v];
}

double MeshField::valueOf(std::uint32_t vertex) const {
    return mesh_->values()[std::size_t(vertex) * std::size_t(mesh_->channels()) + std::size_t(channel_)];
}

template <class Visit>
void MeshField::forLocated(std::span<const Vec3> p, const Visit& visit) const {
    const MappedCells& cells = mesh_->cells();
    CellLocation at{};
    std::uint32_t hint = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const bool found = cells.cellCount() > 0 && cells.locateNear(p[i], hint, at);
        visit(i, found ? &cells.tetrahedra()[at.tetrahedron] : nullptr, at.barycentric);
    }
}

void MeshField::sample(std::span<const Vec3> p, std::span<double> value) const {
    assert(p.size() == value.size());
    forLocated(p, [&](std::size_t i, const std::array<std::uint32_t, 4>* t, const std::array<double, 4>& w) {
        value[i] = kNaN;
        if (!t) return;
        // From the first vertex on, so that equal values give themselves to the bit.
        const double first = valueOf((*t)[0]);
        value[i] = first + w[1] * (valueOf((*t)[1]) - first) + w[2] * (valueOf((*t)[2]) - first) +
                   w[3] * (valueOf((*t)[3]) - first);
    });
}

void MeshField::gradient(std::span<const Vec3> p, std::span<Vec3> gradient) const {
    assert(p.size() == gradient.size());
    forLocated(p, [&](std::size_t i, const std::array<std::uint32_t, 4>* t, const std::array<double, 4>& w) {
        gradient[i] = Vec3(0);
        for (std::size_t v = 0; t && v < 4; ++v) gradient[i] += w[v] * gradients_[(*t)[v]];
    });
}

Interval MeshField::range(const Box3& box) const {
    const MappedCells& cells = mesh_->cells();
    const Interval whole = mesh_->range(channel_);
    Interval found{kInfinity, -kInfinity};
    const Box3& bounds = cells.bounds();
    if (box.contains(bounds.min) && box.contains(bounds.max)) {
        found = whole;
    } else if (cells.cellCount() > 0) {
        cells.anyTetrahedron(box, [&](std::uint32_t n) {
            for (const std::uint32_t v : cells.tetrahedra()[n])
                if (const double value = valueOf(v); value == value) found = join(found, {value, value});
            return found.low <= whole.low && found.high >= whole.high;
        });
    }
    if (found.low > found.high) return found;
    // Interpolation rounds.
    const double slack = 1e-14 * std::max(std::abs(found.low), std::abs(found.high));
    return {found.low - slack, found.high + slack};
}

}  // namespace voledit
