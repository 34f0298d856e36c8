#pragma once
// The named actions that add to a scene, and what there is to add.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/workspace.h"

namespace voledit {

/// Adds add.menu, transfer.add, transfer.add-file, solid.add, object.combine, object.wrap. They work on the selected
/// object, or the one around the selected STF; by default on the root. `workspace` outlives `actions`. `chooseFile`
/// asks the user for a formula file, where transfer.add-file is given none.
void addAddActions(Actions& actions, Workspace& workspace, const std::function<void()>& chooseFile);

/// What the STF at `path` gets as its frame where it is left out (scene-format.md §1, STFs); nullopt where the scene as
/// it is gives none.
std::optional<TrackedFrame> fittedFrame(const Workspace& workspace, const Scene& scene, const std::string& path);

/// An entry of the Add menu.
struct AddChoice {
    const char* name;  // argument of its action
    const char* title;
    const char* icon;
    const char* help;
};
const std::vector<AddChoice>& solidChoices();    // of solid.add
const std::vector<AddChoice>& combineChoices();  // of object.combine
const std::vector<AddChoice>& wrapChoices();     // of object.wrap

/// A solid of the shape `name` within `box`: as wide as half of it, at its centre. Throws Error for an unknown name.
SolidObject solidNamed(const std::string& name, const Box3& box);

}  // namespace voledit
