#pragma once
// Moving or copying selected keys in time by the pointer.

#include <string>
#include <vector>

#include "app/editor/timeline/playback.h"
#include "core/scene/document.h"
#include "core/scene/keys.h"

namespace voledit {

/// Previews on the document while the pointer goes; one undo step at the end. The key that was taken (the anchor) lands
/// on whole frames, and the others keep their distance to it. A value; knows no pixels.
class KeyMove {
public:
    /// `keys` as they stand in the committed scene; `anchor` is the time of one of them, `frame` where the pointer is.
    KeyMove(std::vector<KeyRef> keys, double anchor, double frame, bool copy)
        : keys_(std::move(keys)), anchor_(anchor), from_(frame), copy_(copy) {}

    /// The pointer is at `frame`; `free`: not only to whole frames. Returns where the keys are now.
    std::vector<KeyRef> follow(Document& document, double frame, bool free);
    /// Makes it a step. Without a move nothing happens.
    void finish(Document& document) const;
    /// Restores; returns where the keys were.
    std::vector<KeyRef> cancel(Document& document) const;

    /// How far they have gone, seconds.
    double delta() const { return delta_; }
    bool copies() const { return copy_; }

private:
    std::vector<KeyRef> keys_;
    double anchor_, from_;
    bool copy_;
    double delta_ = 0;
};

/// "Move key", "Copy 3 keys".
std::string keyStep(const std::string& verb, std::size_t count);

}  // namespace voledit
