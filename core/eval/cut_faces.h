#pragma once
// Faces that a gap of a map, the end of a domain, or a solid lays bare in data: they are lit by the normal of the cut,
// not by the data's behind it.

#include <optional>

#include "core/objects/seen_part.h"
#include "core/scene/compile.h"

namespace voledit {

/// A cut that a ray has passed.
struct CutFace {
    double depth = 0;  // along the ray, world units
    Vec3 place{0};     // just behind it
    Vec3 normal{0};    // unit, towards the eye
    /// Where the face is a plane one under maps: what is seen of the term, and its face.
    std::optional<SeenPart> part = std::nullopt;
    SeenPart::Face face = {};
};

/// How deep behind a cut its normal counts in pictures of `scene`: a voxel, but no more than 1/32 of the longest side,
/// as the spacing of a scaled volume says nothing of the world's. World units, whatever the step.
double cutThickness(const CompiledScene& scene);

/// Looks for cuts along rays. Lengths are world units.
class CutFinder {
public:
    /// `thickness`: how deep behind a cut its normal counts wholly; it is gone at twice that.
    CutFinder(const Term& term, double thickness);
    /// As pictures of `scene` have them.
    explicit CutFinder(const CompiledScene& scene);

    /// False where nothing can be cut: solids alone.
    bool mayCut() const { return mayCut_; }
    double thickness() const { return thickness_; }

    /// The cut that the ray passed less than two thicknesses before `depth`, where something is seen; nullopt where the
    /// same data go on there, seen or not.
    std::optional<CutFace> before(const Vec3& origin, const Vec3& direction, double depth) const;

    /// The gradient that shades a sample at p, `depth` along the ray, behind `cut`, whose data have `gradient`.
    Vec3 blended(const CutFace& cut, const Vec3& p, double depth, const Vec3& gradient) const;

private:
    const Term& term_;
    double thickness_;
    bool mayCut_;
};

}  // namespace voledit
