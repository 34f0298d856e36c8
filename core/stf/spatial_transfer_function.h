#pragma once
// Spatial transfer functions: backward maps of space [Chen et al. 2003; definitions.md §3].

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "core/base/box3.h"
#include "core/base/types.h"

namespace voledit {

class MappedCells;
class TransferVisitor;

/// What a bounded STF does with points outside its domain.
enum class Outside : std::uint8_t { Hide, Keep };

/// Backward map Ψ: the deformed object shows at p what the rest object holds at q = Ψ(p). Immutable, hence safe to
/// use from many threads.
class SpatialTransferFunction {
public:
    virtual ~SpatialTransferFunction() = default;

    /// q[i] = rest point of p[i], world units; kUndefined where the map is undefined or p[i] is. Where a folded
    /// forward map gives several, the first cell's. Needs equal sizes; q may alias p.
    virtual void map(std::span<const Vec3> p, std::span<Vec3> q) const = 0;

    /// jacobian[i] = dΨ/dp at p[i] (column c is the derivative along axis c), as the renderers use it for normals:
    /// ∇A' = Jᵀ∇A. The identity where the map is undefined. Needs equal sizes.
    virtual void jacobian(std::span<const Vec3> p, std::span<Mat3> jacobian) const = 0;

    /// Box that the forward image of `rest` stays within, world units.
    virtual Box3 imageOf(const Box3& rest) const = 0;

    /// Calls found(source) with boxes that together hold Ψ(p) of every p in `box` where the map is defined, until it
    /// gives true; gives whether it did. Not called where the map is undefined in all of `box`.
    virtual bool anySourceBox(const Box3& box, const std::function<bool(const Box3&)>& found) const = 0;

    /// The forward map sampled into mapped cells, for maps that are forward maps; else null.
    virtual const MappedCells* cells() const { return nullptr; }
    /// Outside the cells' image. Only for maps with cells.
    virtual Outside outside() const { return Outside::Hide; }

    /// The matrix p → q for maps that are affine throughout; nullopt for others.
    virtual std::optional<Mat4> affine() const { return std::nullopt; }

    virtual void accept(TransferVisitor& visitor) const = 0;
};

using TransferPtr = std::shared_ptr<const SpatialTransferFunction>;

class AffineMap;    // affine.h
class FormulaMap;   // formula_map.h: the library's and users' formula files, `expression`
class FieldsMap;    // field_maps.h: three scalar fields
class SequenceMap;  // composite_maps.h
class ScaledMap;    // composite_maps.h: p + k(p)·Δ(p)
class SumMap;       // composite_maps.h: p + ΣΔᵢ(p)
class ChosenMap;    // composite_maps.h: the larger or the smaller |Δ|
class BlendedMap;   // composite_maps.h: (1−w)Δ₁ + wΔ₂

/// What tells kinds of maps apart, for those that translate terms (the GLSL composer).
class TransferVisitor {
public:
    virtual ~TransferVisitor() = default;
    virtual void visit(const AffineMap& map) = 0;
    virtual void visit(const FormulaMap& map) = 0;
    virtual void visit(const FieldsMap& map) = 0;
    virtual void visit(const SequenceMap& map) = 0;
    virtual void visit(const ScaledMap& map) = 0;
    virtual void visit(const SumMap& map) = 0;
    virtual void visit(const ChosenMap& map) = 0;
    virtual void visit(const BlendedMap& map) = 0;
    /// Every map that has cells().
    virtual void visitCells(const SpatialTransferFunction& map) = 0;
};

}  // namespace voledit
