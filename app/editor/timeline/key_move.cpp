#include "app/editor/timeline/key_move.h"

#include <cmath>

namespace voledit {

std::string keyStep(const std::string& verb, std::size_t count) {
    return verb + (count == 1 ? " key" : " " + std::to_string(count) + " keys");
}

std::vector<KeyRef> KeyMove::follow(Document& document, double frame, bool free) {
    const Timeline& timeline = document.committed().timeline;
    const double to = anchor_ * timeline.fps + frame - from_;
    // A pointer that has not left its frame moves nothing, wherever between frames the keys stand.
    const bool still = !free && std::round(frame - from_) == 0;
    delta_ = still ? 0 : timeOfFrame(free ? to : std::round(to), timeline) - anchor_;
    std::vector<KeyRef> moved = keys_;
    if (delta_ == 0)
        document.cancel();
    else
        document.preview([&](Scene& scene) { moved = moveKeys(scene, keys_, delta_, copy_); });
    return moved;
}

void KeyMove::finish(Document& document) const {
    if (delta_ == 0)
        document.cancel();
    else
        document.commit(keyStep(copy_ ? "Copy" : "Move", keys_.size()));
}

std::vector<KeyRef> KeyMove::cancel(Document& document) const {
    document.cancel();
    return keys_;
}

}  // namespace voledit
