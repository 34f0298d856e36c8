#pragma once
// Trees of nodes with keys, as glTF, FBX and Collada have them, made into motions.

#include <string>
#include <utility>
#include <vector>

#include "core/skeleton/motion.h"

namespace voledit {

/// Keys of one node, seconds ascending; a kind without keys keeps what the node has.
struct NodeKeys {
    std::vector<std::pair<double, Vec3>> translate, scale;
    std::vector<std::pair<double, Quat>> rotate;
    bool empty() const { return translate.empty() && scale.empty() && rotate.empty(); }
};

/// A node; parents stand before their children.
struct ClipNode {
    std::string name;
    int parent = Joint::kNoParent;
    Mat4 local{1.0};  // parent's space from the node's own
    bool isBone = false, hasMesh = false;
    NodeKeys keys;
};

/// A motion, and what was repaired or left out on the way.
struct StoredMotion {
    Motion motion;
    std::string format;  // "gltf", "fbx", "dae"
    std::vector<std::string> warnings;
};

/// The skeleton of bones and animated nodes (with what is between them and below without a mesh), its rest as the nodes
/// stand, and their clip sampled at its keys' own rate (where they lie on no grid, 30 to 120 a second).
///
/// Joints' rest axes are the world's, so what turns them are rotations from rest: global(t)·global(rest)⁻¹; scales and
/// displacements become position channels, where there are any. Names become UTF-8, each once.
/// Throws Error that names `where`: no bones and no keys, numbers that are not finite, more joints, depth or frames
/// than a motion may have.
Motion motionOfNodes(const std::string& where, const std::vector<ClipNode>& nodes, std::vector<std::string>& warnings);

}  // namespace voledit
