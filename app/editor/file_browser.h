#pragma once
// The editor's own file dialog.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/folder_listing.h"

struct ImGuiInputTextCallbackData;

namespace voledit {

/// A modal dialog with a path field, places, and the list of a folder. Its widgets are "TITLE/Path", "TITLE/NAME" for a
/// row, "TITLE/Up", "TITLE/All files", "TITLE/Cancel" and the button that does it ("Open/Open").
class FileBrowser {
public:
    enum class Mode : unsigned char { Open, Save };

    struct Request {
        Mode mode = Mode::Open;
        std::string title;   // "Open", "Save as"
        std::string button;  // "Open", "Save"
        std::filesystem::path folder;
        std::string name;                       // proposed, when saving
        FileKinds kinds = FileKinds::Openable;  // shown at first
        std::string ending;                     // added when saving under a name without one: ".voledit"
    };

    void show(Request request);
    bool visible() const { return visible_; }

    /// Draws it within the current frame, `scale` pixels a design pixel. The path, in the frame in which the user chose
    /// one (when saving over a file that exists, after having asked).
    std::optional<std::filesystem::path> draw(float scale);

    /// Where the user last was; the next dialog starts there.
    const std::filesystem::path& folder() const { return request_.folder; }

private:
    void goTo(const std::filesystem::path& folder);
    void setText(const std::string& text);
    void mark(int row);
    int onTextEvent(ImGuiInputTextCallbackData& data);
    bool drawPath();
    void drawPlaces();
    bool drawList();
    bool drawButtons(float scale);
    std::optional<std::filesystem::path> accept();
    std::optional<std::filesystem::path> drawOverwrite();

    Request request_;
    bool visible_ = false;
    bool opening_ = false;      // ImGui does not know of it yet
    bool focusPath_ = false;    // the path field takes the keyboard
    bool replaceText_ = false;  // text_ was changed behind the active field
    std::string text_;          // of the path field
    std::string problem_;
    std::vector<BrowserEntry> entries_;
    int marked_ = -1;  // row
    bool scrollToMark_ = false;
    bool wholeFolder_ = false;  // accept the folder itself
    FileKinds shown() const { return allFiles_ ? FileKinds::All : request_.kinds; }
    bool allFiles_ = false;
    std::optional<std::filesystem::path> overwrite_;  // exists: asked about
};

}  // namespace voledit
