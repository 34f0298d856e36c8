#include "render/march_resources.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/eval/baked_cells.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {

bool isWhole(VoxelType type) {
    return type != VoxelType::Float && type != VoxelType::Double;
}

std::span<const float> floatsOf(const std::vector<std::array<float, 4>>& values) {
    return {values.data()->data(), 4 * values.size()};
}

Texture makeTexture3D(GLenum format, Index3 size, GLint filter) {
    Texture texture = makeTexture(GL_TEXTURE_3D, GLenum(filter), GLenum(filter));
    glTextureStorage3D(texture.name(), 1, format, size.x, size.y, size.z);
    return texture;
}

BrickSet wholeSet(Index3 count) {
    return {count, std::vector<std::uint8_t>(std::size_t(count.x) * std::size_t(count.y) * std::size_t(count.z), 1)};
}

Texture makeDistances(const BrickSet& cells) {
    const Index3 count = cells.count();
    Texture texture = makeTexture3D(GL_R8UI, count, GL_NEAREST);
    const auto distances = cells.distances(MarchResources::kFarthest);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(texture.name(), 0, 0, 0, 0, count.x, count.y, count.z, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
                        distances.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    return texture;
}

Texture makeNodes(Index3 size, std::span<const Vec4f> nodes) {
    Texture texture = makeTexture3D(GL_RGBA32F, size, GL_LINEAR);
    glTextureSubImage3D(texture.name(), 0, 0, 0, 0, size.x, size.y, size.z, GL_RGBA, GL_FLOAT, nodes.data());
    return texture;
}

/// Jacobians at every second node: they change little from cell to cell.
std::array<Texture, 3> makeJacobians(const BakedMap& map) {
    const Index3 size = (map.grid.nodes + 1) / 2;
    const std::size_t layer = std::size_t(size.x) * std::size_t(size.y);
    std::array<std::vector<Vec4f>, 3> columns;
    for (auto& column : columns) column.resize(layer * std::size_t(size.z));
    parallelFor(std::size_t(size.z), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            for (int j = 0; j < size.y; ++j)
                for (int i = 0; i < size.x; ++i) {
                    const Mat3 jacobian = map.jacobianAt(2 * Index3(i, j, int(k)));
                    for (std::size_t c = 0; c < 3; ++c)
                        columns[c][k * layer + std::size_t(i + size.x * j)] = Vec4f(Vec3f(jacobian[int(c)]), 0);
                }
    });
    return {makeNodes(size, columns[0]), makeNodes(size, columns[1]), makeNodes(size, columns[2])};
}

std::vector<TransferPtr> mapsOf(const MarchPlan& plan) {
    return plan.forward ? std::vector<TransferPtr>{plan.forward->by} : plan.chain;
}

PlaceMap exactMap(const MarchPlan& plan) {
    return [&plan](std::span<const Vec3> p, std::span<Vec3> place) { mapChain(plan, p, place); };
}

/// A term's box may be far too large after some maps: what is seen of it is found by a coarse grid.
Box3 boundsOfChain(const MarchPlan& plan, const VisibleBricks& bricks) {
    const BakeGrid coarse = bakeGrid(plan.root->bounds, 40);
    const SeenCells seen = seenCells(bake(exactMap(plan), coarse), bricks, plan.clip);
    const BrickSet cells = mergedCells(coarse.nodes - 1, seen.seen, 0);
    if (cells.empty()) return plan.root->bounds;
    const Box3 box{coarse.origin + coarse.cell * (Vec3(cells.first()) - 1.0),
                   coarse.origin + coarse.cell * (Vec3(cells.end()) + 1.0)};
    return intersect(box, plan.root->bounds);
}

/// World box of what may be seen.
Box3 bakedBounds(const MarchPlan& plan, const VisibleBricks& bricks) {
    if (!plan.forward) return boundsOfChain(plan, bricks);
    Vec3 low(kInfinity), high(-kInfinity);
    for (const Vec3& deformed : plan.forward->by->cells()->deformed()) {
        const Vec3 p = transformPoint(plan.worldFromDeformed, deformed);
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {low, high};
}

/// Bakes what a plan's map is, cells or a chain of anything, for one grid.
class MapBaker {
public:
    MapBaker(const MarchPlan& plan, const BakeGrid& grid, std::function<bool(const Box3&)> wanted)
        : plan_(plan), grid_(grid) {
        if (plan.forward)
            cells_.emplace(
                BakedCells{plan.forward->by->cells(), plan.worldFromDeformed, plan.indexFromSource, std::move(wanted)},
                grid);
    }
    BakedMap bake() const { return cells_ ? cells_->bake() : voledit::bake(exactMap(plan_), grid_); }
    /// What the map is known to give at centres of cells that are seen.
    std::vector<BakedMap::Known> centres(const BakedMap& map, const std::vector<std::uint8_t>& seen) const {
        return cells_ ? cells_->centres(seen) : bakedCentres(map, exactMap(plan_), seen);
    }

private:
    const MarchPlan& plan_;
    BakeGrid grid_;
    std::optional<CellBaker> cells_;
};

}  // namespace

bool MarchResources::prepare(const MarchPlan& plan, const BakeRequest& request) {
    prepareLook(*plan.volume, request.cull);
    if (!plan.forward && plan.chain.empty()) {
        baked_.reset();
        return true;
    }
    // Centres of cells do not show every jump and border of a chain (an inner map's cells, what is kept outside): at
    // rest chains are drawn exactly.
    if (!plan.forward && !request.moving) return false;
    if (holds(plan, request)) return baked_->good;
    Baked made{{}, plan.worldFromDeformed, plan.indexFromSource, request};
    for (const TransferPtr& map : mapsOf(plan)) made.source.push_back(map);
    baked_ = std::move(made);
    // Finer ones are paid for only where they are needed.
    for (const int most : {64, 96, 128})
        if (!baked_->hopeless && bakeFinely(plan, request, most)) return true;
    return false;
}

void MarchResources::prepareLook(const VolumeTerm& term, bool cull) {
    if (look_ && look_->source.lock() == term.volume && look_->channel == term.channel && look_->cull == cull &&
        look_->appearance == term.appearance)
        return;
    baked_.reset();
    const ValueBricks& values = term.volume->bricks(term.channel);
    Look look{term.volume,
              term.channel,
              term.appearance,
              cull,
              makeMarchTable(term.appearance, finiteRangeOf(values), isWhole(term.volume->type())),
              {},
              {},
              {},
              {},
              {},
              {}};
    look.bricks = visibleBricks(values, look.table);
    if (!cull) look.all = wholeSet(look.bricks.set.count());
    look.distances = makeDistances(cull ? look.bricks.set : look.all);
    look.next = makeTable(GL_R32F, look.table.bins, look.table.next);
    look.depth = makeTable(GL_RGBA32F, look.table.bins, floatsOf(look.table.depth));
    look.color = makeTables(look.table.bins, 2, floatsOf(look.table.color));
    look_ = std::move(look);
}

bool MarchResources::holds(const MarchPlan& plan, const BakeRequest& request) const {
    const auto maps = mapsOf(plan);
    if (!baked_ || baked_->source.size() != maps.size() || baked_->worldFromDeformed != plan.worldFromDeformed ||
        baked_->indexFromSource != plan.indexFromSource)
        return false;
    for (std::size_t n = 0; n < maps.size(); ++n)
        if (baked_->source[n].lock() != maps[n]) return false;
    if (request.lit && !baked_->request.lit) return false;
    // One made for a picture at rest serves moving ones.
    if (request.moving && baked_->good) return request.step <= baked_->request.step;
    return baked_->request.moving == request.moving && baked_->request.step == request.step;
}

bool MarchResources::bakeFinely(const MarchPlan& plan, const BakeRequest& request, int most) {
    const VisibleBricks& bricks = look_->bricks;
    const auto wanted = [&](const Box3& box) { return !request.cull || bricks.any(box); };
    const Box3 bounds = bakedBounds(plan, bricks);
    const Vec3 size = bounds.size();
    // A step may pass two cells at most, as far as the map is continued beyond its faces.
    const double cells = std::min(2 * std::max({size.x, size.y, size.z}) / request.step, double(most));
    const BakeGrid grid = bakeGrid(bounds, std::clamp(int(cells) + 2 * kBakeBorder + 1, 2 * kBakeBorder + 2, most));
    const MapBaker baker(plan, grid, wanted);
    BakedMap map = baker.bake();
    SeenCells seen = seenCells(map, bricks, plan.clip);
    if (!seen.known && plan.forward) {
        map = MapBaker(plan, grid, [](const Box3&) { return true; }).bake();
        seen = seenCells(map, bricks, plan.clip);
    }
    // While something moves any error will do.
    std::vector<BakedMap::Known> centres;
    if (!request.moving) centres = baker.centres(map, seen.seen);
    const double error = seen.known || !plan.forward || request.moving ? map.error(centres) : kInfinity;
    baked_->hopeless = !std::isfinite(error);
    if (!(error <= kLargestError)) return false;
    // Blocks of rays are straight; the map is continued by two cells beyond its faces.
    baked_->steps = 1;
    for (const int steps : {5, 4, 2})
        if (baked_->steps == 1 && steps * request.step <= kBakeBorder * grid.cell &&
            map.error(centres, steps * request.step / grid.cell) <= kLargestError)
            baked_->steps = steps;
    const bool many = seen.seen.size() > kMostCells;
    baked_->cells = mergedCells(grid.nodes - 1, seen.seen, many);
    if (!request.cull) baked_->cells = wholeSet(baked_->cells.count());
    baked_->side = many ? 2 : 1;
    baked_->distances = makeDistances(baked_->cells);
    baked_->nodes = makeNodes(grid.nodes, map.node);
    if (request.lit) baked_->jacobian = makeJacobians(map);
    baked_->grid = grid;
    return baked_->good = true;
}

void MarchResources::bind() const {
    glBindTextureUnit(1, look_->next.name());
    glBindTextureUnit(2, look_->depth.name());
    glBindTextureUnit(3, look_->color.name());
    glBindTextureUnit(4, (baked_ ? baked_->distances : look_->distances).name());
    if (!baked_) return;
    glBindTextureUnit(5, baked_->nodes.name());
    for (GLuint c = 0; c < 3; ++c) glBindTextureUnit(6 + c, baked_->jacobian[c].name());
}

}  // namespace voledit
