#pragma once
// The rows of each kind of node. Each takes a copy, changes it by what the rows do, and notes the edits; the inspector
// panel writes the copy back.

#include "app/editor/panels/inspection.h"
#include "core/scene/scene.h"

namespace voledit {

/// An STF: what it is, its parameters, amount, what lies outside, its frame.
void inspectTransfer(Inspection& inspection, Transfer& transfer);
/// The parameters of an STF of the library or of a user's file, by its definition.
void inspectLibraryTransfer(Inspection& inspection, LibraryTransfer& transfer);

void inspectObject(Inspection& inspection, Object& object);
void inspectActor(Inspection& inspection, ActorObject& actor);
void inspectSolid(Inspection& inspection, SolidObject& solid);

void inspectDisplacement(Inspection& inspection, Displacement& displacement);

void inspectField(Inspection& inspection, Field& field);

/// The definition of a library STF or of a user's file; null where there is none of that name, or it was not read.
TransferDefinitionPtr definitionOf(const LibraryTransfer& transfer, const LoadedAssets& assets);

}  // namespace voledit
