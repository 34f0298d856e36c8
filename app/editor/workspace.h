#pragma once
// What the editor works on: everything that panels, tools and actions see and change.

#include <filesystem>
#include <string>
#include <vector>

#include "app/editor/actions.h"
#include "app/editor/actor_state.h"
#include "app/editor/formula_files.h"
#include "app/editor/selection.h"
#include "app/editor/timeline/timeline_state.h"
#include "app/editor/tree_state.h"
#include "core/scene/compile.h"
#include "core/scene/document.h"
#include "core/scene/when.h"

namespace voledit {

/// Something that the user is told.
struct Notice {
    enum class Kind : unsigned char { Info, Warning, Problem };
    Kind kind = Kind::Info;
    std::string text;
    double time = 0;  // editor time when it came, seconds

    bool operator==(const Notice&) const = default;
};

/// Milliseconds that a frame may be given.
constexpr double kLeastFrameBudget = 5, kMostFrameBudget = 1000;

enum class RendererChoice : unsigned char { Auto, Slices, Rays };

/// Plain data, owned by the editor; panels and tools take it by reference. What changed is found by comparing values.
struct Workspace {
    // What is edited.
    bool open = false;  // false until something was opened: document and assets are then empty
    Document document{Scene{}};
    LoadedAssets assets;
    FormulaFiles formulaFiles;
    std::filesystem::path folder;  // asset paths of the document are relative to it
    Selection selection;
    ActorState actors;

    // What is looked at. The camera is the editor's own: navigating is no undo step; saving writes it into the scene.
    Camera camera;
    double time = 0;  // seconds on the scene's clock
    TimelineState timeline;
    CompiledScene compiled;  // of document.scene() with `camera`, from the frame before; root is null where not open
    Index2 viewOrigin{0}, viewSize{1, 1};  // the viewport in window pixels
    bool overlays = true;
    RendererChoice renderer = RendererChoice::Auto;
    double frameBudgetMs = 30;  // that a frame may take while something moves
    std::string problem;        // why the scene as it is cannot be compiled; "" where it can

    /// What an inspector previews, for when its widget goes away before it can end the edit (another node is selected
    /// while a formula is typed): the step's name, and whether what is typed now is wrong.
    struct Pending {
        std::string step;
        bool wrong = false;
    } pending;

    // The interface.
    float scale = 1;   // pixels for each pixel of the design
    double clock = 0;  // editor time, seconds
    TreeState tree;
    bool addMenuWanted = false;  // the menu of Shift+A opens in the next frame
    bool headless = false;       // pictures must not depend on the clock
    std::vector<Notice> notices;
    Actions actions;

    /// How an edit of a value holds: one that has keys, and with auto-key any, gets a key at the time that is shown.
    When when() const { return {time, timeline.autoKey}; }
    void notify(Notice::Kind kind, const std::string& text) { notices.push_back({kind, text, clock}); }
};

}  // namespace voledit
