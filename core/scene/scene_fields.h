#pragma once
// The scalar fields of a scene, as written in a file (scene-format.md §1, Scalar fields).

#include <string>
#include <variant>

#include "core/base/shared_value.h"
#include "core/scene/scene_values.h"

namespace voledit {

struct Object;
struct Transfer;
struct Displacement;
struct Field;
using ObjectRef = SharedValue<Object>;
using TransferRef = SharedValue<Transfer>;
using DisplacementRef = SharedValue<Displacement>;
using FieldRef = SharedValue<Field>;

/// One value everywhere.
struct NumberField {
    Tracked<double> value = 0;
    bool operator==(const NumberField&) const = default;
};

/// `expression`: a formula over x, y, z (world) and t (seconds).
struct FormulaField {
    std::string expression;
    bool operator==(const FormulaField&) const = default;
};

/// `component`: of Ψ(p) for an STF, of Δ(p) for an SD object. A bare STF needs a frame of its own.
struct ComponentOf {
    int axis = 0;  // 0, 1, 2
    std::variant<TransferRef, DisplacementRef> of;
    bool operator==(const ComponentOf&) const = default;
};

/// `attribute`: one of an object.
struct AttributeOf {
    std::string name;  // opacity, r, g, b, scalar, or one that a `fields` object names
    ObjectRef of;
    bool operator==(const AttributeOf&) const = default;
};

/// `asset`: the values of a volume (or mesh) file where it stands.
struct AssetField {
    std::string asset;
    int channel = 0;
    bool operator==(const AssetField&) const = default;
};

/// `map`: Φ(of), a piecewise-linear table.
struct MappedField {
    Tracked<PiecewiseLinear> table;
    FieldRef of;
    bool operator==(const MappedField&) const = default;
};

struct Field {
    std::variant<NumberField, FormulaField, ComponentOf, AttributeOf, AssetField, MappedField> kind;
    bool operator==(const Field&) const = default;
};

}  // namespace voledit
