#pragma once
// What a viewport tool may read and change.

#include "app/editor/actor_state.h"
#include "app/editor/selection.h"
#include "core/scene/compile.h"
#include "core/scene/document.h"

namespace voledit {

/// Made anew for each call. Tools change the scene through `document` alone (preview, commit, cancel).
struct ToolContext {
    Document& document;
    Selection& selection;
    Camera& camera;                           // of the viewport; not part of undo
    Index2 size{1, 1};                        // viewport, pixels
    const CompiledScene* compiled = nullptr;  // of document.scene() or a little older; null while nothing is loaded
    double scale = 1;                         // of the user interface: 2 on a display of twice the density
    const ActorState* actors = nullptr;       // modes and switches of actors; null: the defaults
    bool autoKey = false;                     // edits of joints become keys
};

}  // namespace voledit
