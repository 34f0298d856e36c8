#include "core/rays/cell_tiles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "core/eval/surroundings.h"
#include "core/rays/cell_bins.h"
#include "core/rays/cell_raster.h"
#include "core/rays/packet_light.h"
#include "core/rays/packet_picture.h"
#include "core/rays/picture_rays.h"
#include "core/rays/ragged_pieces.h"
#include "core/rays/ray_pieces.h"

namespace voledit {

namespace {

constexpr int kTile = CellBins::kTile;

std::array<float, 3> single(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// False where only mapped cells and affine maps stand above a volume: defined wherever its cells are.
bool mayHaveGaps(const Term& root) {
    const auto* transfer = std::get_if<TransferTerm>(&root.node);
    return transfer && (!(transfer->by->cells() || transfer->by->affine()) || mayHaveGaps(*transfer->of));
}

/// How far off their place, in voxels, what cells show may be: those of chains follow these to a tenth or a half.
double offOf(const CellWay& way) {
    return way.isMappedCells() ? 0 : 0.5;
}

class CellTiles final : public TileCaster {
public:
    CellTiles(const CompiledScene& scene, Index2 size, std::shared_ptr<const CellLook> look)
        : look_(std::move(look)),
          surroundings_(scene),
          world_(scene.camera, size),
          perStep_(1 / scene.stepLength()),
          background_(scene.render.background),
          root_(scene.root),
          cuts_(scene) {
        const Mat4& cellsFromWorld = look_->way.cellsFromWorld;
        view_ = {transformPoint(cellsFromWorld, world_.eye), transformVector(cellsFromWorld, world_.origin),
                 transformVector(cellsFromWorld, world_.right), transformVector(cellsFromWorld, world_.down)};
        bins_ = makeCellBins(look_->cells(), view_, size);
        volume_ = packetVolume(*look_->look);
        volume_.cells = &look_->cells();
        volume_.light = packetLight(scene, surroundings_);
        // Where inner cells end, those of the whole way are ragged.
        const bool gaps = mayHaveGaps(*scene.root) || look_->cells().firstRagged < look_->cells().cells.size();
        if (scene.render.shading && (gaps || look_->look->reachesFaces(kCutReach) || look_->cells().hasEnds()))
            volume_.cuts = {&cuts_, world_.eye, scene.stepLength(), offOf(look_->way) * cuts_.thickness(), gaps};
    }

    std::uint64_t cast(Picture& picture, Index2 first, Index2 end) const override {
        std::uint64_t samples = 0;
        for (int y = first.y / kTile; y * kTile < end.y; ++y)
            for (int x = first.x / kTile; x * kTile < end.x; ++x) {
                const Index2 tile = kTile * Index2(x, y);
                samples += castTile(picture, tile, glm::max(first, tile), glm::min(end, tile + kTile));
            }
        return samples;
    }

private:
    TileRays raysOf(Index2 tile, Index2 end) const {
        TileRays rays;
        rays.first = tile;
        rays.end = end;
        const Vec3 along = view_.forward + double(tile.x) * view_.right + double(tile.y) * view_.down;
        rays.along = {single(along), single(view_.right), single(view_.down)};
        rays.base = {single(view_.eye - look_->cells().origin + bins_.nearest * along),
                     single(bins_.nearest * view_.right), single(bins_.nearest * view_.down)};
        for (int n = 0; n < kTile * kTile; ++n) {
            const Vec3 direction = world_.direction(tile.x + n % kTile, tile.y + n / kTile);
            rays.steps[std::size_t(n)] = static_cast<float>(glm::length(direction) * perStep_);
        }
        return rays;
    }

    std::uint64_t castTile(Picture& picture, Index2 tile, Index2 first, Index2 end) const {
        if (bins_.at(tile / kTile).empty()) {
            const Vec4f nothing(background_, 0);
            for (int y = first.y; y < end.y; ++y)
                for (int x = first.x; x < end.x; ++x) picture.at(x, y) = nothing;
            return 0;
        }
        const TileRays rays = raysOf(tile, end);
        // Kept from tile to tile: fresh memory would cost as much as the rest.
        thread_local HitLists hits;
        hits.clear();
        rasterCells(look_->cells(), bins_, rays, hits);
        for (std::size_t pixel = 0; pixel < TileRays::kPixels; ++pixel)
            hits.shorten(pixel, orderedPieces(hits.of(pixel)));
        thread_local RaggedPieces ragged;
        ragged.clear();
        if (look_->cells().firstRagged < look_->cells().cells.size()) findRagged(rays, hits, ragged);
        const Index2 shape = packetShape();
        std::uint64_t samples = 0;
        for (int y = first.y / shape.y * shape.y; y < end.y; y += shape.y)
            for (int x = first.x / shape.x * shape.x; x < end.x; x += shape.x) {
                RayPacket packet;
                packet.own = ragged.maps();
                bool any = false;
                forPixels({x, y}, first, end, shape, [&](int px, int py, std::size_t lane) {
                    const auto pixel = std::size_t(px - tile.x + kTile * (py - tile.y));
                    packet.hits[lane] = hits.of(pixel);
                    if (packet.hits[lane].empty()) return;
                    setUp(rays, {px - tile.x, py - tile.y}, packet, lane);
                    any = true;
                });
                packet.transmittance.fill(1);
                if (any) castPacket(volume_, packet);
                samples += packet.samples;
                forPixels({x, y}, first, end, shape, [&](int px, int py, std::size_t lane) {
                    picture.at(px, py) = pixelOf(packet, lane, background_);
                });
            }
        return samples;
    }

    /// Puts the pieces within ragged cells in these cells' place.
    void findRagged(const TileRays& rays, HitLists& hits, RaggedPieces& ragged) const {
        const std::uint32_t first = look_->cells().firstRagged;
        const std::vector<std::uint32_t>& group = look_->cells().raggedGroup;
        std::array<bool, TileRays::kPixels> changed{};
        for (std::size_t pixel = 0; pixel < TileRays::kPixels; ++pixel) {
            const std::span<CellHit> of = hits.of(pixel);
            const auto place = Index2(int(pixel) % kTile, int(pixel) / kTile);
            for (std::size_t n = 0; n < of.size(); ++n) {
                if (of[n].cell < first) continue;
                RaggedPieces::Piece stretch{std::uint32_t(pixel), of[n].begin, of[n].end};
                const std::uint32_t cell = of[n].cell;
                changed[pixel] = true;
                while (n + 1 < of.size() && of[n + 1].cell >= first && of[n + 1].begin == stretch.end &&
                       group[of[n + 1].cell - first] == group[cell - first])
                    stretch.end = of[++n].end;
                const Ray ray = rayOf(rays, place);
                ragged.add(*look_, stretch, cell, ray.base, ray.along);
            }
        }
        ragged.find(*look_);
        putInPlace(ragged, changed, hits);
    }

    /// Takes ragged cells' hits out, and their pieces in.
    void putInPlace(const RaggedPieces& ragged, const std::array<bool, TileRays::kPixels>& changed,
                    HitLists& hits) const {
        const std::span<const RaggedPieces::Piece> pieces = ragged.pieces();
        std::vector<std::uint32_t> order(pieces.size());
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(pieces[a].pixel, pieces[a].begin) < std::pair(pieces[b].pixel, pieces[b].begin);
        });
        std::vector<CellHit> merged;
        auto next = order.begin();
        for (std::uint32_t pixel = 0; pixel < TileRays::kPixels; ++pixel) {
            if (!changed[pixel]) continue;
            merged.clear();
            const auto takeBefore = [&](float begin) {
                for (; next != order.end() && pieces[*next].pixel == pixel && pieces[*next].begin < begin; ++next)
                    merged.push_back({pieces[*next].begin, pieces[*next].end, kOwnPiece + *next});
            };
            for (const CellHit& hit : hits.of(pixel)) {
                if (hit.cell >= look_->cells().firstRagged) continue;
                takeBefore(hit.begin);
                merged.push_back(hit);
            }
            takeBefore(std::numeric_limits<float>::infinity());
            hits.shorten(pixel, {});
            for (const CellHit& hit : merged) hits.add(pixel, hit);
            hits.shorten(pixel, orderedPieces(hits.of(pixel)));
        }
    }

    struct Ray {
        std::array<float, 3> base, along;  // cell space; along is one step long
    };
    Ray rayOf(const TileRays& rays, Index2 at) const {
        const float x = float(at.x), y = float(at.y);
        const float inverse = 1 / rays.steps[std::size_t(at.x + kTile * at.y)];
        Ray ray;
        for (std::size_t a = 0; a < 3; ++a) {
            ray.base[a] = rays.base[0][a] + x * rays.base[1][a] + y * rays.base[2][a];
            ray.along[a] = (rays.along[0][a] + x * rays.along[1][a] + y * rays.along[2][a]) * inverse;
        }
        return ray;
    }

    /// The ray of a pixel of the tile.
    void setUp(const TileRays& rays, Index2 at, RayPacket& packet, std::size_t lane) const {
        const Ray ray = rayOf(rays, at);
        for (std::size_t a = 0; a < 3; ++a) {
            packet.base[a][lane] = ray.base[a];
            packet.along[a][lane] = ray.along[a];
        }
        const Vec3 direction = world_.direction(rays.first.x + at.x, rays.first.y + at.y);
        const double length = glm::length(direction);
        packet.distance[lane] = static_cast<float>(bins_.nearest * length);
        const Vec3 toEye = -direction / length;
        for (int a = 0; a < 3; ++a) packet.toEye[std::size_t(a)][lane] = static_cast<float>(toEye[a]);
    }

    std::shared_ptr<const CellLook> look_;
    Surroundings surroundings_;
    PictureRays world_;
    CellView view_;
    CellBins bins_;
    double perStep_;
    Vec3f background_;
    PacketVolume volume_;
    TermPtr root_;  // kept for the cuts
    CutFinder cuts_;
};

}  // namespace

std::unique_ptr<const TileCaster> makeCellTiles(const CompiledScene& scene, Index2 size,
                                                std::shared_ptr<const CellLook> look) {
    return std::make_unique<CellTiles>(scene, size, std::move(look));
}

}  // namespace voledit
