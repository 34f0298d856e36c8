#include "core/eval/cut_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/objects/seen_part.h"

namespace voledit {

namespace {

constexpr int kHalvings = 30;
constexpr double kInside = 1e-6;  // thicknesses: a place behind a face that rounding does not take out
constexpr int kSearched = 4;      // places of a ray, back to two thicknesses
constexpr double kAhead = 0.1;    // thicknesses: volumes are seen up to a thousandth of a voxel outside their boxes
/// How far aside, in thicknesses, a face is looked for, and how far before and behind as multiples of that: less far
/// near edges and in narrow gaps; the second finds faces that are seen as flat as by 1.5°.
struct Aside {
    double shift, reach;
};
constexpr std::array<Aside, 4> kAside{{{0.5, 6}, {0.1, 40}, {0.02, 6}, {0.004, 6}}};
/// How much the slopes on both sides may differ: a face that is bent as sharply as by a radius of five thicknesses.
constexpr double kBend = 0.1;

/// Where along a line a part begins between two depths; nullopt unless it is out at the first and in at the second.
std::optional<double> beginning(const SeenPart& part, const Vec3& origin, const Vec3& direction, double out,
                                double in) {
    if (part.within(origin + out * direction) || !part.within(origin + in * direction)) return std::nullopt;
    for (int n = 0; n < kHalvings; ++n) {
        const double middle = (out + in) / 2;
        (part.within(origin + middle * direction) ? in : out) = middle;
    }
    return (out + in) / 2;
}

/// How much deeper the face at `here` lies for each unit aside. Lines on both sides must agree, else an edge is near:
/// then it is looked for less far aside.
std::optional<double> slopeAlong(const SeenPart& part, const Vec3& here, const Vec3& direction, const Vec3& side,
                                 double thickness) {
    std::optional<double> found;
    for (const Aside& aside : kAside) {
        const double shift = aside.shift * thickness, reach = aside.reach * shift;
        const auto there = beginning(part, here + shift * side, direction, -reach, reach),
                   opposite = beginning(part, here - shift * side, direction, -reach, reach);
        if (there && opposite && std::abs(*there + *opposite) < kBend * shift)
            return (*there - *opposite) / (2 * shift);
        if (there || opposite) found = there ? *there / shift : -*opposite / shift;
    }
    return found;
}

/// Two directions at right angles to a unit one, and to each other.
std::array<Vec3, 2> across(const Vec3& direction) {
    const Vec3 size = glm::abs(direction);
    const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                      : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                           : Vec3(0, 0, 1);
    const Vec3 first = glm::normalize(glm::cross(direction, axis));
    return {first, glm::cross(direction, first)};
}

}  // namespace

double cutThickness(const CompiledScene& scene) {
    const Vec3 size = scene.root->bounds.size();
    return std::min(scene.unitStep, std::max({size.x, size.y, size.z}) / 32);
}

CutFinder::CutFinder(const CompiledScene& scene) : CutFinder(*scene.root, cutThickness(scene)) {}

CutFinder::CutFinder(const Term& term, double thickness)
    : term_(term), thickness_(thickness), mayCut_(holdsData(term)) {}

std::optional<CutFace> CutFinder::before(const Vec3& origin, const Vec3& direction, double seen) const {
    if (!mayCut_) return std::nullopt;
    const SeenPart part(term_, origin + seen * direction);
    if (!part.isData()) return std::nullopt;
    std::array<double, kSearched + 2> depths{seen + kAhead * thickness_, seen};
    for (int n = 0; n < kSearched; ++n) depths[std::size_t(n) + 2] = seen - (n + 1) * 2 * thickness_ / kSearched;
    std::array<Vec3, depths.size()> places{};
    for (std::size_t n = 0; n < places.size(); ++n) places[n] = origin + depths[n] * direction;
    std::array<std::uint8_t, places.size()> within{};
    part.within(places, within);
    const auto out = std::find(within.begin() + 1, within.end(), 0) - within.begin();
    if (out == int(within.size())) return std::nullopt;
    const auto depth = beginning(part, origin, direction, depths[std::size_t(out)], depths[std::size_t(out) - 1]);
    if (!depth) return std::nullopt;
    const Vec3 here = origin + *depth * direction;
    const double little = kInside * thickness_;
    const Vec3 inner = here + little * direction;
    if (const auto face = part.face(inner)) return CutFace{*depth, inner, {}, part, *face};
    if (part.isOutOfCells(here - little * direction)) return std::nullopt;
    std::array<Vec3, 2> along{};
    const auto sides = across(direction);
    for (std::size_t n = 0; n < 2; ++n) {
        const auto slope = slopeAlong(part, here, direction, sides[n], thickness_);
        if (!slope) return std::nullopt;
        along[n] = sides[n] + *slope * direction;
    }
    const Vec3 normal = glm::normalize(glm::cross(along[0], along[1]));
    return CutFace{*depth, inner, glm::dot(normal, direction) > 0 ? -normal : normal};
}

Vec3 CutFinder::blended(const CutFace& cut, const Vec3& p, double depth, const Vec3& gradient) const {
    const double weight = std::clamp(2 - (depth - cut.depth) / thickness_, 0.0, 1.0);
    if (weight <= 0) return gradient;
    // Samples may lie in front of the cut by rounding, where maps may lead nowhere.
    const Vec3& at = depth > cut.depth + kInside * thickness_ ? p : cut.place;
    const Vec3 normal = cut.part ? cut.part->normalOf(cut.face, at) : cut.normal;
    const double length = glm::length(gradient);
    if (weight >= 1 || !(length > 0) || !std::isfinite(length)) return normal;
    const Vec3 own = gradient / (glm::dot(gradient, normal) < 0 ? -length : length);
    return weight * normal + (1 - weight) * own;
}

}  // namespace voledit
