#pragma once
// The STFs and SD objects of a scene, as written in a file (scene-format.md §1, STFs).

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/scene_actors.h"
#include "core/scene/scene_fields.h"
#include "core/stf/lattice.h"

namespace voledit {

// ---- STFs ---------------------------------------------------------------------------------------------------------

struct AffineTransfer {
    Placement placement;
    bool operator==(const AffineTransfer&) const = default;
};

/// A lattice as edited: control points as displacements from rest, so that it does not depend on its frame. Both forms
/// of the file (`control`, `move`) are kept in this one; a track of the whole `control` becomes one of every point.
struct FfdTransfer {
    LatticeBasis basis = LatticeBasis::Bezier;
    Index3 points{4, 4, 4};  // degree + 1 for Bézier
    Index3 cells{16, 16, 16};
    /// World position of moved control points, by index i + nx·(j + ny·k); the others are at rest. Points given by
    /// `by` hold a displacement, those given by `to` a position.
    struct Move {
        Tracked<Vec3> vector{Vec3(0)};
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

/// An STF of resources/transfers (by its name) or of a user's formula file ({ "file": PATH }).
struct LibraryTransfer {
    std::string definition;  // a name; or a file's path as the scene writes it
    bool isFile = false;

    struct Line {
        Tracked<Vec3> point{Vec3(0)}, direction{Vec3(0, 0, 1)};
        bool operator==(const Line&) const = default;
    };
    /// One axis ("x") or a list of them (["x"]), as 0, 1, 2.
    struct Axes {
        std::vector<int> axes;
        bool list = false;
        bool operator==(const Axes&) const = default;
    };
    /// One number or several (a list of one is never written), a line, or axes.
    using Argument = std::variant<Tracked<std::vector<double>>, Line, Axes>;
    std::map<std::string, Argument> arguments;  // by member name

    bool operator==(const LibraryTransfer&) const = default;
};

/// Formulas over x, y, z, t and the lets before.
struct ExpressionTransfer {
    std::string x, y, z;
    std::string undefined;                                 // a condition; "" for none
    std::vector<std::pair<std::string, std::string>> let;  // name, formula
    bool world = false;                                    // else in normalised coordinates of the frame
    std::optional<TrackedFrame> image;                     // that the image lies in; else the operand's box

    bool operator==(const ExpressionTransfer&) const = default;
};

/// Three scalar fields in world units, or a volume of three components.
struct FieldsTransfer {
    std::array<FieldRef, 3> fields;  // where `asset` is ""
    std::string asset;
    bool displacement = false;
    bool operator==(const FieldsTransfer&) const = default;
};

struct SequenceTransfer {
    std::vector<TransferRef> of;  // applied in order, the first first; at least one
    bool operator==(const SequenceTransfer&) const = default;
};

/// The ST object `of` moved by another.
struct TransferredTransfer {
    TransferRef by, of;
    bool operator==(const TransferredTransfer&) const = default;
};

/// Any forward map from outside.
struct MappedTransfer {
    Tracked<std::vector<Vec3>> points;                // deformed positions, world units
    Tracked<std::vector<Vec3>> source;                // source coordinates, as many
    std::vector<std::array<std::uint32_t, 8>> cells;  // vertices i + 2j + 4k
    bool operator==(const MappedTransfer&) const = default;
};

struct Transfer {
    std::variant<AffineTransfer, FfdTransfer, TransferUse, LibraryTransfer, ExpressionTransfer, FieldsTransfer,
                 SequenceTransfer, TransferredTransfer, MappedTransfer, SkeletonTransfer>
        kind;
    std::string name;
    std::optional<TrackedFrame> frame;  // nullopt: the box of the operand
    std::optional<Outside> outside;
    bool enabled = true;
    Tracked<double> amount = 1;

    bool operator==(const Transfer&) const = default;
};

// ---- SD objects (definitions.md §3.1) -----------------------------------------------------------------------------

/// `of`: Δ(p) = Ψ(p) − p.
struct OfDisplacement {
    TransferRef transfer;
    bool operator==(const OfDisplacement&) const = default;
};
/// `scale`: k(p)·Δ(p).
struct ScaleDisplacement {
    FieldRef by;
    DisplacementRef of;
    bool operator==(const ScaleDisplacement&) const = default;
};
/// `sum`, `union` (the larger |Δ|), `intersection` (the smaller).
struct CombinedDisplacement {
    enum class Kind : std::uint8_t { Sum, Union, Intersection };
    Kind kind = Kind::Sum;
    std::vector<DisplacementRef> of;  // at least one
    bool operator==(const CombinedDisplacement&) const = default;
};
/// `blend`: (1−w)Δ₁ + wΔ₂.
struct BlendDisplacement {
    FieldRef weight;
    DisplacementRef first, second;
    bool operator==(const BlendDisplacement&) const = default;
};
/// `fields`: Δ by its components, world units.
struct FieldsDisplacement {
    std::array<FieldRef, 3> fields;
    bool operator==(const FieldsDisplacement&) const = default;
};
struct DisplacementUse {
    std::string name;
    bool operator==(const DisplacementUse&) const = default;
};

struct Displacement {
    std::variant<DisplacementUse, OfDisplacement, ScaleDisplacement, CombinedDisplacement, BlendDisplacement,
                 FieldsDisplacement>
        kind;
    bool operator==(const Displacement&) const = default;
};

}  // namespace voledit
