#include "app/editor/editor.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <new>
#include <utility>

#include "app/editor/actor_actions.h"
#include "app/editor/add_actions.h"
#include "app/editor/event_words.h"
#include "app/editor/locate.h"
#include "app/editor/motion_import.h"
#include "app/editor/node_actions.h"
#include "app/editor/theme.h"
#include "app/editor/timeline/dope_rows.h"
#include "app/editor/timeline/key_actions.h"
#include "app/editor/timeline/key_row.h"
#include "app/editor/timeline/keying.h"
#include "app/editor/timeline/timeline_actions.h"
#include "app/editor/tools/node_overlay.h"
#include "app/editor/tools/tool_actions.h"
#include "core/base/error.h"
#include "core/scene/edits.h"

namespace voledit {

namespace {

constexpr PointerButton kToolButton[] = {PointerButton::Left, PointerButton::Right, PointerButton::Middle};

Modifiers modifiersNow() {
    const ImGuiIO& io = ImGui::GetIO();
    return {io.KeyShift, io.KeyCtrl, io.KeyAlt};
}

bool isModifier(Key key) {
    return key >= Key::Shift;
}

// A digit of the keypad is the digit, as event files and shortcuts name it.
Key withoutKeypad(Key key) {
    if (key >= Key::Keypad0 && key <= Key::Keypad9) return Key(int(Key::Num0) + int(key) - int(Key::Keypad0));
    switch (key) {
        case Key::KeypadDecimal:
            return Key::Period;
        case Key::KeypadSubtract:
            return Key::Minus;
        case Key::KeypadEnter:
            return Key::Enter;
        default:
            return key;
    }
}

// "G", "Escape", "7", "." as the tools name keys: signs stand for themselves.
std::string toolKeyName(Key key) {
    key = withoutKeypad(key);
    const bool sign = int(key) > ' ' && int(key) < 128;
    return sign ? std::string(1, char(key)) : std::string(nameOf(key));
}

// ImGui closes menus by Escape only where it navigates by keys. Dialogs close themselves.
void closeMenu() {
    const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
    const ImGuiWindow* top = open.back().Window;
    if (top && !(top->Flags & ImGuiWindowFlags_Modal)) ImGui::ClosePopupToLevel(open.Size - 1, true);
}

// Chords that a text field uses itself.
bool belongsToTextField(const Chord& chord) {
    if (!chord.ctrl) return true;
    constexpr std::array kOwn{Key::A, Key::C,    Key::V,     Key::X,    Key::Z,
                              Key::Y, Key::Left, Key::Right, Key::Home, Key::End};
    return std::find(kOwn.begin(), kOwn.end(), chord.key) != kOwn.end();
}

}  // namespace

Editor::Editor(const EditorSettings& settings, IoClient& io)
    : io_(io), context_(ImGui::CreateContext()), files_(workspace_, io, settings.open), panels_(makePanels()) {
    makeCurrent();
    ImGuiIO& imgui = ImGui::GetIO();
    imgui.IniFilename = nullptr;
    imgui.LogFilename = nullptr;
    imgui.UserData = &widgets_;
    imgui.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    imgui.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    mapImGuiKeys();
    workspace_.headless = settings.headless;
    workspace_.renderer = settings.renderer;
    workspace_.scale = settings.scale;
    // A cursor that blinks would make pictures depend on when they were taken.
    imgui.ConfigInputTextCursorBlink = !settings.headless;
    applyTheme(settings.scale);
    ++fontsBuilt_;
    addFileActions();
    addRenderingActions();
    addEditActions();
    addToolActions(workspace_.actions, workspace_, tools_);
    addActorActions(workspace_.actions, workspace_, job_, [this](const std::string& path) { importMotion(path); });
    addPoseActions(workspace_.actions, workspace_, tools_);
    addNodeActions(workspace_.actions, workspace_);
    addAddActions(workspace_.actions, workspace_, [this] { files_.chooseFormulaFile(); });
    addTimelineActions(workspace_.actions, workspace_);
    addKeyActions(workspace_.actions, workspace_);
    addViewActions();
    addLookActions();
}

Editor::~Editor() {
    ImGui::DestroyContext(context_);
}

void Editor::makeCurrent() const {
    ImGui::SetCurrentContext(context_);
}

const ImDrawData& Editor::drawData() const {
    makeCurrent();
    return *ImGui::GetDrawData();
}

void Editor::setScale(float scale) {
    if (scale != workspace_.scale) newScale_ = scale;
}

void Editor::frame(const FrameInput& input) {
    makeCurrent();
    if (newScale_) {
        workspace_.scale = *std::exchange(newScale_, std::nullopt);
        applyTheme(workspace_.scale);
        ++fontsBuilt_;
    }
    queue_.push(input.events);
    const std::vector<InputEvent> events = queue_.takeFrame();
    const bool played = workspace_.timeline.playback.playing();
    if (recorder_) recorder_->frame(events, input.seconds, played);
    workspace_.clock += input.seconds;

    window_ = glm::max(input.size, Index2(1));
    // Before what starts it: what has passed until now was not played.
    advanceTime(workspace_, input.seconds);
    TimelineState& timeline = workspace_.timeline;
    timeline.shown = workspace_.open && timeline.wanted.value_or(changesOverTime(workspace_));
    layout_ = layoutOf(window_, workspace_.scale, timeline.shown ? timeline.height : 0);
    workspace_.viewOrigin = layout_.view.origin;
    workspace_.viewSize = layout_.view.size;
    // Before what was loaded is taken over: Escape in the frame in which loading ended still stops it.
    if (std::find(events.begin(), events.end(), InputEvent::stroke(Key::Escape, true)) != events.end()) {
        files_.cancelLoading();
        job_.cancel();
    }
    if (files_.poll() && recorder_) recorder_->loaded();
    finishJobs();
    pollRendering();

    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = ImVec2(float(window_.x), float(window_.y));
    io.DeltaTime = float(std::max(input.seconds, 1e-4));
    feedImGui(events);
    ImGui::NewFrame();
    timeline.hovered = fieldAt(timeline, Vec2(io.MousePos.x, io.MousePos.y));
    timeline.fields.clear();
    const auto guarded = [&](auto&& work) {
        try {
            work();
        } catch (const Error& error) {
            workspace_.notify(Notice::Kind::Problem, error.what());
        } catch (const std::bad_alloc&) {
            workspace_.notify(Notice::Kind::Problem, "There is not enough memory for this; nothing was changed.");
        }
    };
    guarded([&] { dispatch(events); });
    if (input.close) guarded([&] { files_.quit(); });
    drawInterface();
    guarded([&] { runKeyRequest(workspace_); });
    endPendingEdit();
    // Frames of a recording are no exact clock: where it stopped is said.
    if (recorder_ && played && !timeline.playback.playing())
        recorder_->action("timeline.goto", numberText(workspace_.time));
    guarded([&] { settleSelection(workspace_); });
    settleKeys(workspace_);
    refreshFormulaFiles(false);
    compileScene();
    updateActors();
    overlay_ = {};
    if (workspace_.open && workspace_.overlays)
        guarded([&] {
            tools_.joints().fillOverlay(toolContext(workspace_), overlay_);
            tools_.lattice().fillOverlay(toolContext(workspace_), overlay_);
            appendNode(workspace_.document.scene(), workspace_.selection.node, workspace_.time, workspace_.scale,
                       overlay_);
        });
    ImGui::Render();
    widgets_.newFrame();
}

// ---- Input --------------------------------------------------------------------------------------------------------

void Editor::dispatch(const std::vector<InputEvent>& events) {
    const ImGuiContext& imgui = *ImGui::GetCurrentContext();
    const ImGuiWindow* view = ImGui::FindWindowByName("##view");
    const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const bool over = view && imgui.HoveredWindow == view && !popup && !files_.loading() && workspace_.open;
    if (hovered_ && !over && !tools_.capturing())
        tools_.pointer(toolContext(workspace_), {PointerPhase::Leave, {}, PointerButton::None, {}, 0});
    hovered_ = over;
    for (const InputEvent& event : events) switch (event.kind) {
            case InputEvent::Kind::Key:
                if (event.down && !isModifier(event.key)) dispatchKey(event.key);
                break;
            case InputEvent::Kind::Drop:
                if (files_.loading()) break;
                if (isMotionFile(event.text))
                    workspace_.actions.run("actor.import-motion", event.text);
                else
                    files_.open(event.text);
                break;
            case InputEvent::Kind::Text:
                break;
            default:
                dispatchPointer(event);
        }
}

void Editor::dispatchPointer(const InputEvent& event) {
    PointerEvent pointer;
    if (event.kind == InputEvent::Kind::Move) mouse_ = event.at;
    pointer.at = mouse_ - Vec2(workspace_.viewOrigin);
    pointer.modifiers = modifiersNow();
    const bool ours = hovered_ || tools_.capturing() || tools_.moving();
    switch (event.kind) {
        case InputEvent::Kind::Move:
            if (ours) tools_.pointer(toolContext(workspace_), pointer);
            break;
        case InputEvent::Kind::Button:
            pointer.phase = event.down ? PointerPhase::Down : PointerPhase::Up;
            pointer.button = kToolButton[int(event.button)];
            if (event.down ? hovered_ : tools_.capturing()) tools_.pointer(toolContext(workspace_), pointer);
            if (event.down && hovered_ && ImGui::IsMouseDoubleClicked(int(event.button))) {
                pointer.phase = PointerPhase::DoubleClick;
                tools_.pointer(toolContext(workspace_), pointer);
            }
            break;
        case InputEvent::Kind::Wheel:
            pointer.phase = PointerPhase::Wheel;
            pointer.wheel = event.wheel;
            if (hovered_) tools_.pointer(toolContext(workspace_), pointer);
            break;
        default:
            break;
    }
}

void Editor::dispatchKey(Key key) {
    if (files_.loading()) {
        if (key == Key::Escape) files_.cancelLoading();
        return;
    }
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
        if (key == Key::Escape) closeMenu();
        return;
    }
    // Its own keys are read where it is drawn.
    if (timeline_.busy()) return;
    const Chord chord{key, io.KeyCtrl, io.KeyShift, io.KeyAlt};
    // A widget that is dragged or typed in has the keyboard: Escape restores it.
    const bool widgetActive = ImGui::IsAnyItemActive() && !tools_.capturing();
    if (io.WantTextInput ? belongsToTextField(chord) : widgetActive) return;
    if (!io.WantTextInput && workspace_.open && tools_.key(toolContext(workspace_), {toolKeyName(key), modifiersNow()}))
        return;
    runShortcut(chord);
}

// Without a timeline there is nothing but the tree to step through.
KeyRegion Editor::regionOfMouse() const {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Vec2 at(mouse.x, mouse.y);
    if (!workspace_.timeline.shown || layout_.panels.contains(at)) return KeyRegion::Panels;
    return layout_.time.contains(at) ? KeyRegion::Timeline : KeyRegion::Anywhere;
}

void Editor::runShortcut(const Chord& chord) {
    const Actions& actions = workspace_.actions;
    const KeyRegion region = regionOfMouse();
    Chord meant = chord;
    // Blender's second key for it.
    if (chord == Chord{Key::X}) meant.key = Key::Delete;
    const auto lookUp = [&] {
        const Action* here = actions.ofShortcut(meant, region);
        return here ? here : actions.ofShortcut(meant);
    };
    const Action* action = lookUp();
    if (!action) {
        meant.key = withoutKeypad(chord.key);
        action = lookUp();
    }
    if (action && action->isEnabled()) action->run({});
}

void Editor::act(const std::string& action, const std::string& argument) {
    makeCurrent();
    if (recorder_) recorder_->action(action, argument);
    workspace_.actions.run(action, argument);
}

Vec2 Editor::locate(const Place& place) const {
    return locatePlace(place, workspace_, widgets_, window_);
}

void Editor::reveal(const Place& place) {
    if (place.kind == Place::Kind::Widget) widgets_.reveal(widgetNamed(place.name, widgets_));
    if (place.kind != Place::Kind::Key) return;
    workspace_.timeline.reveal = trackNamed(workspace_.document.scene(), place.name).value_or("");
    workspace_.timeline.revealKey = place.point.x;
}

// What the mouse holds is let go, and the scene is as it was before.
void Editor::endGestures() {
    tools_.cancel(toolContext(workspace_));
    timeline_.cancel(workspace_);
    if (!ImGui::IsAnyMouseDown()) return;
    workspace_.document.cancel();
    ImGui::ClearActiveID();
}

void Editor::drawnBy(const std::string& renderer, const std::string& slicesProblem) {
    rendererName_ = renderer;
    if (!slicesProblem.empty() && slicesProblem_.empty())
        // The remedy at its end has just been taken.
        workspace_.notify(Notice::Kind::Warning,
                          slicesProblem.substr(0, slicesProblem.rfind("; ")) + "; rays on the CPU draw it");
    slicesProblem_ = slicesProblem;
}

std::optional<double> Editor::playedFrame() const {
    if (!workspace_.timeline.playback.playing()) return std::nullopt;
    return 1 / workspace_.document.scene().timeline.fps;
}

double Editor::untilNextFrame() const {
    const double news = rendering() ? 0.25 : kInfinity;
    if (!workspace_.timeline.playback.playing()) return news;
    return std::min(news, workspace_.timeline.playback.untilNext(workspace_.document.scene().timeline));
}

// ---- What follows from the edits ----------------------------------------------------------------------------------

// An edit whose widget is gone: as if its field had been left.
void Editor::endPendingEdit() {
    if (workspace_.pending.step.empty() || ImGui::IsAnyItemActive()) return;
    if (workspace_.pending.wrong)
        workspace_.document.cancel();
    else
        workspace_.document.commit(workspace_.pending.step);
    workspace_.pending = {};
}

// Once a change of the scene, and a few times a second for changes on disk.
void Editor::refreshFormulaFiles(bool always) {
    constexpr double kSecondsBetweenLooks = 0.3;
    if (!workspace_.open) return;
    const Scene& scene = workspace_.document.scene();
    const bool changed = !filesOf_ || !(*filesOf_ == scene);
    if (!always && !changed && workspace_.clock - filesLookedAt_ < kSecondsBetweenLooks) return;
    if (changed) filesOf_ = scene;
    filesLookedAt_ = workspace_.clock;
    const auto news = workspace_.formulaFiles.refresh(scene, workspace_.folder, workspace_.assets, always);
    for (const FormulaFiles::News& item : news)
        workspace_.notify(item.problem ? Notice::Kind::Problem : Notice::Kind::Info, item.text);
    if (!news.empty()) compiledFrom_.reset();
}

void Editor::compileScene() {
    if (!workspace_.open) return;
    Scene scene = workspace_.document.scene();
    scene.camera = workspace_.camera;
    if (const auto actor = actorAtRest()) scene = atRest(std::move(scene), actor->path);
    if (compiledFrom_ && *compiledFrom_ == scene && workspace_.compiled.time == workspace_.time) return;
    compiledFrom_ = scene;
    const double aspect = double(workspace_.viewSize.x) / workspace_.viewSize.y;
    try {
        workspace_.compiled = compile(scene, workspace_.assets, workspace_.time, &workspace_.compiled, aspect);
        workspace_.problem.clear();
    } catch (const Error& error) {
        // The picture stays the last good one.
        if (workspace_.problem != error.what()) workspace_.notify(Notice::Kind::Problem, error.what());
        workspace_.problem = error.what();
    }
}

}  // namespace voledit
