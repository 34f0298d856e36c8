#pragma once
// Addressing any node of a scene: objects, STFs, SD objects, scalar fields.

#include <functional>
#include <string>

#include "core/scene/scene.h"

namespace voledit {

/// Where a node stands: the JSON pointer (RFC 6901) of its place in the saved scene, in which `by` of a transfer is
/// always a list: "/root/of/by/0", "/objects/skull", "/transfers/pull/of/1". It stays right as long as nothing is put
/// in or taken out above it or before it in its list.
using NodePath = std::string;

struct ChildStep;  // scene_children.h

inline const NodePath kRootPath = "/root";
NodePath objectPath(const std::string& name);        // of an entry of `objects`
NodePath transferPath(const std::string& name);      // of an entry of `transfers`
NodePath displacementPath(const std::string& name);  // of an entry of `displacements`

/// The node within the one at `path`.
NodePath childPath(const NodePath& path, const ChildStep& step);
/// `name` as a token of a JSON pointer: ~ and / escaped.
std::string pointerToken(const std::string& name);
/// The node around the one at `path`; "" for the root and entries by name.
NodePath parentOf(const Scene& scene, const NodePath& path);

/// The node at `path`, `use` not followed; null where none of that type stands there.
const Object* findObjectAt(const Scene& scene, const NodePath& path);
const Transfer* findTransferAt(const Scene& scene, const NodePath& path);
const Displacement* findDisplacementAt(const Scene& scene, const NodePath& path);
const Field* findFieldAt(const Scene& scene, const NodePath& path);

/// `path`, or where what it names stands, if it is a `use` (followed to the end). "" where nothing stands there or a
/// name leads nowhere.
NodePath followedUse(const Scene& scene, const NodePath& path);

/// Changes the node at `path`, `use` not followed; what does not lead to it stays shared. Throws Error if none of that
/// type stands there.
void editObjectAt(Scene& scene, const NodePath& path, const std::function<void(Object&)>& change);
void editTransferAt(Scene& scene, const NodePath& path, const std::function<void(Transfer&)>& change);
void editDisplacementAt(Scene& scene, const NodePath& path, const std::function<void(Displacement&)>& change);
void editFieldAt(Scene& scene, const NodePath& path, const std::function<void(Field&)>& change);

}  // namespace voledit
