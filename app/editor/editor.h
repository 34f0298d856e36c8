#pragma once
// The editor without its pixels: one frame takes input and gives a compiled scene, overlays and ImGui's triangles.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/actor_analysis.h"
#include "app/editor/animation_dialog.h"
#include "app/editor/animation_job.h"
#include "app/editor/background.h"
#include "app/editor/files.h"
#include "app/editor/input_queue.h"
#include "app/editor/layout.h"
#include "app/editor/notice_list.h"
#include "app/editor/panel.h"
#include "app/editor/places.h"
#include "app/editor/recorder.h"
#include "app/editor/still_dialog.h"
#include "app/editor/still_job.h"
#include "app/editor/timeline/timeline_panel.h"
#include "app/editor/tools/viewport_tools.h"
#include "app/editor/widget_places.h"
#include "app/editor/workspace.h"

struct ImGuiContext;
struct ImDrawData;

namespace voledit {

struct EditorSettings {
    float scale = 1;
    bool headless = false;
    RendererChoice renderer = RendererChoice::Auto;
    OpenOptions open;
};

/// How fast the picture followed the last interaction; only in a window.
struct FrameTimes {
    double frameMs = 0;  // median time from one picture to the next, or from its input where it waited for one
    double picturesPerSecond = 0;  // 1 / the mean of these times
    double refinedMs = 0;          // from the last input to full quality; 0 while refining
};

/// What the viewport shows.
struct PictureStatus {
    Index2 size{1}, of{1};  // of the picture, and of the viewport that it fills; pixels
    double progress = 1;    // 0…1 of the way to full quality
    std::string why;        // its renderer was taken, a sentence
};

/// Owns what is edited and how it is shown; knows nothing of GL or windows. Everything happens in `frame`, in one
/// order: input → tools and actions → interface → compile → overlay. Each step takes values and gives values; what
/// changed is found by comparing them.
class Editor {
public:
    /// `io` outlives it.
    Editor(const EditorSettings& settings, IoClient& io);
    ~Editor();
    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    /// One frame. Problems become notices; nothing is thrown for them.
    void frame(const FrameInput& input);
    /// What the frame is drawn from: ImGui's triangles, with texture `kViewTexture` where the viewport's picture lies
    /// below everything else.
    const ImDrawData& drawData() const;
    static constexpr unsigned kViewTexture = ~0u;
    const Overlay& overlay() const { return overlay_; }
    /// Counts up whenever the font atlas was built anew.
    int fontsBuilt() const { return fontsBuilt_; }

    Workspace& workspace() { return workspace_; }
    const Workspace& workspace() const { return workspace_; }
    Files& files() { return files_; }
    /// The length of a frame while the timeline plays, seconds; pictures then keep to it, and are not refined.
    std::optional<double> playedFrame() const;
    /// How long a window may sleep, seconds, because nothing changes before; infinite where nothing plays.
    double untilNextFrame() const;
    /// True while work at the user's wish goes on in the background.
    bool working() const { return job_.running(); }
    /// Blocks until it is done; the next frame takes it over.
    void waitForWork() { job_.wait(); }
    /// True while an animation or a picture is rendered. Edits go on; nothing waits for it unless it is told to.
    bool rendering() const { return animation_.running() || still_.running(); }
    /// Blocks until there is news of it for the next frame.
    void waitForRendering() const;
    /// Why the last rendering failed; empty where it did not.
    const std::string& renderingProblem() const { return renderingProblem_; }
    bool inputWaits() const { return !queue_.empty(); }
    bool finished() const { return files_.quitConfirmed(); }
    /// Makes the interface of another size, from the next frame on.
    void setScale(float scale);
    /// The context of ImGui's that all is drawn in, made current.
    void makeCurrent() const;

    /// Runs a named action as an event file does. Throws Error.
    void act(const std::string& action, const std::string& argument);
    /// Window pixels of a place that is on the screen. Throws Error that says what there is.
    Vec2 locate(const Place& place) const;
    /// Scrolls a widget or key into view within the next two frames, where it is in a panel that scrolls.
    void reveal(const Place& place);
    /// Where frames and actions are written; null: nowhere. Outlives the editor or is taken off.
    void setRecorder(Recorder* recorder) { recorder_ = recorder; }

    /// Shown in the status bar; nullopt when headless.
    std::optional<FrameTimes> times;
    /// Notes which renderer draws ("slices", "rays"); where slices were wanted and cannot, `slicesProblem` says why,
    /// and the user is told once.
    void drawnBy(const std::string& renderer, const std::string& slicesProblem);
    const std::string& rendererName() const { return rendererName_; }
    PictureStatus picture;

private:
    void dispatch(const std::vector<InputEvent>& events);
    void dispatchPointer(const InputEvent& event);
    void dispatchKey(Key key);
    void runShortcut(const Chord& chord);
    KeyRegion regionOfMouse() const;
    void drawInterface();
    void drawMenus();
    void drawViewport();
    void drawPanels();
    void drawStatus();
    void drawShortcuts();
    void drawJob(const PixelRect& area);
    void drawHoveredJoint();
    void drawRendering();
    bool drawRenderingBox(const char* scope, const std::string& text, double fraction, int above);
    void drawBesideMouse(const std::string& text);
    void endGestures();
    void endPendingEdit();
    void compileScene();
    void refreshFormulaFiles(bool always);
    void importMotion(const std::string& path);
    void finishJobs();
    void renderAnimation(const std::string& argument);
    void renderStill(const std::string& argument);
    void pollRendering();
    void updateActors();
    std::shared_ptr<const CompiledActor> actorAtRest() const;
    void addFileActions();
    void addRenderingActions();
    void addEditActions();
    void addViewActions();
    void addLookActions();
    std::string volumeLine() const;

    IoClient& io_;
    ImGuiContext* context_;
    WidgetPlaces widgets_;
    Workspace workspace_;
    Files files_;
    ViewportTools tools_;
    std::vector<Panel> panels_;
    InputQueue queue_;
    Recorder* recorder_ = nullptr;
    Background job_;        // one at a time, at the user's wish
    double jobSince_ = -1;  // editor time when it began; below 0: none
    ActorAnalysis analysis_;
    AnimationJob animation_;
    AnimationDialog animationDialog_;
    StillJob still_;
    StillDialog stillDialog_;
    std::string renderingProblem_;
    NoticeList noticeList_;
    TimelinePanel timeline_;
    Layout layout_;
    Index2 window_{1, 1};
    Overlay overlay_;
    int fontsBuilt_ = 0;
    std::string rendererName_ = "slices", slicesProblem_;
    std::optional<float> newScale_;
    Vec2 mouse_{0};         // window pixels, as the last event said: ImGui rounds
    bool hovered_ = false;  // the mouse is over the viewport with nothing in front
    bool showShortcuts_ = false;
    std::optional<Scene> compiledFrom_;
    std::optional<Scene> filesOf_;  // the scene whose formula files were looked at last, and when
    double filesLookedAt_ = 0;
};

}  // namespace voledit
