#pragma once
// What the editor keeps about actors beside the scene: modes, switches, what was copied, what was computed.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/rigging/rig.h"
#include "core/scene/scene_actors.h"

namespace voledit {

struct Term;

/// Which parts of an actor's object are opaque, and how far from its surface they lie: what rigging works on.
struct ActorBody {
    std::shared_ptr<const Term> of;  // the object it was taken from
    OpaqueVoxels voxels;             // the object's space
    std::vector<float> distance;     // of each voxel, world units (core/rigging/curve_skeleton.h)
};

/// Not part of the scene, hence not undone. Plain data.
struct ActorState {
    bool rigEdit = false;               // the rest pose is shown and edited, not the posed actor
    bool showRegions = false;           // outlines of all regions
    bool showCoverage = false;          // voxels in no region, or in several; while the rest pose is shown
    std::map<std::string, int> chains;  // how many bones IK turns, where the user said so; by joint
    bool showTable = false;             // the inspector opens the table of joints in the next frame
    std::optional<NamedPose> copied;    // by pose.copy
    std::string poseName;               // typed for pose.save

    // Computed in the background; null until then, and where nothing wants it.
    std::shared_ptr<const ActorBody> body;
    std::shared_ptr<const Coverage> coverage;
};

}  // namespace voledit
