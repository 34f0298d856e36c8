#pragma once
// The scene as rows of a tree: what the scene panel shows and what arrow keys walk through.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace voledit {

/// One row. Paths are JSON pointers into the scene file, as the edits of core/scene take them.
struct SceneRow {
    enum class Kind : unsigned char { Object, Transfer, Displacement, Field };
    Kind kind = Kind::Object;
    std::string path;    // where it stands; of a `use`, the place of the use
    std::string target;  // where what it shows stands: `path`, but for a `use`
    std::string name;    // what the scene calls it; "" where it has no name
    std::string label;   // its name, else what it is; with the member it fills before it ("weight: …")
    std::string detail;  // what it is, or a little about it
    const char* icon = "";
    int depth = 0;
    bool parent = false;     // has rows below it
    bool open = false;       // and they are shown
    bool link = false;       // it is a `use`
    bool repeated = false;   // a `use` of what stands further up, where its rows are
    bool unused = false;     // nothing shown uses it
    std::optional<bool> on;  // `enabled`, of STFs
    std::string widget;      // the only one of that name: "twist", "twist 2"
};

/// The rows of the root, then the named objects, STFs and SD objects that nothing uses. Below the paths of `closed` no
/// rows are given, nor more than `kDeepestRow` levels deep. The things below a shared node come with its first use.
std::vector<SceneRow> sceneRows(const Scene& scene, const std::set<std::string>& closed);

inline constexpr int kDeepestRow = 100;

/// The row at `path`, or null.
const SceneRow* rowAt(const std::vector<SceneRow>& rows, const std::string& path);

/// What a node is in a few words: "Twist", "Lattice", "Sphere", "Union".
std::string titleOf(const Object& object);
std::string titleOf(const Transfer& transfer);
std::string titleOf(const Displacement& displacement);
std::string titleOf(const Field& field);

/// Its icon, of icons.h.
const char* iconOf(const Object& object);
const char* iconOf(const Transfer& transfer);

}  // namespace voledit
