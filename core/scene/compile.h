#pragma once
// From the editable scene to immutable evaluators.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/objects/term.h"
#include "core/scene/nodes.h"
#include "core/scene/scene.h"
#include "core/skeleton/limb_regions.h"
#include "core/skeleton/motion.h"
#include "core/stf/mesh_field.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

/// The volumes of a scene by asset name.
using LoadedVolumes = std::map<std::string, std::shared_ptr<const Volume>>;

/// What a scene's files hold, read already.
struct LoadedAssets {
    LoadedVolumes volumes;                                         // by asset name
    std::map<std::string, std::shared_ptr<const Mesh>> meshes;     // assets of kind volume whose file is a mesh
    std::map<std::string, TransferDefinitionPtr> transfers;        // formula files, by path as the scene writes it
    std::map<std::string, std::shared_ptr<const Motion>> motions;  // by asset name

    LoadedAssets(LoadedVolumes v = {}) : volumes(std::move(v)) {}  // NOLINT: implicit, most scenes have no others
};

/// An actor as it stands at the compiled time: what overlays and tools show and pick. "Object" is the space of the
/// actor's `of`.
struct CompiledActor {
    NodePath path;                        // of the ActorObject
    std::string name;                     // the actor's; may be empty
    Skeleton skeleton;                    // with its limits, skeleton space
    Mat4 objectFromSkeleton{1.0};         // fit
    Pose motionPose;                      // of the motion alone (rest without one)
    Pose pose;                            // with the joints' own rotations: what is shown
    std::vector<PosedJoint> rest, posed;  // of the joints, in the object's space
    std::vector<Limb> limbs;              // fitted where sizes were left out
    RegionOptions options;
    std::shared_ptr<const LimbRegions> regions;
    std::shared_ptr<const Term> of;  // what the actor moves
    Mat4 worldFromObject{1.0};       // of the places around the actor; of other transfers around it nothing is taken
};

/// All that a renderer needs. Copies share.
struct CompiledScene {
    TermPtr root;
    Camera camera;
    RenderSettings render;
    double opacityDistance = 1;         // world units
    double unitStep = 1;                // world length of `render.step` 1: the smallest spacing of the scene's volumes
    double time = 0;                    // seconds
    std::vector<std::string> warnings;  // what is allowed but odd, with its place (a deflection that folds)
    std::vector<std::shared_ptr<const CompiledActor>> actors;  // in the order of the tree

    /// Compiled pieces with the values they were made from; the next `compile` takes what is equal.
    struct Cache;
    std::shared_ptr<const Cache> cache;

    /// World length of one step along a ray.
    double stepLength() const { return unitStep * render.step; }
};

/// Compiles `scene` at time t (seconds); pieces whose inputs are equal to those of `previous` (may be null) are taken
/// from it, the very objects, so that caches keyed by them hold. `aspect` (width/height) serves a camera that fits.
/// Throws Error for a missing volume, a channel out of range, a bad number.
CompiledScene compile(const Scene& scene, const LoadedAssets& assets, double t, const CompiledScene* previous,
                      double aspect = 4.0 / 3.0);

/// The frames that transfers without one of their own have taken, by the paths of the transfers (core/scene/nodes.h).
const std::map<std::string, Frame>& defaultFrames(const CompiledScene& scene);

/// A copy of `scene` with all that the contract says saving writes out: frames left out, camera, opacityDistance.
Scene withDefaultsWrittenOut(const Scene& scene, const LoadedAssets& assets);

/// The lattice that an `ffd` transfer means, over the frame it has (its own, or `operand`'s box).
Lattice latticeOf(const FfdTransfer& ffd, const Frame& frame);

}  // namespace voledit
