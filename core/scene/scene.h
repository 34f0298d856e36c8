#pragma once
// The editable scene: a value. Copy it, compare it, save it, undo it.

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/box3.h"
#include "core/base/shared_value.h"
#include "core/fields/transfer_function.h"
#include "core/objects/term.h"
#include "core/scene/camera.h"
#include "core/stf/lattice.h"

namespace voledit {

// ---- Spatial transfer functions, as written in a file -------------------------------------------------------------

/// `translate`, `rotate` [degrees], `scale`, or a matrix (q to p) in their stead.
struct Placement {
    Vec3 translate{0};
    Vec3 rotate{0};  // degrees about x, y, z
    Vec3 scale{1};
    std::optional<Mat4> matrix;

    bool operator==(const Placement&) const = default;
};
/// p from q, for either form.
Mat4 worldFromRest(const Placement& placement);

struct AffineTransfer {
    Placement placement;
    bool operator==(const AffineTransfer&) const = default;
};

/// A lattice as edited: control points as displacements from rest, so that it does not depend on its frame. Both forms
/// of the file (`control`, `move`) are kept in this one.
struct FfdTransfer {
    LatticeBasis basis = LatticeBasis::Bezier;
    Index3 points{4, 4, 4};  // degree + 1 for Bézier
    Index3 cells{16, 16, 16};
    /// World position of moved control points, by index i + nx·(j + ny·k); the others are at rest. Points given by
    /// `by` hold a displacement, those given by `to` a position.
    struct Move {
        Vec3 vector{0};
        bool absolute = false;
        bool operator==(const Move&) const = default;
    };
    std::map<std::size_t, Move> moves;

    bool operator==(const FfdTransfer&) const = default;
};

struct TransferUse {
    std::string name;
    bool operator==(const TransferUse&) const = default;
};

struct Transfer {
    std::variant<AffineTransfer, FfdTransfer, TransferUse> kind;
    std::string name;
    std::optional<Frame> frame;  // nullopt: the box of the operand
    std::optional<Outside> outside;
    bool enabled = true;
    double amount = 1;

    bool operator==(const Transfer&) const = default;
};

// ---- Objects ------------------------------------------------------------------------------------------------------

struct Object;
using ObjectRef = SharedValue<Object>;

/// Either a preset's name, or tables; no member at all is the grey ramp.
struct Appearance {
    std::string preset;
    std::optional<ColorTable> color;
    std::optional<PiecewiseLinear> opacity;
    std::optional<PiecewiseLinear> gradientOpacity;

    bool operator==(const Appearance&) const = default;
};

struct ObjectUse {
    std::string name;
    bool operator==(const ObjectUse&) const = default;
};
struct VolumeObject {
    std::string asset;
    int channel = 0;
    Appearance appearance;
    bool operator==(const VolumeObject&) const = default;
};
struct PlaceObject {
    Placement placement;
    ObjectRef of;
    bool operator==(const PlaceObject&) const = default;
};
struct TransferObject {
    std::vector<SharedValue<Transfer>> by;  // applied in order, the first first
    ObjectRef of;
    Combine combine = Combine::Union;
    bool operator==(const TransferObject&) const = default;
};

struct Object {
    std::variant<ObjectUse, VolumeObject, PlaceObject, TransferObject> kind;
    bool operator==(const Object&) const = default;
};

// ---- The scene ----------------------------------------------------------------------------------------------------

enum class AssetKind : std::uint8_t { Volume, Motion, Images };

struct Asset {
    AssetKind kind = AssetKind::Volume;
    std::string path;  // as written in the file: relative to the scene file, or absolute when it lies outside
    bool operator==(const Asset&) const = default;
};

struct Timeline {
    double fps = 24;
    int start = 0;
    int end = 48;  // exclusive
    bool operator==(const Timeline&) const = default;
};

struct Scene {
    std::map<std::string, Asset> assets;
    std::map<std::string, ObjectRef> objects;
    std::map<std::string, SharedValue<Transfer>> transfers;
    ObjectRef root;
    std::optional<double> opacityDistance;
    std::optional<Camera> camera;  // nullopt: fits the root
    RenderSettings render;
    Timeline timeline;

    bool operator==(const Scene&) const = default;
};

}  // namespace voledit
