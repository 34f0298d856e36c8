#pragma once
// Writes what happens in the editor as an event file that replays to the same state (scene-format.md §4).

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/input.h"

namespace voledit {

/// The window that a recording was made in; its first comment says it, so that a replay can take the same.
struct RecordedWindow {
    Index2 size{1280, 800};
    double scale = 1;
    bool operator==(const RecordedWindow&) const = default;
};

/// "# window 1280x800, scale 1".
std::string lineOf(const RecordedWindow& window);
/// From the comments of an event file's text; nullopt where none says it.
std::optional<RecordedWindow> recordedWindow(const std::string& text);

/// Writes lines as things happen; a crash loses nothing but the last frames. Real time becomes frames of 1/60 s, and a
/// rest longer than two seconds, in which nothing plays, becomes two seconds.
class Recorder {
public:
    /// Throws Error where the file cannot be written.
    Recorder(const std::filesystem::path& path, const RecordedWindow& window);
    ~Recorder();

    /// One frame has been drawn with `events`, `seconds` after the one before, in which the timeline played or not.
    void frame(const std::vector<InputEvent>& events, double seconds, bool played = false);
    /// A named action was run by an event file.
    void action(const std::string& id, const std::string& argument);
    /// Loading has ended: a replay must wait for its own.
    void loaded();

private:
    void writeFrames();

    std::ofstream file_;
    double frames_ = 0;  // drawn since the last line, not written yet; of them while the timeline played
    double played_ = 0;
};

}  // namespace voledit
