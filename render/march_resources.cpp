#include "render/march_resources.h"

#include <algorithm>

#include "core/base/parallel.h"
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
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &name);
    Texture texture(name);
    for (const GLenum which : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTextureParameteri(name, which, filter);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name, wrap, GL_CLAMP_TO_EDGE);
    glTextureStorage3D(name, 1, format, size.x, size.y, size.z);
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

Box3 worldBounds(const MarchPlan& plan) {
    Box3 box;
    for (const Vec3& p : plan.forward->by->cells()->deformed())
        box = join(box, transformPoint(plan.worldFromDeformed, p));
    return box;
}

}  // namespace

bool MarchResources::prepare(const MarchPlan& plan, const BakeRequest& request) {
    prepareLook(*plan.volume, request.cull);
    if (!plan.forward) {
        baked_.reset();
        return true;
    }
    if (holds(plan, request)) return baked_->good;
    baked_.emplace(Baked{plan.forward->by, plan.worldFromDeformed, plan.indexFromSource, request});
    // Finer ones are paid for only where they are needed.
    for (const int most : {64, 96, 128})
        if (bakeFinely(plan, request, most)) return true;
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
    if (!baked_ || baked_->source.lock() != plan.forward->by || baked_->worldFromDeformed != plan.worldFromDeformed ||
        baked_->indexFromSource != plan.indexFromSource)
        return false;
    if (baked_->good && request.step > 2 * baked_->grid.cell) return false;
    // One made for a picture at rest serves moving ones.
    return baked_->request.moving == request.moving || (baked_->good && request.moving);
}

bool MarchResources::bakeFinely(const MarchPlan& plan, const BakeRequest& request, int most) {
    const Box3 bounds = worldBounds(plan);
    const Vec3 size = bounds.size();
    // A step may pass two cells at most, as far as the map is continued beyond its faces.
    const double longest = std::max({size.x, size.y, size.z});
    most = std::min(most, int(std::min(2 * longest / request.step, 1e6)) + 2 * kBakeBorder + 1);
    const BakeGrid grid = bakeGrid(bounds, std::max(most, 2 * kBakeBorder + 2));
    const VisibleBricks& bricks = look_->bricks;
    BakedCells cells{plan.forward->by->cells(), plan.worldFromDeformed, plan.indexFromSource,
                     [&](const Box3& box) { return !request.cull || bricks.any(box); }};
    BakedMap map = bake(cells, grid);
    SeenCells seen = seenCells(map, bricks, plan.clip);
    if (!seen.known) {
        cells.wanted = [](const Box3&) { return true; };
        map = bake(cells, grid);
        seen = seenCells(map, bricks, plan.clip);
    }
    if (!request.moving && !(bakeError(map, cells, seen.seen) <= kLargestError)) return false;
    const bool many = seen.seen.size() > kMostCells;
    baked_->cells = mergedCells(grid.nodes - 1, seen.seen, many);
    if (!request.cull) baked_->cells = wholeSet(baked_->cells.count());
    baked_->side = many ? 2 : 1;
    baked_->distances = makeDistances(baked_->cells);
    baked_->nodes = makeNodes(grid.nodes, map.node);
    baked_->jacobian = makeJacobians(map);
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
