#pragma once
// What is selected.

#include <cstddef>
#include <string>
#include <vector>

namespace voledit {

/// A node of the scene; where it is a lattice, control points of it; where it is an actor, joints of it. A value; not
/// part of the scene, hence not undone. Setting a lattice by name alone selects its node, setting a node alone its
/// lattice: see `settled`.
struct Selection {
    std::string lattice;                // name of the transfer; empty: none
    std::vector<std::size_t> points;    // indices of control points, sorted, each once, i fastest
    std::string node{};                 // path of the node in the scene (scene_tree.h); empty: none
    std::vector<std::string> joints{};  // of the actor at `node`, in the order of selecting, each once

    bool operator==(const Selection&) const = default;
    bool empty() const { return lattice.empty() && points.empty() && node.empty() && joints.empty(); }
    /// With nothing selected the outermost lattice is shown; with another node selected none is.
    bool showsLattice() const { return node.empty() || !lattice.empty(); }
};

}  // namespace voledit
