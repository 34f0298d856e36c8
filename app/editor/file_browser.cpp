#include "app/editor/file_browser.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "app/editor/icons.h"
#include "app/editor/keys.h"
#include "app/editor/theme.h"
#include "app/editor/widgets.h"

namespace voledit {

namespace fs = std::filesystem;

namespace {

std::string withSlash(const fs::path& folder) {
    const std::string text = folder.string();
    return text.ends_with('/') ? text : text + "/";
}

bool keyPressed(Key key) {
    return ImGui::IsKeyPressed(int(key));
}

// A file or folder that holds slices of one volume when opened as a whole.
bool isSlice(const BrowserEntry& entry) {
    const std::string ending = fs::path(entry.name).extension().string();
    return !entry.folder && (ending == ".dcm" || ending == ".ima" || ending == ".png" || ending == ".tif" ||
                             ending == ".tiff" || ending == ".IMA" || ending.empty());
}

}  // namespace

void FileBrowser::show(Request request) {
    request_ = std::move(request);
    visible_ = opening_ = true;
    overwrite_.reset();
    allFiles_ = false;
    std::error_code ignored;
    if (request_.folder.empty() || !fs::is_directory(request_.folder, ignored))
        request_.folder = fs::current_path(ignored);
    const std::string name = request_.name;
    goTo(request_.folder);
    if (request_.mode == Mode::Save) setText(withSlash(request_.folder) + name);
}

void FileBrowser::goTo(const fs::path& folder) {
    request_.folder = folder;
    entries_ = listFolder(folder, shown(), problem_);
    marked_ = -1;
    const std::string name = request_.mode == Mode::Save ? fs::path(text_).filename().string() : "";
    setText(withSlash(folder) + name);
    focusPath_ = true;
}

void FileBrowser::setText(const std::string& text) {
    text_ = text;
    replaceText_ = true;
}

void FileBrowser::mark(int row) {
    if (entries_.empty()) return;
    marked_ = std::clamp(row, 0, int(entries_.size()) - 1);
    scrollToMark_ = true;
    const BrowserEntry& entry = entries_[std::size_t(marked_)];
    setText((request_.folder / entry.name).string() + (entry.folder ? "/" : ""));
}

int FileBrowser::onTextEvent(ImGuiInputTextCallbackData& data) {
    if (data.EventFlag == ImGuiInputTextFlags_CallbackCompletion)
        setText(completed(std::string(data.Buf, std::size_t(data.BufTextLen)), request_.folder, shown()));
    if (data.EventFlag == ImGuiInputTextFlags_CallbackHistory)
        mark(data.EventKey == ImGuiKey_UpArrow ? marked_ - 1 : marked_ + 1);
    if (!replaceText_) return 0;
    replaceText_ = false;
    const std::string text = text_;
    data.DeleteChars(0, data.BufTextLen);
    data.InsertChars(0, text.c_str());
    return 0;
}

std::optional<fs::path> FileBrowser::draw(float scale) {
    if (!visible_) return std::nullopt;
    if (opening_) ImGui::OpenPopup(request_.title.c_str());
    opening_ = false;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * window.x, 0.5f * window.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSize(ImVec2(std::min(780 * scale, 0.94f * window.x), std::min(540 * scale, 0.94f * window.y)));
    if (!ImGui::BeginPopupModal(
            request_.title.c_str(), nullptr,
            ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
        visible_ = false;
        return std::nullopt;
    }
    const WidgetScope scope(request_.title);
    std::optional<fs::path> chosen;
    bool accepted = drawPath();
    const float buttons = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
    ImGui::BeginChild("places", ImVec2(150 * scale, -buttons));
    drawPlaces();
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("list", ImVec2(0, -buttons), true);
    accepted |= drawList();
    ImGui::EndChild();
    accepted |= drawButtons(scale);
    if (accepted && !overwrite_) chosen = accept();
    if (const auto path = drawOverwrite()) chosen = path;
    if (chosen || (keyPressed(Key::Escape) && !overwrite_)) visible_ = false;
    if (!visible_) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return chosen;
}

bool FileBrowser::drawPath() {
    if (ui::iconButton(icons::kUp, "Up", "The folder above (Alt+Up)") || (ImGui::GetIO().KeyAlt && keyPressed(Key::Up)))
        goTo(request_.folder.parent_path());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    if (focusPath_ && !overwrite_) ImGui::SetKeyboardFocusHere();
    constexpr ImGuiInputTextFlags flags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                                          ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackHistory |
                                          ImGuiInputTextFlags_CallbackAlways;
    const auto callback = [](ImGuiInputTextCallbackData* data) {
        return static_cast<FileBrowser*>(data->UserData)->onTextEvent(*data);
    };
    const bool entered = ImGui::InputText("##path", &text_, flags, callback, this);
    if (ImGui::IsItemActive())
        focusPath_ = false;
    else
        replaceText_ = false;
    noteWidget("Path");
    return entered;
}

void FileBrowser::drawPlaces() {
    std::error_code ignored;
    const auto place = [&](const char* icon, const char* name, const fs::path& folder) {
        if (folder.empty() || !fs::is_directory(folder, ignored)) return;
        if (ImGui::Selectable((std::string(icon) + "  " + name).c_str(), request_.folder == folder)) goTo(folder);
        noteWidget(name);
    };
    const char* home = std::getenv("HOME");
    place(icons::kHome, "Home", home ? fs::path(home) : fs::path());
    place(icons::kFolder, "Started in", fs::current_path(ignored));
    place(icons::kFolder, "Whole disk", "/");
    ImGui::Dummy(ImVec2(0, ImGui::GetStyle().ItemSpacing.y));
    if (request_.mode == Mode::Save) return;
    bool all = allFiles_;
    if (ui::checkbox("##All files", all, "Shows also files that voledit does not open by their ending").changed) {
        allFiles_ = all;
        goTo(request_.folder);
    }
    noteWidget("All files");
    ImGui::SameLine();
    ImGui::TextUnformatted("All files");
}

bool FileBrowser::drawList() {
    if (!problem_.empty())
        ui::warning(problem_);
    else if (entries_.empty())
        ui::note("Nothing here that voledit opens.");
    bool accepted = false;
    const float right = ImGui::GetContentRegionMax().x;
    for (int row = 0; row < int(entries_.size()); ++row) {
        const BrowserEntry entry = entries_[std::size_t(row)];
        ImGui::PushID(row);
        const std::string label = std::string(entry.folder ? icons::kFolder : icons::kFile) + "  " + entry.name;
        if (ImGui::Selectable(label.c_str(), row == marked_, ImGuiSelectableFlags_AllowDoubleClick)) {
            mark(row);
            scrollToMark_ = false;
            accepted = ImGui::IsMouseDoubleClicked(0);
        }
        noteWidget(entry.name);
        if (row == marked_ && scrollToMark_) ImGui::SetScrollHereY();
        if (!entry.folder) {
            const std::string size = sizeText(entry.bytes);
            ImGui::SameLine(right - ImGui::CalcTextSize(size.c_str()).x);
            ImGui::TextColored(ImVec4(theme::kTextDim.x, theme::kTextDim.y, theme::kTextDim.z, 1), "%s", size.c_str());
        }
        ImGui::PopID();
    }
    scrollToMark_ = false;
    return accepted;
}

bool FileBrowser::drawButtons(float scale) {
    const float width = 110 * scale, spacing = ImGui::GetStyle().ItemSpacing.x;
    if (request_.mode == Mode::Open && std::count_if(entries_.begin(), entries_.end(), isSlice) > 1) {
        if (ui::button("Open folder as one volume", "Reads all slices of this folder: DICOM, TIFF or PNG")) {
            setText(request_.folder.string());
            wholeFolder_ = true;
            return true;
        }
        ImGui::SameLine();
    }
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * width - spacing);
    if (ImGui::Button("Cancel", ImVec2(width, 0))) visible_ = false;
    noteWidget("Cancel");
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Button, packed(withAlpha(theme::kAccent, 0.65f)));
    const bool pressed = ImGui::Button(request_.button.c_str(), ImVec2(width, 0));
    ImGui::PopStyleColor();
    noteWidget(request_.button);
    return pressed || (!ImGui::IsAnyItemActive() && keyPressed(Key::Enter));
}

std::optional<fs::path> FileBrowser::accept() {
    const bool wholeFolder = std::exchange(wholeFolder_, false);
    fs::path path = pathFromText(text_, request_.folder);
    std::error_code ignored;
    if (fs::is_directory(path, ignored) && !wholeFolder) {
        goTo(path);
        return std::nullopt;
    }
    focusPath_ = true;
    if (request_.mode == Mode::Open) {
        // A pattern ("slice_%03d.png") names no file; whoever reads it tells.
        if (!fs::exists(path, ignored) && text_.find_first_of("%*") == text_.npos) {
            problem_ = path.string() + " is not there";
            return std::nullopt;
        }
    } else {
        if (!path.has_extension()) path += request_.ending;
        if (!fs::is_directory(path.parent_path(), ignored)) {
            problem_ = path.parent_path().string() + ": there is no such folder";
            return std::nullopt;
        }
        if (fs::exists(path, ignored)) {
            overwrite_ = path;
            ImGui::OpenPopup("Replace?");
            return std::nullopt;
        }
    }
    request_.folder = path.parent_path();
    return path;
}

std::optional<fs::path> FileBrowser::drawOverwrite() {
    if (!overwrite_) return std::nullopt;
    std::optional<fs::path> chosen;
    if (ImGui::BeginPopupModal("Replace?", nullptr,
                               ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
        const WidgetScope scope("Replace");
        ImGui::Text("%s is there already.", overwrite_->filename().string().c_str());
        const bool yes = ui::button("Replace") || (!ImGui::IsWindowAppearing() && keyPressed(Key::Enter));
        ImGui::SameLine();
        const bool no = ui::button("Keep") || keyPressed(Key::Escape);
        if (yes) chosen = overwrite_;
        if (yes || no) ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        if (yes) request_.folder = chosen->parent_path();
        if (yes || no) overwrite_.reset();
    } else {
        overwrite_.reset();
    }
    return chosen;
}

}  // namespace voledit
