#pragma once
// Compiling one scene without tracks. For compile.cpp; the parts stand in compile_*.cpp, one for each kind of node.

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/scene/compile.h"
#include "core/scene/compiled_pieces.h"
#include "core/scene/nodes.h"

namespace voledit {

/// Frames that transfers without one take, by the transfer's path.
using DefaultFrames = std::map<NodePath, Frame>;

/// Limbs of actors and `skeleton` STFs that leave sizes out, by the node's path, as fitted at the timeline's start.
using FittedLimbs = std::map<NodePath, std::vector<Limb>>;

/// A map, and what is odd about it.
struct WarnedMap {
    TransferPtr map;
    std::string warning;  // may be empty
};

/// Compiles objects, STFs, SD objects and fields of one scene, taking pieces of equal inputs from the compilation
/// before. Frames that are left out are the box of the operand, or what `frames` says.
class Compiler {
public:
    struct Inputs {
        const Scene& scene;  // without tracks
        const LoadedAssets& assets;
        double time = 0;                   // seconds
        const Pieces* previous = nullptr;  // may be null
        DefaultFrames frames = {};         // known from the timeline's start
        FittedLimbs fitted = {};           // as well
    };
    explicit Compiler(Inputs inputs) : in_(std::move(inputs)), made_(std::make_shared<Pieces>()) {}

    /// Throws Error with the JSON pointer of the node that is wrong.
    TermPtr root();

    /// What `root` found: frames that were left out, pieces for the next compilation, warnings with their places.
    const DefaultFrames& frames() const { return in_.frames; }
    const FittedLimbs& fitted() const { return in_.fitted; }
    /// The innermost first.
    const std::vector<std::shared_ptr<const CompiledActor>>& actors() const { return actors_; }
    std::shared_ptr<const Pieces> pieces() const { return made_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Whether any of its formulas reads `t`, or a motion moves anything.
    bool readsTime() const { return readsTime_; }

private:
    using Maps = std::vector<TransferPtr>;

    // compile_objects.cpp
    TermPtr object(const Object& object);
    TermPtr compiled(const ObjectUse& use);
    TermPtr compiled(const VolumeObject& object);
    TermPtr compiled(const SolidObject& object);
    TermPtr compiled(const FieldsObject& object);
    TermPtr compiled(const CvgObject& object);
    TermPtr compiled(const RecolorObject& object);
    TermPtr compiled(const PlaceObject& object);
    TermPtr compiled(const TransferObject& object);
    TermPtr compiled(const DisplaceObject& object);
    TermPtr compiled(const ActorObject& object);  // compile_actors.cpp
    /// What make() gives, while STFs are applied to `operand`.
    template <class Make>
    auto mapsFor(const TermPtr& operand, const Make& make) {
        const TermPtr around = std::exchange(operand_, operand);
        auto result = make();
        operand_ = around;
        return result;
    }
    struct Application {
        Combine combine = Combine::Union;
        std::string name;
        TransferRole role = TransferRole::Outermost;
    };
    TermPtr transferred(const TransferPtr& by, const TermPtr& of, const Application& how);

    // compile_transfers.cpp: `box` is that of the operand, null for the component of a bare STF.
    Maps maps(const Transfer& transfer, const Box3* box);
    TransferPtr map(const Transfer& transfer, const Box3* box);
    Maps mapsOfMembers(const Transfer& transfer, const Box3* box);
    TransferPtr basicMap(const Transfer& transfer, const Box3* box);
    TransferPtr made(const AffineTransfer& affine, const Transfer& transfer, const Box3* box);
    TransferPtr made(const FfdTransfer& ffd, const Transfer& transfer, const Box3* box);
    TransferPtr made(const LibraryTransfer& library, const Transfer& transfer, const Box3* box);
    TransferPtr made(const ExpressionTransfer& expression, const Transfer& transfer, const Box3* box);
    TransferPtr made(const FieldsTransfer& fields, const Transfer& transfer, const Box3* box);
    TransferPtr made(const MappedTransfer& mapped, const Transfer& transfer, const Box3* box);
    TransferPtr made(const SkeletonTransfer& skeleton, const Transfer& transfer, const Box3* box);
    TransferDefinitionPtr definitionOf(const LibraryTransfer& library) const;
    Frame frameOfTransfer(const Transfer& transfer, const Box3* box);
    TransferPtr identity();
    TransferPtr scaled(const TransferPtr& map, double amount);
    TransferPtr sequence(const Maps& maps);

    // compile_actors.cpp
    CompiledActor posedRig(const ActorRig& rig, const std::vector<SceneLimb>& limbs, Skeleton skeleton);
    void fitLimbs(CompiledActor& actor, const std::vector<SceneLimb>& written, const std::vector<TermPtr>& of);
    std::shared_ptr<const std::vector<Limb>> fittedTo(const TermPtr& of, const CompiledActor& actor,
                                                      const std::vector<bool>& fit);
    std::shared_ptr<const LimbRegions> regionsOf(const CompiledActor& actor);
    TransferPtr mapOf(const std::shared_ptr<const LimbRegions>& regions, const std::vector<int>& limbs,
                      Outside outside);

    // compile_displacements.cpp
    TransferPtr displacement(const Displacement& displacement, const Box3* box);
    TransferPtr made(const DisplacementUse& use, const Box3* box);
    TransferPtr made(const OfDisplacement& of, const Box3* box);
    TransferPtr made(const ScaleDisplacement& scale, const Box3* box);
    TransferPtr made(const CombinedDisplacement& combined, const Box3* box);
    TransferPtr made(const BlendDisplacement& blend, const Box3* box);
    TransferPtr made(const FieldsDisplacement& fields, const Box3* box);

    // compile_fields.cpp
    FieldPtr field(const Field& field);
    FieldPtr made(const NumberField& number);
    FieldPtr made(const FormulaField& formula);
    FieldPtr made(const ComponentOf& component);
    FieldPtr made(const AttributeOf& attribute);
    FieldPtr made(const AssetField& asset);
    FieldPtr made(const MappedField& mapped);
    std::array<FieldPtr, 3> xyzFields(const std::array<FieldRef, 3>& fields);
    FieldPtr constant(double value);
    FieldPtr assetChannel(const std::string& asset, int channel);
    /// Components of an asset's values; throws Error where there is neither a volume nor a mesh of that name.
    int channelsOf(const std::string& asset) const;

    /// `previous` or this compilation's piece of this key, else what make() gives.
    template <class T, class Make>
    std::shared_ptr<const T> piece(const PieceKey& key, const Make& make);
    /// Counts the nodes that one point of `piece` may visit; throws Error where they are too many.
    void count(const void* piece, const PieceKey& key);

    /// The time, for a formula that reads it; 0 for others, so that they are made once.
    double timeFor(bool readsTime) {
        readsTime_ = readsTime_ || readsTime;
        return readsTime ? in_.time : 0;
    }

    /// Where the walk is, while it lives.
    class At {
    public:
        At(Compiler& compiler, NodePath path);
        At(Compiler& compiler, const char* member) : At(compiler, compiler.at_ + "/" + member) {}
        At(Compiler& compiler, const char* member, std::size_t index);
        ~At();
        At(const At&) = delete;
        At& operator=(const At&) = delete;

    private:
        Compiler& compiler_;
        NodePath before_;
        int exceptions_;
    };

    Inputs in_;
    std::shared_ptr<Pieces> made_;
    NodePath at_, failedAt_;
    std::map<std::string, TermPtr> objects_;           // null while being compiled
    std::set<std::string> transfers_, displacements_;  // names being compiled
    std::unordered_map<const void*, std::size_t> nodes_;
    std::vector<std::string> warnings_;
    std::vector<std::shared_ptr<const CompiledActor>> actors_;
    TermPtr operand_;          // of the STFs that are being made; null for those that have none
    Mat4 worldFromHere_{1.0};  // by the places around
    bool readsTime_ = false;
};

template <class T, class Make>
std::shared_ptr<const T> Compiler::piece(const PieceKey& key, const Make& make) {
    auto found = made_->find<T>(key);
    if (found) return found;
    if (in_.previous) found = in_.previous->find<T>(key);
    if (!found) found = make();
    made_->insert<T>(key, found);
    count(found.get(), key);
    return found;
}

/// Whether a formula reads `t`.
bool formulaReadsTime(const std::string& formula);

/// Writes `frames` into the transfers of `scene` that they belong to.
void writeFrames(Scene& scene, const DefaultFrames& frames);

}  // namespace voledit
