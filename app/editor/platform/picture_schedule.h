#pragma once
// Which picture the viewport draws next: with which renderer, how fine, and for how long in this frame. No OpenGL of
// its own, and its clock is given, so that tests drive it by renderers that only pretend.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/platform/frame_governor.h"
#include "app/editor/platform/picture_source.h"
#include "app/editor/platform/renderer_trial.h"
#include "app/editor/workspace.h"

namespace voledit {

/// A change is drawn at once, as finely as the frame's budget allows; at rest better pictures follow a piece a frame,
/// up to the viewport's size and the scene's own step: the picture that `voledit render` gives. What is unfinished when
/// the scene changes is dropped, except for a picture at the coarsest quality that one frame is too short for: it is
/// shown when it is done, so that something is always seen.
class PictureSchedule {
public:
    /// Makes a renderer when it is first needed; `rays` or slices.
    using MakeSource = std::function<std::unique_ptr<PictureSource>(bool rays)>;
    /// Milliseconds, from any start.
    using Clock = std::function<double()>;

    /// `raysFirst`: what draws until both have been measured.
    PictureSchedule(MakeSource makeSource, Clock clock, bool raysFirst);

    /// A frame of the window.
    struct Frame {
        double budgetMs = 30;  // that the whole of it may take
        double restMs = 0;     // of it, what is no picture
        bool refines = true;   // at rest; not while a scene plays
    };

    /// Works within the frame. True when a picture has become complete: `texture()` is it.
    bool update(const CompiledScene& scene, Index2 size, RendererChoice choice, const Frame& frame);
    /// Draws the picture of full quality at once. False where it was there already.
    bool finish(const CompiledScene& scene, Index2 size, RendererChoice choice);

    /// The picture that was completed last; valid until the next update.
    SourceTexture texture() { return source(shownByRays_).texture(); }
    const Picture& picture() { return source(shownByRays_).picture(); }
    bool drawnByRays() const { return shownByRays_; }
    Index2 pictureSize() const { return shownSize_; }
    Index2 viewSize() const { return wanted_ ? wanted_->size : Index2(1); }

    /// True if the last update or finish had something new to draw.
    bool changed() const { return changed_; }
    /// True when the picture of full quality is there.
    bool finished() const { return shownIsFinal_ && !working_; }
    /// True while an update of the same scene has something to do: refining, or measuring the renderers.
    bool busy() const { return !finished() || trialWaits_; }
    /// 0 … 1 of the way to full quality.
    double progress() const;
    bool rays() const { return rays_; }
    /// Why rays drew where slices were wanted; empty where they were not.
    const std::string& slicesProblem() const { return slicesProblem_; }
    /// What its pictures lack, a line each.
    std::vector<std::string> notices() const;
    /// Why this renderer draws, in a sentence.
    std::string reason() const;

private:
    // All that a picture depends on; compared by value.
    struct Wanted {
        TermPtr root;
        Camera camera;
        RenderSettings render;
        double opacityDistance, unitStep;
        Index2 size;
        RendererChoice choice;
        bool operator==(const Wanted&) const = default;
    };
    // What one renderer is known to cost for one structure of a scene.
    struct Costs {
        FrameGovernor moving;
        double finalRate = 0;  // milliseconds a unit of work of a picture that is not `moving`; 0: not known
    };
    struct Work {
        PictureQuality quality;
        bool moving = false;
        double work = 0, tookMs = 0;
    };

    bool note(const CompiledScene& scene, Index2 size, RendererChoice choice);
    void chooseRenderer(const CompiledScene& scene, RendererChoice choice);
    bool drawMoving(const CompiledScene& scene, const Frame& frame);
    bool drawMovingWith(PictureSource& source, const CompiledScene& scene, const Frame& frame);
    void tryCost(PictureSource& source, const CompiledScene& scene, const Frame& frame);
    bool refine(const CompiledScene& scene, const Frame& frame);
    PictureQuality nextFiner() const;
    double begin(PictureSource& source, const CompiledScene& scene, const PictureQuality& quality, bool moving);
    bool advance(double budgetMs);
    bool complete();
    void leaveToRays(const std::string& problem);
    double fullWork() const;
    Costs& costs();
    PictureSource& source(bool rays);

    MakeSource makeSource_;
    Clock clock_;
    bool raysFirst_;
    std::unique_ptr<PictureSource> sources_[2];  // slices, rays
    std::map<TermShape, std::array<Costs, 2>> costs_;
    RendererTrial trial_;

    std::optional<Wanted> wanted_;
    TermShape shape_;
    bool rays_ = false, changed_ = false, trialWaits_ = false;
    std::string slicesProblem_;
    std::optional<Work> working_;  // the source that draws is at it
    Index2 workingSize_{1}, shownSize_{1};
    PictureQuality shown_;
    bool shownIsFinal_ = false, shownIsMoving_ = true, shownByRays_ = false;
};

}  // namespace voledit
