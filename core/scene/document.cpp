#include "core/scene/document.h"

#include <utility>

namespace voledit {

Document::Document(Scene scene, std::filesystem::path path) : saved_(scene), path_(std::move(path)) {
    history_.push_back({std::move(scene), ""});
}

void Document::preview(const std::function<void(Scene&)>& edit) {
    Scene edited = committed();
    edit(edited);
    preview_ = std::move(edited);
}

void Document::commit(const std::string& name) {
    if (!preview_) return;
    if (*preview_ != committed()) {
        history_.resize(now_ + 1);
        history_.push_back({std::move(*preview_), name});
        ++now_;
    }
    preview_.reset();
}

void Document::cancel() {
    preview_.reset();
}

void Document::apply(const std::string& name, const std::function<void(Scene&)>& edit) {
    preview(edit);
    commit(name);
}

bool Document::undo() {
    preview_.reset();
    if (now_ == 0) return false;
    --now_;
    return true;
}

bool Document::redo() {
    preview_.reset();
    if (now_ + 1 == history_.size()) return false;
    ++now_;
    return true;
}

std::vector<std::string> Document::undoNames() const {
    std::vector<std::string> names;
    for (std::size_t i = 1; i <= now_; ++i) names.push_back(history_[i].name);
    return names;
}

std::vector<std::string> Document::redoNames() const {
    std::vector<std::string> names;
    for (std::size_t i = history_.size(); i-- > now_ + 1;) names.push_back(history_[i].name);
    return names;
}

bool Document::modified() const {
    return committed() != saved_;
}

void Document::markSaved(std::filesystem::path path) {
    saved_ = committed();
    path_ = std::move(path);
}

}  // namespace voledit
