#pragma once
// A scene with undo: committed snapshots, and one preview on top of the last.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace voledit {

/// Holds the scene being edited. `preview` always restarts from the last commit, so that a hundred mouse moves are one
/// step and Escape costs nothing. Snapshots share what is equal.
class Document {
public:
    explicit Document(Scene scene, std::filesystem::path path = {});

    /// What is shown: the preview where there is one, else the last commit.
    const Scene& scene() const { return preview_ ? *preview_ : history_[now_].scene; }
    const Scene& committed() const { return history_[now_].scene; }

    /// Applies `edit` to a copy of the last commit and shows it. An exception leaves things as they were.
    void preview(const std::function<void(Scene&)>& edit);
    /// Makes the preview a step called `name`; forgets redo. Without a preview, or where it equals the last commit,
    /// nothing happens.
    void commit(const std::string& name);
    /// Drops the preview.
    void cancel();
    /// preview and commit in one.
    void apply(const std::string& name, const std::function<void(Scene&)>& edit);
    bool previewing() const { return preview_.has_value(); }

    /// Drops a preview and goes a step back or on; false where there is none.
    bool undo();
    bool redo();
    /// Names of the steps that undo (redo) would take back (on), the next one last.
    std::vector<std::string> undoNames() const;
    std::vector<std::string> redoNames() const;

    /// True if the committed scene is not the one last saved or opened.
    bool modified() const;
    void markSaved(std::filesystem::path path);
    /// Where it was opened from or saved to; empty where never.
    const std::filesystem::path& path() const { return path_; }

private:
    struct Step {
        Scene scene;
        std::string name;  // of the edit that led here
    };
    std::vector<Step> history_;
    std::size_t now_ = 0;
    Scene saved_;
    std::optional<Scene> preview_;
    std::filesystem::path path_;
};

}  // namespace voledit
