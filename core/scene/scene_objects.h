#pragma once
// The objects of a scene, as written in a file (scene-format.md §1, Objects).

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/fields/volume.h"
#include "core/objects/term.h"
#include "core/scene/scene_transfers.h"

namespace voledit {

/// Either a preset's name, or tables; no member at all is the grey ramp.
struct Appearance {
    std::string preset;
    std::optional<Tracked<ColorTable>> color;
    std::optional<Tracked<PiecewiseLinear>> opacity;
    std::optional<Tracked<PiecewiseLinear>> gradientOpacity;

    bool operator==(const Appearance&) const = default;
};

struct ObjectUse {
    std::string name;
    bool operator==(const ObjectUse&) const = default;
};

/// `volume`: a volume's or a mesh's file.
struct VolumeObject {
    std::string asset;
    int channel = 0;
    Interpolation interpolation = Interpolation::Linear;
    Appearance appearance;
    bool operator==(const VolumeObject&) const = default;
};

// ---- Solids: what the members mean stands in core/objects/solid_shapes.h ------------------------------------------

struct SolidSphere {
    Tracked<Vec3> center{Vec3(0)};
    Tracked<double> radius = 1;
    bool operator==(const SolidSphere&) const = default;
};
struct SolidBox {
    TrackedBox box;
    bool operator==(const SolidBox&) const = default;
};
struct SolidCylinder {
    Tracked<Vec3> from{Vec3(0, 0, -1)}, to{Vec3(0, 0, 1)};
    Tracked<double> radius = 1;
    bool operator==(const SolidCylinder&) const = default;
};
struct SolidCapsule {
    Tracked<Vec3> from{Vec3(0, 0, -1)}, to{Vec3(0, 0, 1)};
    Tracked<double> radius = 1;
    bool operator==(const SolidCapsule&) const = default;
};
struct SolidTorus {
    Tracked<Vec3> center{Vec3(0)}, axis{Vec3(0, 0, 1)};
    Tracked<double> major = 1, minor = 0.25;
    bool operator==(const SolidTorus&) const = default;
};
struct SolidText {
    std::string string;
    Tracked<double> height = 1, depth = 0.25;
    bool operator==(const SolidText&) const = default;
};
/// `expression`: the signed distance as a formula over x, y, z, t (world).
struct SolidFormula {
    std::string d;
    TrackedBox bounds;
    bool operator==(const SolidFormula&) const = default;
};

struct SolidObject {
    std::variant<SolidSphere, SolidBox, SolidCylinder, SolidCapsule, SolidTorus, SolidText, SolidFormula> shape;
    Tracked<Vec3> color{Vec3(1)};
    /// A number, or a formula over x, y, z, r, d and t.
    std::variant<Tracked<double>, std::string> opacity = Tracked<double>(1);
    Tracked<double> falloff = 0;  // world units
    bool operator==(const SolidObject&) const = default;
};

// ---- Objects of other things --------------------------------------------------------------------------------------

/// `fields`: opacity, colour and further attributes as scalar fields.
struct FieldsObject {
    FieldRef opacity;
    std::array<FieldRef, 3> color;
    TrackedBox bounds;                           // outside which opacity is 0
    std::map<std::string, FieldRef> attributes;  // by name
    bool operator==(const FieldsObject&) const = default;
};

/// `union` … `trim`: two or more objects, combined left to right; `blend`: two.
struct CvgObject {
    CvgOperator by = CvgOperator::Union;
    std::vector<ObjectRef> of;
    FieldRef weight;  // of a blend; 0 for the others
    bool operator==(const CvgObject&) const = default;
};

struct PlaceObject {
    Placement placement;
    ObjectRef of;
    bool operator==(const PlaceObject&) const = default;
};

struct TransferObject {
    std::vector<TransferRef> by;  // applied in order, the first first
    ObjectRef of;
    Combine combine = Combine::Union;
    bool operator==(const TransferObject&) const = default;
};

struct DisplaceObject {
    DisplacementRef by;
    ObjectRef of;
    bool operator==(const DisplaceObject&) const = default;
};

/// Aᵢ = Φ(Aⱼ): tables over attribute `from`; at least one of the two.
struct RecolorObject {
    std::string from = "opacity";
    std::optional<Tracked<ColorTable>> color;
    std::optional<Tracked<PiecewiseLinear>> opacity;
    ObjectRef of;
    bool operator==(const RecolorObject&) const = default;
};

struct Object {
    std::variant<ObjectUse, VolumeObject, SolidObject, FieldsObject, CvgObject, TransferObject, DisplaceObject,
                 PlaceObject, RecolorObject, ActorObject>
        kind;
    bool operator==(const Object&) const = default;
};

}  // namespace voledit
