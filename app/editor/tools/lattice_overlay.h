#pragma once
// How a lattice is drawn over the picture.

#include <optional>
#include <vector>

#include "app/editor/tools/lattice_view.h"
#include "render/overlay.h"

namespace voledit {

struct LatticeLook {
    std::vector<std::size_t> selected, folded;  // control points, sorted
    std::optional<std::size_t> hovered;
    Camera camera{};   // what lies behind is drawn fainter
    double scale = 1;  // of the interface
};

/// Appends to `overlay`: the box at rest (where the lattice is deformed), the edges between neighbouring control points
/// (those of the outer box strongest, inner ones faintest), the control points: selected, hovered, folding, others.
void appendLattice(const LatticeView& view, const LatticeLook& look, Overlay& overlay);

}  // namespace voledit
