#include "app/editor/tools/actor_overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/editor/theme.h"
#include "core/scene/scene_values.h"

namespace voledit {

namespace {

constexpr Vec4f kBone{0.93f, 0.94f, 0.97f, 1};
constexpr Vec4f kOutline{0.05f, 0.06f, 0.08f, 1};
constexpr Vec4f kRegion{0.62f, 0.80f, 0.98f, 1};
constexpr double kRingRadius = 62;  // design pixels
constexpr int kRingPieces = 64;

bool contains(const std::vector<int>& joints, int joint) {
    return std::find(joints.begin(), joints.end(), joint) != joints.end();
}

double worldPerPixel(const ActorLook& look, const Vec3& at) {
    const double depth = project(look.camera, look.size, at).z;
    return 2 * depth * std::tan(glm::radians(look.camera.fovY) / 2) / std::max(1, look.size.y);
}

/// Dark below bright, so that bones are seen on skin as on the background.
void appendBoneLine(const Vec3& from, const Vec3& to, const Vec4f& color, double width, Overlay& overlay) {
    overlay.lines.push_back({from, to, color, float(width)});
}

/// An octahedron from `from` to `to`: thickest a tenth of the way along.
void appendBone(const Vec3& from, const Vec3& to, const Vec4f& color, const ActorLook& look, double width,
                Overlay& overlay) {
    const double length = glm::distance(from, to);
    if (!(length > 0)) return;
    const Mat3 frame = boneFrame((to - from) / length, 0);
    const Vec3 belt = from + 0.12 * (to - from);
    std::array<Vec3, 4> corners;
    for (int c = 0; c < 4; ++c) {
        const Vec3& along = frame[c % 2];
        corners[std::size_t(c)] = belt + along * (0.075 * length * (c < 2 ? 1 : -1));
    }
    const auto draw = [&](const Vec4f& shade, double wide) {
        for (std::size_t c = 0; c < 4; ++c) {
            appendBoneLine(from, corners[c], shade, wide, overlay);
            appendBoneLine(corners[c], to, shade, wide, overlay);
            appendBoneLine(corners[c], corners[(c + 1) % 4], shade, wide, overlay);
        }
    };
    draw(withAlpha(kOutline, 0.55f * color.w), (width + 1.6) * look.scale);
    draw(color, width * look.scale);
}

bool joinedByLimb(const CompiledActor& actor, int from, int to) {
    return std::any_of(actor.limbs.begin(), actor.limbs.end(),
                       [&](const Limb& limb) { return limb.from == from && limb.to == to; });
}

void appendLinks(const CompiledActor& actor, const ActorLook& look, Overlay& overlay) {
    const float alpha = look.active ? 0.4f : 0.18f;
    for (int j = 0; j < int(actor.skeleton.joints.size()); ++j) {
        const int parent = actor.skeleton.joints[std::size_t(j)].parent;
        if (parent == Joint::kNoParent || joinedByLimb(actor, parent, j)) continue;
        overlay.lines.push_back(
            {shownJoint(actor, parent), shownJoint(actor, j), withAlpha(kBone, alpha), float(look.scale)});
    }
}

void appendBones(const CompiledActor& actor, const ActorLook& look, Overlay& overlay) {
    for (int l = 0; l < int(actor.limbs.size()); ++l) {
        const Limb& limb = actor.limbs[std::size_t(l)];
        const bool selected = contains(look.selected, limb.from), hovered = look.hoveredBone == l;
        const Vec4f color = selected  ? theme::kAccent
                            : hovered ? Vec4f(1)
                                      : withAlpha(kBone, look.active ? 0.8f : 0.3f);
        appendBone(shownJoint(actor, limb.from), shownJoint(actor, limb.to), color, look,
                   selected || hovered ? 1.6 : 1.1, overlay);
    }
}

void appendJoints(const CompiledActor& actor, const ActorLook& look, Overlay& overlay) {
    std::vector<std::pair<double, OverlayPoint>> points;
    for (int j = 0; j < int(actor.skeleton.joints.size()); ++j) {
        const bool selected = contains(look.selected, j), hovered = look.hovered == j;
        const bool leads = selected && look.selected.back() == j;
        const bool tip = actor.skeleton.childrenOf(j).empty();
        const float alpha = selected || hovered ? 1.0f : look.active ? 0.95f : 0.4f;
        const Vec4f fill = selected ? theme::kAccent : kBone;
        const Vec4f ring = leads || hovered ? Vec4f(1) : selected ? Vec4f(0.8f, 0.9f, 1, 1) : kOutline;
        const double radius = leads ? 5.5 : selected || hovered ? 5 : tip ? 2.6 : 3.8;
        const Vec3 at = shownJoint(actor, j);
        points.push_back({glm::distance(at, look.camera.eye) - (selected || hovered ? 1e6 : 0),
                          {at, withAlpha(fill, alpha), float(radius * look.scale), withAlpha(ring, alpha)}});
    }
    // What is drawn last lies on top.
    std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [distance, point] : points) overlay.points.push_back(point);
}

void appendRegion(const CompiledActor& actor, int limb, const Vec4f& color, double width, Overlay& overlay) {
    if (!actor.regions) return;
    for (const std::vector<Vec3>& edge : outlineOf(*actor.regions, limb, actor.options))
        for (std::size_t n = 0; n + 1 < edge.size(); ++n)
            overlay.lines.push_back({transformPoint(actor.worldFromObject, edge[n]),
                                     transformPoint(actor.worldFromObject, edge[n + 1]), color, float(width)});
}

/// Points of the ring about `axis`, around the joint; equally far from it on the screen wherever it is.
struct Ring {
    Vec3 center{0}, toEye{0, 0, 1};
    double radius = 0;
    std::array<Vec3, kRingPieces> points;

    /// Whether a point of it lies behind the joint; one seen from the front, all in one depth, has none.
    bool hides(const Vec3& p) const { return glm::dot(p - center, toEye) < -0.05 * radius; }
};
Ring ringOf(const CompiledActor& actor, int joint, int axis, const ActorLook& look) {
    Ring ring;
    ring.center = shownJoint(actor, joint);
    ring.toEye = glm::normalize(look.camera.eye - ring.center);
    const CameraBasis basis = basisOf(look.camera);
    Vec3 u = basis.right, v = basis.up;
    double radius = kRingRadius * look.scale * worldPerPixel(look, ring.center);
    if (axis < 3) {
        const Mat3 axes = shownAxes(actor, joint);
        // Skewed where the skeleton is laid in by unequal scales: the ring stands across its axis all the same.
        u = glm::normalize(axes[(axis + 1) % 3] - axes[axis] * glm::dot(axes[axis], axes[(axis + 1) % 3]));
        v = glm::cross(axes[axis], u);
    } else {
        radius *= 1.22;
    }
    ring.radius = radius;
    for (int n = 0; n < kRingPieces; ++n) {
        const double phi = 2 * kPi * n / kRingPieces;
        ring.points[std::size_t(n)] = ring.center + radius * (std::cos(phi) * u + std::sin(phi) * v);
    }
    return ring;
}

double distanceToSegment(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double squared = glm::dot(along, along);
    const double s = squared > 0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0;
    return glm::distance(p, a + s * along);
}

/// Points as `look` at every `step`-th of the voxels for which `wanted` is true.
template <class Wanted>
void appendVoxels(const CompiledActor& actor, const OpaqueVoxels& voxels, const Wanted& wanted, std::size_t step,
                  OverlayPoint look, Overlay& overlay) {
    std::size_t met = 0, index = 0;
    for (int z = 0; z < voxels.size.z; ++z)
        for (int y = 0; y < voxels.size.y; ++y)
            for (int x = 0; x < voxels.size.x; ++x, ++index) {
                if (!wanted(index) || met++ % step != 0) continue;
                look.at = transformPoint(actor.worldFromObject, voxels.centre({x, y, z}));
                overlay.points.push_back(look);
            }
}

}  // namespace

void appendActor(const CompiledActor& actor, const ActorLook& look, Overlay& overlay) {
    if (look.regions)
        for (int l = 0; l < int(actor.limbs.size()); ++l)
            appendRegion(actor, l, withAlpha(kRegion, look.active ? 0.5f : 0.25f), look.scale, overlay);
    for (const int joint : look.selected)
        for (const int limb : limbsFrom(actor, joint))
            appendRegion(actor, limb, withAlpha(theme::kAccent, 0.9f), 1.4 * look.scale, overlay);
    appendLinks(actor, look, overlay);
    appendBones(actor, look, overlay);
    appendJoints(actor, look, overlay);
}

void appendCoverage(const CompiledActor& actor, const ActorBody& body, const Coverage& coverage, double scale,
                    Overlay& overlay) {
    if (coverage.regions.size() != body.voxels.opaque.size()) return;
    const auto& regions = coverage.regions;
    const auto& opaque = body.voxels.opaque;
    // What is missing matters more than what is there twice.
    constexpr std::size_t kMostTwice = 4'000, kMostMissing = 12'000;
    const OverlayPoint twice{Vec3(0), Vec4f(0.98f, 0.83f, 0.25f, 0.45f), float(1.2 * scale), Vec4f(0)};
    const OverlayPoint missing{Vec3(0), withAlpha(theme::kProblem, 0.95f), float(2 * scale), Vec4f(0)};
    appendVoxels(
        actor, body.voxels, [&](std::size_t i) { return opaque[i] && regions[i] > 1; },
        coverage.doubly / kMostTwice + 1, twice, overlay);
    appendVoxels(
        actor, body.voxels, [&](std::size_t i) { return opaque[i] && regions[i] == 0; },
        coverage.uncovered / kMostMissing + 1, missing, overlay);
}

void appendRings(const CompiledActor& actor, int joint, const std::optional<RingHit>& marked, const ActorLook& look,
                 Overlay& overlay) {
    if (!(project(look.camera, look.size, shownJoint(actor, joint)).z > 0)) return;
    for (int axis = 3; axis >= 0; --axis) {
        const Ring ring = ringOf(actor, joint, axis, look);
        const bool strong = marked && marked->axis == axis;
        const Vec4f color = axis < 3 ? theme::kAxis[std::size_t(axis)] : Vec4f(0.85f, 0.87f, 0.9f, 1);
        for (std::size_t n = 0; n < kRingPieces; ++n) {
            const Vec3 &from = ring.points[n], &to = ring.points[(n + 1) % kRingPieces];
            const bool behind = axis < 3 && ring.hides(0.5 * (from + to));
            const float alpha = strong ? 1.0f : behind ? 0.22f : axis == 3 ? 0.55f : 0.9f;
            overlay.lines.push_back({from, to, withAlpha(color, alpha),
                                     float((strong   ? 2.6
                                            : behind ? 1.2
                                                     : 1.8) *
                                           look.scale)});
        }
    }
}

std::optional<RingHit> ringAt(const CompiledActor& actor, int joint, const ActorLook& look, const Vec2& at,
                              double radius) {
    if (!(project(look.camera, look.size, shownJoint(actor, joint)).z > 0)) return std::nullopt;
    std::optional<RingHit> best;
    double nearest = radius;
    for (int axis = 0; axis < 4; ++axis) {
        const Ring ring = ringOf(actor, joint, axis, look);
        for (std::size_t n = 0; n < kRingPieces; ++n) {
            const Vec3 from = project(look.camera, look.size, ring.points[n]);
            const Vec3 to = project(look.camera, look.size, ring.points[(n + 1) % kRingPieces]);
            // What lies behind the joint is faint, and not taken.
            if (axis < 3 && ring.hides(ring.points[n])) continue;
            const double distance = distanceToSegment(at, Vec2(from), Vec2(to));
            if (from.z > 0 && to.z > 0 && distance < nearest) {
                nearest = distance;
                best = RingHit{axis};
            }
        }
    }
    return best;
}

}  // namespace voledit
