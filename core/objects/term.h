#pragma once
// Compiled spatial objects: the immutable term that every renderer evaluates as written (definitions.md §§2–4).

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/base/box3.h"
#include "core/expression/formula.h"
#include "core/fields/scalar_field.h"
#include "core/fields/transfer_function.h"
#include "core/fields/volume.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// How the pre-images of a folded forward map combine.
enum class Combine : std::uint8_t { Union, Merge, Intersection, First };

/// The operators of constructive volume geometry (definitions.md §4).
enum class CvgOperator : std::uint8_t { Union, Intersection, Difference, Merge, Cap, Trim, Blend };

class MeshField;

struct Term;
using TermPtr = std::shared_ptr<const Term>;

/// A volume seen through a transfer function. Outside its domain opacity is exactly 0.
struct VolumeTerm {
    std::shared_ptr<const Volume> volume;
    int channel = 0;
    TransferFunction appearance;
    Interpolation interpolation = Interpolation::Linear;
};

/// A mesh seen through a transfer function. Opacity 0 outside.
struct MeshTerm {
    std::shared_ptr<const MeshField> field;
    TransferFunction appearance;
};

/// A shape by its signed distance d (negative inside). Opacity is `opacity` where d ≤ 0 and fades linearly to 0 over
/// `falloff` outside. Lit by −∇d; no scalar.
struct SolidTerm {
    FieldPtr distance;
    Vec3 center{0};  // of the shape: r is the distance from it
    Box3 shape;      // holds all of d ≤ 0
    Vec3 color{1};
    FormulaGraph opacity;            // variable slots x, y, z, r, d; one output, clamped to [0, 1]
    std::vector<double> parameters;  // of `opacity`
    double falloff = 0;              // world units
};

/// An object of scalar fields. Opacity is clamped to [0, 1], 0 outside `bounds` and where undefined; lit by the
/// gradient of opacity.
struct FieldsTerm {
    FieldPtr opacity;
    std::array<FieldPtr, 3> color;
    Box3 box;
    std::map<std::string, FieldPtr> attributes;  // the named ones
};

/// A CVG operator over objects, combined from left to right as written; `weight` for blend alone (of two).
struct CvgTerm {
    CvgOperator by = CvgOperator::Union;
    std::vector<TermPtr> of;
    FieldPtr weight;
};

/// Aᵢ = Φ(Aⱼ): colour and opacity as tables over an attribute of `of` (`opacity`, `r`, `g`, `b`, `scalar`, or a named
/// one). Where the attribute is undefined, and where `of` has opacity 0, nothing changes.
struct RecolorTerm {
    std::string from = "opacity";
    std::optional<ColorTable> color;
    std::optional<PiecewiseLinear> opacity;
    TermPtr of;
};

/// What a TransferTerm was in the scene. `by: [a, b, c]` compiles to c of b of a, of which c is the `Outermost` and b
/// and a follow as `SameList`; a single STF is `Outermost`. An STF that is switched off is kept as an identity, so
/// that a `transfer` object is always to be found.
/// A sequence whose parts have several pre-images becomes several terms, the inner ones `Part`. `displace` compiles to
/// a transfer too, by p + Δ.
enum class TransferRole : std::uint8_t { Outermost, SameList, Place, Part, Displace };

/// [→](Ψ, of). `place` compiles to this too, with an AffineMap.
struct TransferTerm {
    TransferPtr by;
    TermPtr of;
    Combine combine = Combine::Union;
    std::string name;  // the STF's name in the scene, for `sample`'s path; may be empty
    TransferRole role = TransferRole::Outermost;
};

class TermCache;

/// One node of a compiled term, and the box that holds all of its opacity. Made by the functions below.
struct Term {
    std::variant<VolumeTerm, TransferTerm, MeshTerm, SolidTerm, FieldsTerm, CvgTerm, RecolorTerm> node;
    Box3 bounds;
    std::shared_ptr<const TermCache> cache;  // what it finds out about itself on first use
};

/// One point of a spatial object.
struct ObjectSample {
    double opacity = 0;  // [0, 1], of one opacity distance
    Vec3 color{0};       // RGB in [0, 1]
    /// The attribute asked for: by default the scalar that was classified; NaN where there is none. In composites it is
    /// that of the operand which decides (README.md).
    double value = kNaN;
    Vec3 normalGradient{0};  // gradient that shades, in the space of p (turned by every Jacobian above); 0: unlit
    /// How deep the point lies within a surface of solids (−d, and less for what others take off it; negative outside),
    /// for CVG operators to tell whose surface is near; NaN where there is none, and where no operator asks.
    double depth = kNaN;
};

/// sample[i] = what `term` is at p[i]; opacity 0 where p[i] is outside or a map is undefined. The gradient is computed
/// only where `withGradient` and opacity > 0. Sizes must be equal. May be called from many threads.
void sample(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, bool withGradient);
/// The same, with `value` the attribute `attribute`: "scalar" (the default above), "opacity", "r", "g", "b", or a name
/// that `fields` objects give. Asked for r, g or b, colour is given where opacity is 0, too (black where nothing is);
/// else it may be anything there. "": none is asked for, `value` may be anything, which is the fastest.
void sample(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, bool withGradient,
            const std::string& attribute);

TermPtr makeVolumeTerm(std::shared_ptr<const Volume> volume, int channel, TransferFunction appearance,
                       Interpolation interpolation = Interpolation::Linear);
TermPtr makeMeshTerm(std::shared_ptr<const MeshField> field, TransferFunction appearance);
TermPtr makeSolidTerm(SolidTerm solid);
TermPtr makeFieldsTerm(FieldsTerm fields);
/// Needs two or more objects; exactly two and a weight for blend.
TermPtr makeCvgTerm(CvgOperator by, std::vector<TermPtr> of, FieldPtr weight = nullptr);
TermPtr makeRecolorTerm(RecolorTerm recolor);
TermPtr makeTransferTerm(TransferPtr by, TermPtr of, Combine combine, std::string name,
                         TransferRole role = TransferRole::Outermost);

}  // namespace voledit
