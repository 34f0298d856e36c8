#pragma once
// What people call nodes and their values.

#include <string>

#include "core/scene/nodes.h"

namespace voledit {

struct ValueName;  // scene_children.h

/// The name of the node at `path`: as an entry, its own, else its type ("place"); "" where none stands there.
std::string nodeLabel(const Scene& scene, const NodePath& path);

/// "bend · angle", "actor · LeftArm rotate", "camera · eye"; `node` is "" for settings.
std::string valueLabel(const Scene& scene, const NodePath& node, const ValueName& name);

}  // namespace voledit
