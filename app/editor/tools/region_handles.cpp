#include "app/editor/tools/region_handles.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/editor/theme.h"

namespace voledit {

namespace {

constexpr int kFaces = 6;

/// Outward sign of a face.
double signOf(int face) {
    return face % 2 == 0 ? -1 : 1;
}

}  // namespace

HandlePlace placeOf(const CompiledActor& actor, const RegionHandle& handle) {
    const Limb& limb = actor.limbs[std::size_t(handle.limb)];
    const Vec3 from = actor.rest[std::size_t(limb.from)].position, to = actor.rest[std::size_t(limb.to)].position;
    const Vec3 along = glm::normalize(to - from);
    const Mat3 frame = boneFrame(along, limb.roll);
    const Vec3 middle = 0.5 * (from + to) + frame * Vec3(limb.offset, 0);
    const int axis = handle.face / 2;
    const double half =
        axis < 2 ? 0.5 * limb.size[axis] : 0.5 * glm::distance(from, to) + limb.pad[handle.face == 5 ? 1 : 0];
    const Vec3 out = signOf(handle.face) * frame[axis];
    return {transformPoint(actor.worldFromObject, middle + half * out), Mat3(actor.worldFromObject) * out};
}

std::optional<RegionHandle> handleAt(const CompiledActor& actor, const std::vector<int>& limbs, const Camera& camera,
                                     Index2 size, const Vec2& at, double radius) {
    std::optional<RegionHandle> best;
    double nearest = radius;
    for (const int limb : limbs)
        for (int face = 0; face < kFaces; ++face) {
            const Vec3 pixel = project(camera, size, placeOf(actor, {limb, face}).at);
            const double distance = glm::distance(Vec2(pixel), at);
            if (!(pixel.z > 0) || distance > nearest) continue;
            nearest = distance;
            best = RegionHandle{limb, face};
        }
    return best;
}

double pulledBy(const HandlePlace& place, const Camera& camera, Index2 size, const Vec2& pixels) {
    const Vec3 start = project(camera, size, place.at);
    // A step so short that it is seen as straight as the pointer goes.
    const double step = 0.01 * start.z / std::max(glm::length(place.out), 1e-300);
    const Vec2 along = (Vec2(project(camera, size, place.at + step * place.out)) - Vec2(start)) / step;
    const double squared = glm::dot(along, along);
    // Seen from the front a face has no way out on the screen.
    return std::sqrt(squared) * step < 0.05 ? 0 : glm::dot(pixels, along) / squared;
}

void pull(SceneLimb& changed, const Limb& limb, int face, double distance) {
    const int axis = face / 2;
    if (axis == 2) {
        Vec2 pad = limb.pad;
        pad[face == 5 ? 1 : 0] += distance;
        changed.pad = Tracked<Vec2>(pad);
        return;
    }
    const double by = std::max(distance, -0.999 * limb.size[axis]);
    Vec2 size = limb.size, offset = limb.offset;
    size[axis] += by;
    offset[axis] += 0.5 * signOf(face) * by;
    changed.size = Tracked<Vec2>(size);
    changed.offset = Tracked<Vec2>(offset);
}

void appendHandles(const CompiledActor& actor, const std::vector<int>& limbs, const std::optional<RegionHandle>& marked,
                   double scale, Overlay& overlay) {
    for (const int limb : limbs)
        for (int face = 0; face < kFaces; ++face) {
            const bool strong = marked == RegionHandle{limb, face};
            overlay.points.push_back({placeOf(actor, {limb, face}).at, strong ? Vec4f(1) : theme::kAnimated,
                                      float((strong ? 5.5 : 4) * scale), Vec4f(0.05f, 0.06f, 0.08f, 1)});
        }
}

}  // namespace voledit
