#pragma once
// Edits of the scene's tree: adding, removing, wrapping, moving and naming nodes (nodes.h says how they are addressed).

#include <optional>
#include <string>

#include "core/scene/nodes.h"
#include "core/stf/transfer_definition.h"

namespace voledit {

/// `wanted`, or it with a number behind, such that no transfer or displacement is called so.
std::string uniqueTransferName(const Scene& scene, const std::string& wanted);

/// Lets the object at `object` (the root, or any other) be transferred by `transfer`, which becomes entry `name` (made
/// unique) of `transfers`, with `frame` as its own where given. A transfer object gets it as the last of its list, any
/// other (a `use` too) is wrapped in one. Returns the name used. Throws Error if no object is there.
std::string addTransfer(Scene& scene, const NodePath& object, Transfer transfer, const std::string& name,
                        const std::optional<Frame>& frame);

/// Puts `outer` in the place of the object at `path`, which becomes its operand: `of`, or the first of `of` of a CVG
/// operator (in the place of `outer.of[0]`). Throws Error if no object is there or `outer` takes no operand.
void wrapObject(Scene& scene, const NodePath& path, Object outer);

/// Takes the node at `path` away. A place, recolor, transfer, displace, actor, scaled displacement or mapped field
/// becomes its operand. Anything else goes with all that is within it, and so does what cannot do without: a transfer
/// that lost its last STF becomes its operand, a sequence without any goes; an operator or list of displacements with
/// one operand left becomes that, `transferred` without `by` its `of`, displace without `by` its operand; a limb shows
/// the actor's object; an attribute goes, any other scalar field becomes 0; an entry by name goes with all its uses.
/// Throws Error, and changes nothing, where nothing stands there or the scene would show nothing.
void removeNode(Scene& scene, const NodePath& path);

/// Moves the STF at `path`, an element of a `by` list or of a sequence, to index `to` (clamped) of the same list.
/// Returns its path there. Throws Error if it is none.
NodePath moveTransferInList(Scene& scene, const NodePath& path, int to);

/// Gives an entry by name, and all that use it, another name. Throws Error if there is none, `to` is empty or taken.
void renameObject(Scene& scene, const std::string& from, const std::string& to);
void renameTransfer(Scene& scene, const std::string& from, const std::string& to);
void renameDisplacement(Scene& scene, const std::string& from, const std::string& to);

/// Sets argument `name` of the library STF (or formula file's) at `path`; its tracks go, unless `time` is given: then
/// the key at that time is set, where it has tracks. Throws Error if it is no such STF.
void setArgument(Scene& scene, const NodePath& path, const std::string& name, const LibraryTransfer::Argument& value,
                 std::optional<double> time = {});

/// A value as a scene writes it, and as definitions take it (tracks: their first keys).
LibraryTransfer::Argument sceneArgument(const TransferParameter& parameter, const TransferArgument& value);
TransferArgument definitionArgument(const LibraryTransfer::Argument& argument);

}  // namespace voledit
