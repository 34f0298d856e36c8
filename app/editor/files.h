#pragma once
// Opening, saving, screenshots and leaving: the editor's requests to the user and to the file system.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/file_browser.h"
#include "app/editor/layout.h"
#include "app/editor/loader.h"
#include "app/editor/workspace.h"

namespace voledit {

/// Serves file requests over several frames: asks before unsaved changes are dropped, shows the file dialog, loads in
/// the background. Nothing of the workspace changes until a file has been read and compiled.
class Files {
public:
    /// All outlive it.
    Files(Workspace& workspace, IoClient& io, const OpenOptions& options);

    /// Opens a scene or volume; asks for one where `path` is empty, and first about unsaved changes.
    void open(const std::filesystem::path& path);
    /// Saves where it was opened from or last saved to, else asks. Throws Error.
    void save();
    /// Saves as a scene file; asks where `path` is empty. Throws Error.
    void saveAs(const std::filesystem::path& path);
    /// Asks for a formula file and adds it: transfer.add-file.
    void chooseFormulaFile();
    /// Asks for a motion file and lets it drive the actor: actor.import-motion.
    void chooseMotion();
    /// Wants a picture of the whole window in a PNG; asks where `path` is empty.
    void screenshot(const std::filesystem::path& path);
    /// Leaves, after having asked about unsaved changes.
    void quit();

    bool loading() const { return loader_.running(); }
    void cancelLoading() { loader_.cancel(); }
    /// Blocks until what is loading is ready for poll().
    void waitForLoading() { loader_.wait(); }
    /// Takes over what was loaded; once a frame. True where loading ended in this call. Problems become notices.
    bool poll();
    /// Why the last load failed; empty where it did not.
    const std::string& loadProblem() const { return loadProblem_; }

    /// Draws dialogs and, in `area`, the progress of loading within the current frame.
    void draw(const PixelRect& area);
    bool quitConfirmed() const { return quit_; }
    /// The screenshots wanted since the last call.
    std::vector<std::filesystem::path> takeScreenshots();

private:
    enum class Asking : unsigned char { Nothing, Open, SaveAs, Screenshot, FormulaFile, Motion };
    void ask(Asking what);
    void startLoading(const std::filesystem::path& path, bool allowOutside = false);
    void takeOver(Loader::Result result);
    void writeScene(const std::filesystem::path& path);
    void warnOfOutsideFiles(const std::filesystem::path& path);
    void afterUnsavedChanges(std::function<void()> next);
    void drawUnsavedChanges();
    void drawOutsideFiles();
    void drawProgress(const PixelRect& area);
    void chosen(const std::filesystem::path& path);

    Workspace& workspace_;
    OpenOptions options_;
    Loader loader_;
    std::string loadProblem_;
    double loadingSince_ = 0;
    FileBrowser browser_;
    Asking asking_ = Asking::Nothing;
    std::filesystem::path lastFolder_;
    std::function<void()> next_;  // what waits for an answer about unsaved changes
    bool askUnsaved_ = false;
    std::filesystem::path outsideScene_;  // refused for files outside its folder; waits for the user's word
    bool askOutside_ = false;
    bool quit_ = false;
    std::vector<std::filesystem::path> screenshots_;
};

}  // namespace voledit
