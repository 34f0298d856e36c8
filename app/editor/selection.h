#pragma once
// What is selected.

#include <cstddef>
#include <string>
#include <vector>

namespace voledit {

/// A lattice and control points of it. A value; not part of the scene, hence not undone.
struct Selection {
    std::string lattice;              // name of the transfer; empty: none, then the outermost lattice is shown
    std::vector<std::size_t> points;  // indices of control points, sorted, each once, i fastest

    bool operator==(const Selection&) const = default;
    bool empty() const { return lattice.empty() && points.empty(); }
};

}  // namespace voledit
