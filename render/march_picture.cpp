#include "render/march_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "core/eval/cut_faces.h"
#include "render/cut_uniforms.h"
#include "render/light_uniforms.h"
#include "render/slice_variants.h"

namespace voledit {

namespace {

/// Pixels; software renderers work in tiles of 64 × 64.
constexpr Index2 kTile{64, 32};

bool isReal(VoxelType type) {
    return type == VoxelType::Float || type == VoxelType::Double;
}

}  // namespace

MarchPicture::MarchPicture(SliceWorkshop& workshop, const CompiledScene& scene, MarchPlan plan, Index2 size,
                           double step)
    : workshop_(workshop), plan_(std::move(plan)), view_(makeView(scene.camera, size)), step_(step) {
    workshop.resources.prepareTexture(*plan_.volume);
    workshop.target.start(size, false);
    const BrickSet& cells = workshop.march.cells();
    statistics_.cells = cells.size();
    statistics_.culledCells =
        std::size_t(cells.count().x) * std::size_t(cells.count().y) * std::size_t(cells.count().z) - cells.size();
    findPlaces();
    layOut();
    const Surroundings surroundings(scene);
    surrounded_ = !surroundings.none();
    if (surrounded_) workshop.surroundings.prepare(surroundings);
    const ProgramVariant variant = marchVariant({.baked = workshop.march.grid() != nullptr,
                                                 .shaded = scene.render.shading,
                                                 .realVoxels = isReal(plan_.volume->volume->type()),
                                                 .steps = workshop.march.stepsOfBlock()});
    program_ = &workshop.shaders.get(surrounded_ ? withSurroundings(variant) : variant);
    setVolumeUniforms();
    setUniforms(scene);
    statistics_.programsCompiled = workshop.shaders.compiled();
}

void MarchPicture::findPlaces() {
    const MarchResources& march = workshop_.march;
    Box3 places = plan_.clip;
    box_ = plan_.clip;
    placeFromWorld_ = plan_.indexFromSource;
    if (const BakeGrid* grid = march.grid()) {
        placeFromWorld_ = grid->gridFromWorld();
        places = {Vec3(kBakeBorder), Vec3(grid->nodes - 1 - kBakeBorder)};
        // Steps begin at the term's own box, wherever nodes lie: an unmoved lattice changes no step.
        box_ = transformed(plan_.root->bounds, placeFromWorld_);
    }
    visible_ = intersect(
        places, {march.cellSide() * Vec3(march.cells().first()) - 0.5, march.cellSide() * Vec3(march.cells().end())});
}

void MarchPicture::layOut() {
    if (workshop_.march.cells().empty() || visible_.empty()) return;
    const Mat4 worldFromPlace = glm::inverse(placeFromWorld_);
    Vec2 low(1), high(-1);
    double near = kInfinity, far = -kInfinity, boxNear = kInfinity, boxFar = -kInfinity;
    for (int c = 0; c < 8; ++c) {
        const Vec3 p = view_.viewFromWorld(transformPoint(worldFromPlace, visible_.corner(c)));
        near = std::min(near, p.z);
        far = std::max(far, p.z);
        // Beside or behind the eye a point has no place in the picture: anything may be covered.
        const bool ahead = p.z > 1e-9;
        low = glm::min(low, ahead ? Vec2(p) / p.z : Vec2(-1));
        high = glm::max(high, ahead ? Vec2(p) / p.z : Vec2(1));
        const double boxDepth = view_.viewFromWorld(transformPoint(worldFromPlace, box_.corner(c))).z;
        boxNear = std::min(boxNear, boxDepth);
        boxFar = std::max(boxFar, boxDepth);
    }
    // Not by what is visible: rounding would change with it.
    referenceDepth_ = (boxNear + boxFar) / 2;
    if (!(far > 0)) return;
    for (int a = 0; a < 2; ++a) {
        const auto pixel = [&](double ndc) { return (std::clamp(ndc, -1.0, 1.0) + 1) / 2 * view_.size[a]; };
        const int from = std::clamp(int(std::floor(pixel(low[a]))) - 1, 0, view_.size[a]);
        const int to = std::clamp(int(std::ceil(pixel(high[a]))) + 1, from, view_.size[a]);
        window_[std::size_t(a)] = from;
        window_[std::size_t(a) + 2] = to - from;
    }
    if (window_[2] == 0 || window_[3] == 0) return;
    columns_ = (window_[0] + window_[2] - 1) / kTile.x - window_[0] / kTile.x + 1;
    rows_ = (window_[1] + window_[3] - 1) / kTile.y - window_[1] / kTile.y + 1;
    statistics_.slices = int(std::ceil((far - std::max(near, 0.0)) / step_));
}

void MarchPicture::setVolumeUniforms() {
    Program& p = *program_;
    const VolumeGrid& grid = plan_.volume->volume->grid();
    const VolumeTexture& texture = workshop_.resources.volume();
    const MarchTable& table = workshop_.march.table();
    p.set("volume", 0);
    p.set("nextTable", 1);
    p.set("depthTable", 2);
    p.set("colorTable", 3);
    p.set("distances", 4);
    p.set("volumeLast", Vec3f(grid.size - 1));
    p.set("texelPerIndex", Vec3f(1.0 / Vec3(grid.size)));
    p.set("domainMin", Vec3f(plan_.clip.min));
    p.set("domainMax", Vec3f(plan_.clip.max));
    p.set("tableScale", float(texture.valueScale * double(table.scale)));
    p.set("tableOffset", float((texture.valueOffset - double(table.low)) * double(table.scale)));
    p.set("tableLast", float(table.bins - 1));
    p.set("cellsPerPlace", Vec3f(float(1.0 / workshop_.march.cellSide())));
    const BakeGrid* baked = workshop_.march.grid();
    if (!baked) return;
    p.set("map", 5);
    // Cells are cut off by their source alone, other maps half-way to nodes where they are undefined.
    p.set("known", plan_.forward ? 0.999F : (1 + BakedMap::kContinued) / 2);
    p.set("jacobianX", 6);
    p.set("jacobianY", 7);
    p.set("jacobianZ", 8);
    p.set("mapTexel", Vec3f(1.0 / Vec3(baked->nodes)));
    p.set("jacobianTexel", Vec3f(1.0 / Vec3((baked->nodes + 1) / 2)));
}

void MarchPicture::setUniforms(const CompiledScene& scene) {
    Program& p = *program_;
    const Mat3 rays(view_.rayAtOrigin(), view_.rayPerPixelX(), view_.rayPerPixelY());
    const Mat3 perDepth = Mat3(placeFromWorld_) * rays;
    Mat3 atReference = referenceDepth_ * perDepth;
    atReference[0] += transformPoint(placeFromWorld_, view_.eye);
    p.set("rayPerDepth", Mat3f(rays));
    p.set("placeAtReference", Mat3f(atReference));
    p.set("placePerDepth", Mat3f(perDepth));
    p.set("indexFromWorld", Mat3f(Mat3(placeFromWorld_)));
    p.set("eyeDepth", float(-referenceDepth_));
    p.set("boxMin", Vec3f(box_.min));
    p.set("boxMax", Vec3f(box_.max));
    p.set("visibleMin", Vec3f(visible_.min));
    p.set("visibleMax", Vec3f(visible_.max));
    p.set("stepLength", float(step_));
    p.set("opacityDistance", float(scene.opacityDistance));
    p.set("least", workshop_.options.mask ? 1 - SliceTarget::kOpaque : 0.0F);
    p.set("cutThickness", float(cutThickness(scene)));
    setCutFaces(p, {plan_.clip});
    setLights(p, scene.render, lightsOf(scene.render, scene.camera));
    if (surrounded_) workshop_.surroundings.setUniforms(p, scene.render, view_, referenceDepth_);
}

void MarchPicture::draw(int count) {
    const int end = next_ + std::min(count, pieceCount() - next_);
    workshop_.target.bind();
    glDisable(GL_BLEND);
    workshop_.resources.bindVolume();
    workshop_.march.bind();
    if (surrounded_) workshop_.surroundings.bind();
    while (next_ < end) {
        const Index2 first(next_ % columns_, next_ / columns_);
        const int left = end - next_;
        // Whole rows at once where there are some.
        const Index2 tiles = first.x == 0 && left >= columns_ ? Index2(columns_, left / columns_)
                                                              : Index2(std::min(columns_ - first.x, left), 1);
        drawTiles(first, first + tiles);
        next_ += tiles.x * tiles.y;
    }
}

void MarchPicture::drawTiles(Index2 first, Index2 end) {
    std::array<int, 4> part{};
    for (int a = 0; a < 2; ++a) {
        const int origin = window_[std::size_t(a)] / kTile[a];
        const int windowEnd = window_[std::size_t(a)] + window_[std::size_t(a) + 2];
        const int from = std::max((origin + first[a]) * kTile[a], window_[std::size_t(a)]);
        const int to = std::min((origin + end[a]) * kTile[a], windowEnd);
        part[std::size_t(a)] = from;
        part[std::size_t(a) + 2] = to - from;
    }
    workshop_.target.drawWindow(*program_, part);
}

}  // namespace voledit
