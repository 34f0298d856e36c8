#pragma once
// Compiled spatial objects: the immutable term that every renderer evaluates as written (definitions.md §§2–4).

#include <memory>
#include <span>
#include <string>
#include <variant>

#include "core/base/box3.h"
#include "core/fields/transfer_function.h"
#include "core/fields/volume.h"
#include "core/stf/spatial_transfer_function.h"

namespace voledit {

/// How the pre-images of a folded forward map combine.
enum class Combine : std::uint8_t { Union, Merge, Intersection, First };

struct Term;
using TermPtr = std::shared_ptr<const Term>;

/// A volume seen through a transfer function. Outside its domain opacity is exactly 0.
struct VolumeTerm {
    std::shared_ptr<const Volume> volume;
    int channel = 0;
    TransferFunction appearance;
};

/// What a TransferTerm was in the scene. `by: [a, b, c]` compiles to c of b of a, of which c is the `Outermost` and b
/// and a follow as `SameList`; a single STF is `Outermost`. An STF that is switched off is kept as an identity, so
/// that a `transfer` object is always to be found.
enum class TransferRole : std::uint8_t { Outermost, SameList, Place };

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
    std::variant<VolumeTerm, TransferTerm> node;
    Box3 bounds;
    std::shared_ptr<const TermCache> cache;  // what it finds out about itself on first use
};

/// One point of a spatial object.
struct ObjectSample {
    double opacity = 0;      // [0, 1], of one opacity distance
    Vec3 color{0};           // RGB in [0, 1]
    double value = kNaN;     // the scalar that was classified; NaN where there is none
    Vec3 normalGradient{0};  // gradient that shades, in the space of p (turned by every Jacobian above); 0: unlit
};

/// sample[i] = what `term` is at p[i]; opacity 0 where p[i] is outside or a map is undefined. The gradient is computed
/// only where `withGradient` and opacity > 0. Sizes must be equal. May be called from many threads.
void sample(const Term& term, std::span<const Vec3> p, std::span<ObjectSample> sample, bool withGradient);

TermPtr makeVolumeTerm(std::shared_ptr<const Volume> volume, int channel, TransferFunction appearance);
TermPtr makeTransferTerm(TransferPtr by, TermPtr of, Combine combine, std::string name,
                         TransferRole role = TransferRole::Outermost);

}  // namespace voledit
