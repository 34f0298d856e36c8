#pragma once
// Walking all nodes of a scene.

#include <functional>
#include <string>

#include "core/scene/nodes.h"

namespace voledit {

using NodePointer = std::variant<const Object*, const Transfer*, const Displacement*, const Field*>;

/// Calls visit(path, node) on every node of the scene once, the outermost first: of lists of STFs the last comes first,
/// then what they are applied to. Those that the root reaches come first (`use` is followed, where it is met first),
/// then the named ones that nothing reaches: objects, transfers, displacements.
void forEachNode(const Scene& scene, const std::function<void(const NodePath&, const NodePointer&)>& visit);

/// The objects of forEachNode.
void forEachObject(const Scene& scene, const std::function<void(const Object&)>& visit);

/// The STFs of forEachNode, those within others too. `name` is the STF's name in `transfers`, or else its own (which
/// may be empty).
void forEachTransfer(const Scene& scene, const std::function<void(const std::string&, const Transfer&)>& visit);

/// Where STF `name` stands: the entry of `transfers`, or the entry or (the outermost) inline one with that `name`. ""
/// where there is none, or `name` is empty.
NodePath pathOfTransfer(const Scene& scene, const std::string& name);

/// Changes the STF `name`. Throws Error if there is none.
void editTransfer(Scene& scene, const std::string& name, const std::function<void(Transfer&)>& change);

}  // namespace voledit
