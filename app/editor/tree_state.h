#pragma once
// What of the scene's tree is open, and which name is being typed.

#include <set>
#include <string>

namespace voledit {

/// A part of the workspace; not of the scene, hence not undone.
struct TreeState {
    std::set<std::string> closed;  // paths of rows whose children are not shown
    std::string renaming;          // path of the node whose name is being typed; "" for none
    std::string typed;             // that name so far
    bool beginTyping = false;      // the field takes the keyboard in the next frame
    std::string reveal;            // path of a row to bring into view in the next frame
};

}  // namespace voledit
