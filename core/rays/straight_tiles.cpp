// Undeformed volumes: rays are straight in index space.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/rays/packet_caster.h"
#include "core/rays/packet_light.h"
#include "core/rays/packet_picture.h"
#include "core/rays/picture_rays.h"
#include "core/rays/tile_caster.h"

namespace voledit {

namespace {

class StraightTiles final : public TileCaster {
public:
    StraightTiles(const CompiledScene& scene, Index2 size, std::shared_ptr<const VolumeLook> look,
                  const Mat4& indexFromWorld)
        : look_(std::move(look)),
          world_(scene.camera, size),
          eye_(transformPoint(indexFromWorld, world_.eye)),
          origin_(transformVector(indexFromWorld, world_.origin)),
          right_(transformVector(indexFromWorld, world_.right)),
          down_(transformVector(indexFromWorld, world_.down)),
          domain_(look_->volumeTerm().volume->grid().indexDomain()),
          step_(scene.stepLength()),
          background_(scene.render.background) {
        const VolumeTerm& node = look_->volumeTerm();
        volume_.volume = node.volume.get();
        volume_.table = &look_->table;
        volume_.skip = &look_->skip;
        volume_.light = packetLight(scene.render);
        const Mat3 m = glm::transpose(Mat3(indexFromWorld));
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) volume_.turn[std::size_t(c)][std::size_t(r)] = static_cast<float>(m[c][r]);
        const double side = double(1 << look_->skip.shift);
        visible_ = intersect(domain_, {side * Vec3(look_->skip.first), side * Vec3(look_->skip.end)});
    }

    std::uint64_t cast(Picture& picture, Index2 first, Index2 end) const override {
        std::uint64_t samples = 0;
        const Index2 shape = packetShape();
        for (int y = first.y; y < end.y; y += shape.y)
            for (int x = first.x; x < end.x; x += shape.x)
                samples += castAt(picture, {x, y}, glm::min(Index2(x, y) + shape, end), shape);
        return samples;
    }

private:
    std::uint64_t castAt(Picture& picture, Index2 first, Index2 end, Index2 shape) const {
        RayPacket packet;
        std::array<CellHit, RayPacket::kMost> hits;
        bool any = false;
        forPixels(first, first, end, shape, [&](int x, int y, std::size_t lane) {
            if (!setUp(x, y, hits[lane], packet, lane)) return;
            packet.hits[lane] = std::span(&hits[lane], 1);
            any = true;
        });
        packet.transmittance.fill(1);
        if (any) castPacket(volume_, packet);
        forPixels(first, first, end, shape,
                  [&](int x, int y, std::size_t lane) { picture.at(x, y) = pixelOf(packet, lane, background_); });
        return packet.samples;
    }

    /// The piece of the ray of pixel (x, y) within the volume; false where it meets nothing visible.
    bool setUp(int x, int y, CellHit& hit, RayPacket& packet, std::size_t lane) const {
        const Vec3 direction = origin_ + double(x) * right_ + double(y) * down_;
        double near = 0, far = kInfinity, nearVisible = 0, farVisible = kInfinity;
        for (int a = 0; a < 3; ++a) {
            const double inverse = 1 / (direction[a] == 0 ? 1e-300 : direction[a]);
            const auto cut = [&](const Box3& box, double& from, double& to) {
                const double one = (box.min[a] - eye_[a]) * inverse, other = (box.max[a] - eye_[a]) * inverse;
                from = std::max(from, std::min(one, other));
                to = std::min(to, std::max(one, other));
            };
            cut(domain_, near, far);
            cut(visible_, nearVisible, farVisible);
        }
        if (!(near < far) || !(nearVisible <= farVisible)) return false;
        const Vec3 world = world_.direction(x, y);
        const double inverseLength = 1 / glm::length(world), step = step_ * inverseLength;
        hit.begin = std::max(0.F, std::floor(static_cast<float>((nearVisible - near) / step)));
        hit.end = static_cast<float>((far - near) / step);
        for (int a = 0; a < 3; ++a) {
            packet.base[std::size_t(a)][lane] = static_cast<float>(eye_[a] + near * direction[a]);
            packet.along[std::size_t(a)][lane] = static_cast<float>(step * direction[a]);
            packet.toEye[std::size_t(a)][lane] = static_cast<float>(-world[a] * inverseLength);
        }
        return true;
    }

    std::shared_ptr<const VolumeLook> look_;
    PictureRays world_;
    Vec3 eye_, origin_, right_, down_;  // the rays in index space
    Box3 domain_, visible_;
    double step_;
    Vec3f background_;
    PacketVolume volume_;
};

}  // namespace

std::unique_ptr<const TileCaster> makeStraightTiles(const CompiledScene& scene, Index2 size,
                                                    std::shared_ptr<const VolumeLook> look,
                                                    const Mat4& indexFromWorld) {
    return std::make_unique<StraightTiles>(scene, size, std::move(look), indexFromWorld);
}

}  // namespace voledit
