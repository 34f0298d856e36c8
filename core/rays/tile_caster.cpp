#include "core/rays/tile_caster.h"

#include "core/eval/ray_caster.h"

namespace voledit {

namespace {

class GeneralTiles final : public TileCaster {
public:
    explicit GeneralTiles(const CompiledScene& scene) : scene_(scene) {}
    std::uint64_t cast(Picture& picture, Index2 first, Index2 end) const override {
        RayStatistics statistics;
        castPixels(scene_, picture, first, end, &statistics);
        return statistics.samples;
    }

private:
    CompiledScene scene_;
};

/// The way down to a volume through affine maps; null at `volume` where there is something else.
struct StraightWay {
    TermPtr volume;
    Mat4 restFromWorld{1.0};
};
StraightWay straightWay(const TermPtr& root) {
    StraightWay way;
    TermPtr at = root;
    while (const auto* transfer = std::get_if<TransferTerm>(&at->node)) {
        const auto matrix = transfer->by->affine();
        if (!matrix || transfer->by->cells()) return {};
        way.restFromWorld = *matrix * way.restFromWorld;
        at = transfer->of;
    }
    if (std::holds_alternative<VolumeTerm>(at->node)) way.volume = at;
    return way;
}

}  // namespace

std::unique_ptr<const TileCaster> makeGeneralTiles(const CompiledScene& scene) {
    return std::make_unique<GeneralTiles>(scene);
}

std::unique_ptr<const TileCaster> makeTileCaster(const CompiledScene& scene, Index2 size, RayCache& cache) {
    const StraightWay way = straightWay(scene.root);
    if (!way.volume || !packable(std::get<VolumeTerm>(way.volume->node))) return makeGeneralTiles(scene);
    cache.look = volumeLook(way.volume, scene.stepLength() / scene.opacityDistance, cache.look);
    const Mat4 indexFromWorld = cache.look->volumeTerm().volume->indexFromWorld() * way.restFromWorld;
    return makeStraightTiles(scene, size, cache.look, indexFromWorld);
}

}  // namespace voledit
