#include "render/slice_resources.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "render/cell_buffers.h"

namespace voledit {

namespace {

/// 1 for cells that overlap no other, and whose source changes along a slab so little that it may be followed by the
/// Jacobian: a cell that is nearly flat would be taken far beyond itself.
std::vector<char> completeCells(const MappedCells& cells) {
    constexpr double kSteepest = 3;
    std::vector<char> steep(cells.deformed().size());
    for (std::size_t v = 0; v < steep.size(); ++v) {
        const Mat3& j = cells.jacobians()[v];
        steep[v] = std::max({glm::length(j[0]), glm::length(j[1]), glm::length(j[2])}) > kSteepest;
    }
    const auto overlapping = cells.overlapping();
    std::vector<char> complete(cells.cellCount());
    for (std::size_t c = 0; c < complete.size(); ++c) {
        const auto vertices = cells.cellVertices(c);
        complete[c] = !overlapping[c] &&
                      std::none_of(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return steep[v] != 0; });
    }
    return complete;
}

}  // namespace

void SliceResources::prepare(const SlicePlan& plan, const CullRequest& cull) {
    prepareTexture(*plan.volume);
    prepareBricks(*plan.volume);
    prepareTable(plan.volume->appearance);
    if (!visibility_) {
        visibility_.emplace(*volume_->bricks, table_->table);
        mesh_.reset();
    }
    prepareLocated(plan);
    prepareMesh(plan, cull);
}

void SliceResources::prepareTexture(const VolumeTerm& term) {
    if (volume_ && volume_->source.lock() == term.volume && volume_->channel == term.channel) return;
    // The old one goes first, so that two never need to fit.
    volume_.reset();
    visibility_.reset();
    volume_.emplace(Volumes{term.volume, term.channel, makeVolumeTexture(*term.volume, term.channel)});
}

void SliceResources::prepareBricks(const VolumeTerm& term) {
    if (volume_->bricks) return;
    volume_->bricks = makeValueBricks(*term.volume, term.channel, kVisibilityMargin);
    volume_->range = finiteRange(*volume_->bricks);
}

void SliceResources::prepareTable(const TransferFunction& function) {
    const auto [min, max] = volume_->range;
    if (table_ && table_->min == min && table_->max == max && table_->source == function) return;
    visibility_.reset();
    Tables made{function, min, max, makeTransferTable(function, min, max), {}, {}, {}};
    made.thickness = makeTable(GL_R32F, TransferTable::kSize, made.table.thickness);
    made.color = makeTable(GL_RGBA32F, TransferTable::kSize, made.table.color);
    if (!made.table.gradientFactor.empty())
        made.gradient = makeTable(GL_R32F, TransferTable::kSize, made.table.gradientFactor);
    table_ = std::move(made);
}

bool SliceResources::holdsLocated(const SlicePlan& plan) const {
    if (!located_) return plan.located.empty();
    if (located_->sources.size() != plan.located.size() || located_->affine.back() != plan.indexFromSource)
        return false;
    for (std::size_t m = 0; m < plan.located.size(); ++m)
        if (located_->sources[m].lock() != plan.located[m].transfer->by ||
            located_->affine[m] != plan.located[m].deformedFromSource)
            return false;
    return true;
}

void SliceResources::prepareLocated(const SlicePlan& plan) {
    if (holdsLocated(plan)) return;
    mesh_.reset();
    located_.reset();
    if (plan.located.empty()) return;
    const LocatedMaps maps = makeLocatedMaps(plan);
    Located made;
    for (const LocatedTransfer& located : plan.located) {
        made.sources.push_back(located.transfer->by);
        made.affine.push_back(located.deformedFromSource);
    }
    made.affine.push_back(plan.indexFromSource);
    made.entryFromSource = maps.entryFromSource;
    made.nextFromSource = maps.nextFromSource;
    made.buffers = cellBuffers(maps);
    located_ = std::move(made);
}

CellMesh SliceResources::cellsOf(const SlicePlan& plan, const CullRequest& cull,
                                 const std::vector<char>& wanted) const {
    const Visibility everything;
    const VolumeGrid& grid = plan.volume->volume->grid();
    if (!plan.forward)
        return brickMesh(grid, glm::inverse(plan.indexFromSource), cull.bricks ? *visibility_ : everything, cull.slab);
    const Visibility& visibility = cull.cells ? *visibility_ : everything;
    const MappedCells& cells = *plan.forward->by->cells();
    if (located_)
        return tetrahedronMesh(cells, plan.worldFromDeformed, located_->entryFromSource,
                               cellsSeen(plan, visibility, cull.slab));
    return tetrahedronMesh(cells, plan.worldFromDeformed, plan.indexFromSource, grid, visibility, cull.slab, wanted);
}

CellMesh SliceResources::uncoveredOf(const SlicePlan& plan, const CullRequest& cull) const {
    if (located_) return boxMesh(plan.forward->of->bounds, plan.worldFromDeformed);
    return brickMesh(plan.volume->volume->grid(), plan.worldFromDeformed * glm::inverse(plan.indexFromSource),
                     cull.bricks ? *visibility_ : Visibility(), cull.slab);
}

void SliceResources::prepareMesh(const SlicePlan& plan, const CullRequest& cull) {
    const TransferPtr source = plan.forward ? plan.forward->by : nullptr;
    if (mesh_ && mesh_->mapped == (source != nullptr) && mesh_->source.lock() == source &&
        mesh_->worldFromDeformed == plan.worldFromDeformed && mesh_->indexFromSource == plan.indexFromSource &&
        mesh_->cull == cull)
        return;
    Meshes made{source, source != nullptr, plan.worldFromDeformed, plan.indexFromSource, cull, {}, {}, {}};
    std::vector<char> wanted;
    if (cull.separate) {
        wanted = completeCells(*source->cells());
        made.alone = cellsOf(plan, cull, wanted);
        for (char& cell : wanted) cell = !cell;
    }
    made.mesh = cellsOf(plan, cull, wanted);
    if (source && source->outside() == Outside::Keep) made.uncovered = uncoveredOf(plan, cull);
    mesh_ = std::move(made);
}

void SliceResources::bindVolume() const {
    glBindTextureUnit(0, volume_->texture.texture.name());
}

void SliceResources::bind() const {
    bindVolume();
    glBindTextureUnit(1, table_->thickness.name());
    glBindTextureUnit(2, table_->color.name());
    glBindTextureUnit(3, table_->gradient.name());
    if (located_) bindCells(located_->buffers);
}

}  // namespace voledit
