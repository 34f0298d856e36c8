#include "render/cell_slicer.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "render/cell_cut.h"

namespace voledit {

CellSlicer::CellSlicer(const CellMesh& mesh, const View& view, const Box3& domain, const Visibility& visibility)
    : mesh_(mesh), domain_(domain), visibility_(visibility) {
    place(view);
    cover(view);
}

void CellSlicer::place(const View& view) {
    position_.resize(mesh_.position.size());
    parallelFor(position_.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) position_[v] = view.viewFromWorld(mesh_.position[v]);
    });
    const std::size_t cells = mesh_.cellCount(), stride = std::size_t(mesh_.verticesPerCell());
    cellNear_.resize(cells);
    cellFar_.resize(cells);
    parallelFor(cells, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            double near = kInfinity, far = -kInfinity;
            unsigned outside = 15;  // of the view's four sides, those that all vertices are beyond
            for (std::size_t n = 0; n < stride; ++n) {
                const Vec3& p = position_[mesh_.cellVertices[c * stride + n]];
                near = std::min(near, p.z);
                far = std::max(far, p.z);
                outside &= unsigned(p.x > p.z) | unsigned(p.x < -p.z) << 1 | unsigned(p.y > p.z) << 2 |
                           unsigned(p.y < -p.z) << 3;
            }
            const bool seen = outside == 0 && far > 0;
            cellNear_[c] = seen ? std::nextafter(float(near), -HUGE_VALF) : HUGE_VALF;
            cellFar_[c] = seen ? std::nextafter(float(far), HUGE_VALF) : -HUGE_VALF;
        }
    });
}

void CellSlicer::cover(const View& view) {
    start_ = nearest_ = kInfinity;
    double end = -kInfinity;
    for (const Vec3& p : position_) {
        start_ = std::min(start_, p.z);
        end = std::max(end, p.z);
    }
    middle_ = (start_ + end) / 2;
    farthest_ = -kInfinity;
    Vec2 low(1), high(-1);
    const std::size_t stride = std::size_t(mesh_.verticesPerCell());
    for (std::size_t c = 0; c < cellNear_.size(); ++c) {
        if (!(cellNear_[c] < cellFar_[c])) continue;
        ++cellsInView_;
        for (std::size_t n = 0; n < stride; ++n) {
            const Vec3& p = position_[mesh_.cellVertices[c * stride + n]];
            nearest_ = std::min(nearest_, p.z);
            farthest_ = std::max(farthest_, p.z);
            // Beside or behind the eye a point has no place in the picture: the cell may cover any of it.
            const bool ahead = p.z > 1e-9;
            low = glm::min(low, ahead ? Vec2(p) / p.z : Vec2(-1));
            high = glm::max(high, ahead ? Vec2(p) / p.z : Vec2(1));
        }
    }
    nearest_ = std::max(nearest_, 0.0);
    for (int a = 0; a < 2; ++a) {
        const double from = (std::max(low[a], -1.0) + 1) / 2 * view.size[a];
        const double to = (std::min(high[a], 1.0) + 1) / 2 * view.size[a];
        window_[std::size_t(a)] = std::clamp(int(std::floor(from)) - 1, 0, view.size[a]);
        window_[std::size_t(a) + 2] = std::clamp(int(std::ceil(to)) + 1, 0, view.size[a]) - window_[std::size_t(a)];
    }
}

void CellSlicer::gather(double from, double to, SliceBatch& batch) const {
    batch.cells_.clear();
    const auto first = float(from), last = float(to);
    for (std::size_t c = 0; c < cellNear_.size(); ++c)
        if (cellNear_[c] <= last && cellFar_[c] >= first) batch.cells_.push_back(std::uint32_t(c));
}

void CellSlicer::cut(double depth, double distance, int count, double referenceDepth, SliceBatch& batch) const {
    batch.vertices.clear();
    batch.indices.clear();
    batch.firstIndex.assign(1, 0);
    batch.polygons = 0;
    if (batch.madeFor_.size() != mesh_.edges.size()) {
        batch.madeFor_.assign(mesh_.edges.size(), 0);
        batch.vertexOfEdge_.resize(mesh_.edges.size());
        batch.generation_ = 0;
    }
    gather(depth, depth + distance * (count - 1), batch);
    for (int n = 0; n < count; ++n) {
        const double z = depth + distance * n;
        ++batch.generation_;
        if (z > 0) cutSlice(z, float(z - referenceDepth), batch);
        batch.firstIndex.push_back(batch.indices.size());
    }
}

void CellSlicer::cutSlice(double depth, float relativeDepth, SliceBatch& batch) const {
    const bool bricks = mesh_.kind == CellMesh::Kind::Brick;
    const auto cuts = bricks ? brickCuts() : tetrahedronCuts();
    const std::size_t vertices = std::size_t(mesh_.verticesPerCell()), edges = std::size_t(mesh_.edgesPerCell());
    const auto z = float(depth);
    for (const std::uint32_t c : batch.cells_) {
        if (!(cellNear_[c] <= z && cellFar_[c] >= z)) continue;
        const std::uint32_t* corner = mesh_.cellVertices.data() + c * vertices;
        unsigned inFront = 0;
        for (std::size_t v = 0; v < vertices; ++v) inFront |= unsigned(position_[corner[v]].z < depth) << v;
        const CutPolygon& polygon = cuts[inFront];
        if (polygon.count == 0) continue;
        const std::uint32_t* cellEdge = mesh_.cellEdges.data() + c * edges;
        std::array<std::uint32_t, 6> at{};
        for (std::size_t n = 0; n < polygon.count; ++n)
            at[n] = vertexOn(cellEdge[polygon.edge[n]], depth, relativeDepth, batch);
        if (!mesh_.margin.empty() && !polygonSeen(c, std::span(at).first(polygon.count), batch)) continue;
        for (std::size_t n = 2; n < polygon.count; ++n)
            batch.indices.insert(batch.indices.end(), {at[0], at[n - 1], at[n]});
        ++batch.polygons;
    }
}

bool CellSlicer::polygonSeen(std::uint32_t cell, std::span<const std::uint32_t> corners,
                             const SliceBatch& batch) const {
    Vec3f low(HUGE_VALF), high(-HUGE_VALF);
    for (const std::uint32_t corner : corners) {
        const float* index = batch.vertices.data() + std::size_t(corner) * std::size_t(floatsPerVertex()) + 3;
        const Vec3f at(index[0], index[1], index[2]);
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    return canBeSeen({Vec3(low), Vec3(high)}, Vec3(mesh_.margin[cell]), domain_, visibility_);
}

std::uint32_t CellSlicer::vertexOn(std::uint32_t edge, double depth, float relativeDepth, SliceBatch& batch) const {
    if (batch.madeFor_[edge] == batch.generation_) return batch.vertexOfEdge_[edge];
    const auto [a, b] = mesh_.edges[edge];
    const Vec3 &from = position_[a], &to = position_[b];
    const double t = (depth - from.z) / (to.z - from.z), s = 1 - t;
    const std::size_t floats = std::size_t(floatsPerVertex());
    const auto number = std::uint32_t(batch.vertices.size() / floats);
    batch.vertices.resize(batch.vertices.size() + floats);
    float* out = batch.vertices.data() + number * floats;
    out[0] = float((s * from.x + t * to.x) / depth);
    out[1] = float((s * from.y + t * to.y) / depth);
    out[2] = relativeDepth;
    if (floats > 3) {
        static_assert(sizeof(CellMesh::Source) == 12 * sizeof(float));
        const float *p = &mesh_.source[a].index.x, *q = &mesh_.source[b].index.x;
        const auto u = float(t), w = float(s);
        for (int n = 0; n < 12; ++n) out[3 + n] = w * p[n] + u * q[n];
    }
    batch.madeFor_[edge] = batch.generation_;
    batch.vertexOfEdge_[edge] = number;
    return number;
}

}  // namespace voledit
