#include "render/slice_resources.h"

#include <glm/matrix.hpp>

namespace voledit {

void SliceResources::prepare(const SlicePlan& plan, const CullRequest& cull) {
    prepareVolume(*plan.volume);
    prepareTable(plan.volume->appearance);
    if (!visibility_) {
        visibility_.emplace(volume_->bricks, table_->table);
        mesh_.reset();
    }
    prepareMesh(plan, cull);
}

void SliceResources::prepareVolume(const VolumeTerm& term) {
    if (volume_ && volume_->source.lock() == term.volume && volume_->channel == term.channel) return;
    // The old one goes first, so that two never need to fit.
    volume_.reset();
    visibility_.reset();
    volume_.emplace(Volumes{term.volume,
                            term.channel,
                            makeVolumeTexture(*term.volume, term.channel),
                            makeValueBricks(*term.volume, term.channel, kVisibilityMargin),
                            {}});
    volume_->range = finiteRange(volume_->bricks);
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

void SliceResources::prepareMesh(const SlicePlan& plan, const CullRequest& cull) {
    const TransferPtr source = plan.forward ? plan.forward->by : nullptr;
    if (mesh_ && mesh_->mapped == (source != nullptr) && mesh_->source.lock() == source &&
        mesh_->worldFromDeformed == plan.worldFromDeformed && mesh_->indexFromSource == plan.indexFromSource &&
        mesh_->cull == cull)
        return;
    const Visibility everything;
    const VolumeGrid& grid = plan.volume->volume->grid();
    const auto bricks = [&](const Mat4& worldFromSource) {
        return brickMesh(grid, worldFromSource * glm::inverse(plan.indexFromSource),
                         cull.bricks ? *visibility_ : everything, cull.slab);
    };
    Meshes made{source, source != nullptr, plan.worldFromDeformed, plan.indexFromSource, cull, {}, {}};
    made.mesh = source ? tetrahedronMesh(*source->cells(), plan.worldFromDeformed, plan.indexFromSource, grid,
                                         cull.cells ? *visibility_ : everything, cull.slab)
                       : bricks(Mat4(1));
    if (source && source->outside() == Outside::Keep) made.uncovered = bricks(plan.worldFromDeformed);
    mesh_ = std::move(made);
}

void SliceResources::bind() const {
    glBindTextureUnit(0, volume_->texture.texture.name());
    glBindTextureUnit(1, table_->thickness.name());
    glBindTextureUnit(2, table_->color.name());
    glBindTextureUnit(3, table_->gradient.name());
}

}  // namespace voledit
