#pragma once
// Axis-aligned boxes and parallelepiped frames.

#include "core/base/types.h"

namespace voledit {

/// Axis-aligned box, world units, closed. Default-constructed it is empty (min > max) and neutral for `join`.
struct Box3 {
    Vec3 min{kInfinity};
    Vec3 max{-kInfinity};

    bool operator==(const Box3&) const = default;

    bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    Vec3 size() const { return empty() ? Vec3(0) : max - min; }
    Vec3 center() const { return 0.5 * (min + max); }
    bool contains(const Vec3& p) const {
        return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y && p.z <= max.z;
    }
    /// Corner c of 0…7: bit 0 chooses x, bit 1 y, bit 2 z (0 min, 1 max).
    Vec3 corner(int c) const { return {c & 1 ? max.x : min.x, c & 2 ? max.y : min.y, c & 4 ? max.z : min.z}; }
};

/// Smallest box that holds both.
Box3 join(const Box3& a, const Box3& b);
/// Smallest box that holds `a` and the point `p`.
Box3 join(const Box3& a, const Vec3& p);
/// The common box; empty where they do not meet.
Box3 intersect(const Box3& a, const Box3& b);
/// Box of the eight corners of `box` moved by `m` (an affine matrix, column vectors).
Box3 transformed(const Box3& box, const Mat4& m);

/// A box that holds every point of `box` moved by `m`: from its centre and half sides, cheaper than eight corners. An
/// infinite box stays infinite.
Box3 movedBox(const Box3& box, const Mat4& m);

/// A box with a corner and three edge vectors, world units; u = F⁻¹(p) are its normalised coordinates, [0,1]³ within
/// (definitions.md §1). Edges may be oblique but must span space.
struct Frame {
    Vec3 corner{0};
    std::array<Vec3, 3> edge{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

    bool operator==(const Frame&) const = default;
};

/// The frame whose corner is `box.min` and whose edges are the box's sides.
Frame frameOf(const Box3& box);
/// p = corner + edges · u, as an affine matrix.
Mat4 worldFromNormalised(const Frame& frame);
/// Inverse of `worldFromNormalised`. Needs edges that span space.
Mat4 normalisedFromWorld(const Frame& frame);
/// Axis-aligned box of the frame's eight corners.
Box3 boundsOf(const Frame& frame);

/// `m` applied to a point (w = 1; no perspective division).
inline Vec3 transformPoint(const Mat4& m, const Vec3& p) {
    return Vec3(m * Vec4(p, 1.0));
}
/// `m`'s linear part applied to a direction.
inline Vec3 transformVector(const Mat4& m, const Vec3& v) {
    return Mat3(m) * v;
}

}  // namespace voledit
