// Undeformed volumes: rays are straight in index space.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/eval/surroundings.h"
#include "core/rays/packet_caster.h"
#include "core/rays/packet_light.h"
#include "core/rays/packet_picture.h"
#include "core/rays/picture_rays.h"
#include "core/rays/straight_rays.h"
#include "core/rays/tile_caster.h"

namespace voledit {

namespace {

class StraightTiles final : public TileCaster {
public:
    StraightTiles(const CompiledScene& scene, Index2 size, std::shared_ptr<const VolumeLook> look,
                  const Mat4& indexFromWorld)
        : look_(std::move(look)),
          surroundings_(scene),
          world_(scene.camera, size),
          eye_(transformPoint(indexFromWorld, world_.eye)),
          origin_(transformVector(indexFromWorld, world_.origin)),
          right_(transformVector(indexFromWorld, world_.right)),
          down_(transformVector(indexFromWorld, world_.down)),
          domain_(look_->volumeTerm().volume->grid().indexDomain()),
          step_(scene.stepLength()),
          background_(scene.render.background),
          root_(scene.root),
          cuts_(scene) {
        volume_ = packetVolume(*look_);
        volume_.light = packetLight(scene, surroundings_);
        volume_.turn = gradientTurn(glm::transpose(Mat3(indexFromWorld)));
        if (scene.render.shading && look_->reachesFaces(kCutReach))
            volume_.cuts = {&cuts_, world_.eye, step_, 0, false};
        const double side = double(1 << look_->skip().shift);
        visible_ = intersect(domain_, {side * Vec3(look_->skip().first), side * Vec3(look_->skip().end)});
    }

    std::uint64_t cast(Picture& picture, Index2 first, Index2 end) const override {
        const StraightRays rays = raysFrom(first);
        const Index2 shape = packetShape();
        RayPacket packet;
        std::array<CellHit, RayPacket::kMost> hits;
        for (int y = first.y; y < end.y; y += shape.y)
            for (int x = first.x; x < end.x; x += shape.x) {
                if (!setUpStraight(rays, Index2(x, y) - first, packet, hits)) {
                    forPixels({x, y}, first, end, shape,
                              [&](int px, int py, std::size_t) { picture.at(px, py) = Vec4f(background_, 0); });
                    continue;
                }
                castPacket(volume_, packet);
                forPixels({x, y}, first, end, shape, [&](int px, int py, std::size_t lane) {
                    picture.at(px, py) = pixelOf(packet, lane, background_);
                });
            }
        return packet.samples;
    }

private:
    StraightRays raysFrom(Index2 pixel) const {
        const auto single = [](const Vec3& v) {
            return StraightRays::Numbers{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
        };
        const Vec3 at = origin_ + double(pixel.x) * right_ + double(pixel.y) * down_;
        StraightRays rays;
        rays.eye = single(eye_);
        rays.index = {single(at), single(right_), single(down_)};
        rays.world = {single(world_.direction(pixel.x, pixel.y)), single(world_.right), single(world_.down)};
        rays.domainMin = single(domain_.min);
        rays.domainMax = single(domain_.max);
        rays.visibleMin = single(visible_.min);
        rays.visibleMax = single(visible_.max);
        rays.step = static_cast<float>(step_);
        return rays;
    }

    std::shared_ptr<const VolumeLook> look_;
    Surroundings surroundings_;
    PictureRays world_;
    Vec3 eye_, origin_, right_, down_;  // the rays in index space
    Box3 domain_, visible_;
    double step_;
    Vec3f background_;
    PacketVolume volume_;
    TermPtr root_;  // kept for the cuts
    CutFinder cuts_;
};

}  // namespace

std::unique_ptr<const TileCaster> makeStraightTiles(const CompiledScene& scene, Index2 size,
                                                    std::shared_ptr<const VolumeLook> look,
                                                    const Mat4& indexFromWorld) {
    return std::make_unique<StraightTiles>(scene, size, std::move(look), indexFromWorld);
}

}  // namespace voledit
