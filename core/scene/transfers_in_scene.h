#pragma once
// Walking and rewriting the objects and transfers of a scene. For the edits of this folder.

#include <functional>
#include <string>

#include "core/scene/scene.h"

namespace voledit {

/// Calls visit(object) on every object of the scene once, an outer one before what it is `of`: those that the root
/// reaches (through `use`) first, then the named ones that nothing uses.
void forEachObject(const Scene& scene, const std::function<void(const Object&)>& visit);

/// Replaces every object for which `change` gives another; an inner one before the outer one that holds it. Objects
/// that nothing changes in stay shared.
void rewriteObjects(Scene& scene, const std::function<std::optional<Object>(const Object&)>& change);

/// Calls visit(name, transfer) on every transfer of the scene once, the outermost first: of each list the last comes
/// first, `use` is followed, and transfers that nothing uses come at the end. `name` is the transfer's name in
/// `transfers`, or else its own (which may be empty).
void forEachTransfer(const Scene& scene, const std::function<void(const std::string&, const Transfer&)>& visit);

/// Changes the transfer `name` (its name in `transfers`, or the `name` of an inline one). Throws Error if there is
/// none.
void editTransfer(Scene& scene, const std::string& name, const std::function<void(Transfer&)>& change);

}  // namespace voledit
