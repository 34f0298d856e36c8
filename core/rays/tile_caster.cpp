#include "core/rays/tile_caster.h"

#include "core/eval/ray_caster.h"
#include "core/eval/surroundings.h"
#include "core/rays/cell_tiles.h"
#include "core/stf/mapped_cells.h"

namespace voledit {

namespace {

class GeneralTiles final : public TileCaster {
public:
    explicit GeneralTiles(const CompiledScene& scene) : scene_(scene), prepared_(scene) {}
    std::uint64_t cast(Picture& picture, Index2 first, Index2 end) const override {
        RayStatistics statistics;
        castPixels(scene_, picture, first, end, &statistics);
        return statistics.samples;
    }

private:
    CompiledScene scene_;
    Surroundings prepared_;  // known to all tiles before the first
};

/// The way down to a volume through maps that show each of its points at most once a place; nullptr at `volume` where
/// there is something else.
struct PacketWay {
    TermPtr volume;
    CellWay cells;  // without maps: affine ones alone lead there, by indexFromRest
};
PacketWay packetWay(const TermPtr& root) {
    PacketWay way;
    Mat4 matrix(1.0);                  // of the affine maps since the last one that is not …
    std::vector<TransferPtr> affines;  // … which are these
    TermPtr at = root;
    for (; const auto* transfer = std::get_if<TransferTerm>(&at->node); at = transfer->of) {
        const MappedCells* cells = transfer->by->cells();
        if (cells && cells->mayOverlap()) return {};
        if (const auto affine = cells ? std::nullopt : transfer->by->affine()) {
            matrix = *affine * matrix;
            affines.push_back(transfer->by);
            continue;
        }
        if (way.cells.by.empty()) {
            way.cells.term = at;
            way.cells.cellsFromWorld = matrix;
        } else {
            way.cells.by.insert(way.cells.by.end(), affines.begin(), affines.end());
        }
        way.cells.by.push_back(transfer->by);
        matrix = Mat4(1.0);
        affines.clear();
    }
    if (!std::holds_alternative<VolumeTerm>(at->node)) return {};
    way.volume = at;
    way.cells.indexFromRest = std::get<VolumeTerm>(at->node).volume->indexFromWorld() * matrix;
    return way;
}

}  // namespace

std::unique_ptr<const TileCaster> makeGeneralTiles(const CompiledScene& scene) {
    return std::make_unique<GeneralTiles>(scene);
}

std::unique_ptr<const TileCaster> makeTileCaster(const CompiledScene& scene, Index2 size, RayCache& cache, bool rough) {
    const PacketWay way = packetWay(scene.root);
    if (!way.volume || !packable(std::get<VolumeTerm>(way.volume->node))) return makeGeneralTiles(scene);
    cache.look = volumeLook(way.volume, scene.stepLength() / scene.opacityDistance, cache.look);
    if (way.cells.by.empty()) return makeStraightTiles(scene, size, cache.look, way.cells.indexFromRest);
    cache.cells = cellLook(way.cells, cache.look, {scene.render.shading, rough}, cache.cells);
    return makeCellTiles(scene, size, cache.cells);
}

}  // namespace voledit
