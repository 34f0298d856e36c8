#pragma once
// How the selected node is drawn over the picture: the frame of an STF, its lines and centres.

#include <string>

#include "core/scene/scene.h"
#include "render/overlay.h"

namespace voledit {

/// Appends the frame of the STF at `path`, lines through what turns about a line, and a cross with a ring of its radius
/// at a centre, as they are at `time` seconds, where the STF acts: maps outside it are left out. Nothing for other
/// nodes, for lattices (lattice_overlay.h) and where nothing stands at `path`. `scale`: pixels a design pixel.
void appendNode(const Scene& scene, const std::string& path, double time, double scale, Overlay& overlay);

}  // namespace voledit
