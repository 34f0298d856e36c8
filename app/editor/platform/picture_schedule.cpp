#include "app/editor/platform/picture_schedule.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/editor/renderer_choice.h"
#include "core/base/error.h"

namespace voledit {

namespace {

constexpr PictureQuality kFull{};
// A picture that is made only to learn what it costs.
constexpr PictureQuality kTried{16, 2};
// A moving picture that takes so many times its share is left for the next frame.
constexpr double kPatience = 1.5;
// Between a coarse picture and the full one another is shown where the full one takes longer than this, if it is so
// much coarser.
constexpr double kLongMs = 300, kCoarse = 2.2;
// The part of a frame that refining gets in any case.
constexpr double kLeastShare = 0.4;
// Of the way to full quality, for the picture between.
constexpr double kFirstPart = 0.2;

Index2 sizeAt(Index2 size, double divisor) {
    return glm::max(Index2(Vec2(size) / divisor + 0.5), Index2(1));
}

}  // namespace

PictureSchedule::PictureSchedule(MakeSource makeSource, Clock clock, bool raysFirst)
    : makeSource_(std::move(makeSource)), clock_(clock), raysFirst_(raysFirst), trial_(std::move(clock)) {}

PictureSource& PictureSchedule::source(bool rays) {
    auto& source = sources_[rays ? 1 : 0];
    if (!source) source = makeSource_(rays);
    return *source;
}

PictureSchedule::Costs& PictureSchedule::costs() {
    return costs_[shape_][rays_ ? 1 : 0];
}

// In millions of pixels × steps a voxel.
double PictureSchedule::fullWork() const {
    return 1e-6 * wanted_->size.x * wanted_->size.y / wanted_->render.step;
}

// ---- Choosing -----------------------------------------------------------------------------------------------------

void PictureSchedule::chooseRenderer(const CompiledScene& scene, RendererChoice choice) {
    slicesProblem_.clear();
    trialWaits_ = false;
    rays_ = choice == RendererChoice::Rays;
    if (choice != RendererChoice::Auto) return;
    rays_ = raysFirst_;
    if (const RendererVerdict* verdict = trial_.find(shape_, wanted_->size))
        rays_ = verdict->rays;
    else if (const std::string problem = whySlicesCannotDraw(scene.root); !problem.empty())
        leaveToRays(problem);
    else
        trialWaits_ = true;
}

void PictureSchedule::leaveToRays(const std::string& problem) {
    slicesProblem_ = problem;
    rays_ = true;
    trialWaits_ = false;
}

std::string PictureSchedule::reason() const {
    if (!wanted_ || wanted_->choice == RendererChoice::Rays) return "Rays are chosen in the panel Render.";
    if (!slicesProblem_.empty()) return slicesProblem_;
    if (wanted_->choice == RendererChoice::Slices) return "Slices are chosen in the panel Render.";
    if (const RendererVerdict* verdict = trial_.find(shape_, wanted_->size)) return verdict->why;
    return rays_ ? "Rays draw until both have been measured at rest; there is no GPU."
                 : "Slices draw until both have been measured at rest.";
}

// ---- Drawing ------------------------------------------------------------------------------------------------------

// Gives the milliseconds that it took.
double PictureSchedule::begin(PictureSource& source, const CompiledScene& scene, const PictureQuality& quality,
                              bool moving) {
    const double start = clock_();
    workingSize_ = sizeAt(wanted_->size, quality.divisor);
    source.begin(scene, workingSize_, {quality.step, moving});
    working_ = Work{quality, moving, fullWork() * shareOfWork(quality), 0};
    return clock_() - start;
}

// Goes on with the picture that was begun. True when it is complete.
bool PictureSchedule::advance(double budgetMs) {
    const double start = clock_();
    const bool done = source(rays_).advance(budgetMs);
    working_->tookMs += clock_() - start;
    return done;
}

// What was worked on is what is shown.
bool PictureSchedule::complete() {
    if (!working_->moving) costs().finalRate = working_->tookMs / working_->work;
    shown_ = working_->quality;
    shownIsMoving_ = working_->moving;
    shownIsFinal_ = shown_ == kFull && (!working_->moving || !source(rays_).movingDiffers());
    shownSize_ = workingSize_;
    shownByRays_ = rays_;
    working_.reset();
    return true;
}

// What a scene costs that was never drawn is learnt from a picture of a thousandth of the work, drawn twice: the first
// time what lasts is made.
void PictureSchedule::tryCost(PictureSource& source, const CompiledScene& scene, const Frame& frame) {
    FrameGovernor& governor = costs().moving;
    for (int n = 0; n < 2; ++n) {
        const double setup = begin(source, scene, kTried, true);
        const bool done = advance(frame.budgetMs);
        if (n == 0) continue;
        const double share = done ? 1 : std::max(source.progress(), 1e-3);
        governor.note(working_->work * share, {setup, working_->tookMs, frame.restMs});
    }
    working_.reset();
}

bool PictureSchedule::drawMovingWith(PictureSource& source, const CompiledScene& scene, const Frame& frame) {
    FrameGovernor& governor = costs().moving;
    // The coarsest there is, and one frame was not enough: it is finished, late.
    const bool late = working_ && working_->moving && working_->quality == qualityOfShare(0);
    double setup = 0;
    if (!late) {
        working_.reset();
        if (!governor.known()) tryCost(source, scene, frame);
        setup = begin(source, scene, governor.choose(frame.budgetMs, fullWork()), true);
    }
    const double before = working_->tookMs;
    const bool done = advance(kPatience * std::max(frame.budgetMs - frame.restMs, kLeastShare * frame.budgetMs));
    if (!late) {
        const double share = done ? 1 : std::max(source.progress(), 1e-3);
        governor.note(working_->work * share, {setup, working_->tookMs - before, frame.restMs});
    }
    return done && complete();
}

bool PictureSchedule::drawMoving(const CompiledScene& scene, const Frame& frame) {
    if (!rays_) try {
            return drawMovingWith(source(false), scene, frame);
        } catch (const Error& error) {
            leaveToRays(error.what());
            trial_.decide(scene, wanted_->size, {true, error.what()});
            working_.reset();
        }
    return drawMovingWith(source(true), scene, frame);
}

PictureQuality PictureSchedule::nextFiner() const {
    const auto found = costs_.find(shape_);
    const Costs* costs = found == costs_.end() ? nullptr : &found->second[rays_ ? 1 : 0];
    if (!costs) return kFull;
    const double rate = std::max(costs->finalRate, costs->moving.rate());
    if (shown_.divisor < kCoarse || rate * fullWork() < kLongMs) return kFull;
    return {std::max(1.5, shown_.divisor / 2), 1};
}

bool PictureSchedule::refine(const CompiledScene& scene, const Frame& frame) {
    const double budget = std::max(frame.budgetMs - frame.restMs, kLeastShare * frame.budgetMs);
    double setup = 0;
    if (!working_) setup = begin(source(rays_), scene, nextFiner(), false);
    return advance(std::max(budget - setup, 1.0)) && complete();
}

// ---- A frame ------------------------------------------------------------------------------------------------------

// Takes note of what is wanted. True where it is something new.
bool PictureSchedule::note(const CompiledScene& scene, Index2 size, RendererChoice choice) {
    Wanted wanted{scene.root, scene.camera, scene.render, scene.opacityDistance, scene.unitStep, size, choice};
    if (wanted_ && *wanted_ == wanted) return false;
    const bool sameShape = wanted_ && wanted_->root == wanted.root && wanted_->render == wanted.render;
    wanted_ = std::move(wanted);
    const bool before = rays_;
    if (TermShape shape = sameShape ? shape_ : shapeOf(scene); shape != shape_) {
        shape_ = std::move(shape);
        working_.reset();
    }
    chooseRenderer(scene, choice);
    if (before != rays_) working_.reset();
    shownIsFinal_ = false;
    return true;
}

bool PictureSchedule::update(const CompiledScene& scene, Index2 size, RendererChoice choice, const Frame& frame) {
    changed_ = note(scene, size, choice);
    if (changed_) return drawMoving(scene, frame);
    if (!frame.refines) return working_ && advance(frame.budgetMs) && complete();
    if (!finished()) return refine(scene, frame);
    if (std::exchange(trialWaits_, false)) trial_.measure(scene, size, source(true), source(false), 4 * frame.budgetMs);
    return false;
}

bool PictureSchedule::finish(const CompiledScene& scene, Index2 size, RendererChoice choice) {
    changed_ = note(scene, size, choice);
    if (finished()) return false;
    if (!rays_) try {
            begin(source(false), scene, kFull, false);
        } catch (const Error& error) {
            leaveToRays(error.what());
        }
    if (rays_) begin(source(true), scene, kFull, false);
    advance(0);
    return complete();
}

std::vector<std::string> PictureSchedule::notices() const {
    const PictureSource* source = sources_[rays_ ? 1 : 0].get();
    return source ? source->notices() : std::vector<std::string>();
}

double PictureSchedule::progress() const {
    if (finished()) return 1;
    const PictureSource* source = sources_[rays_ ? 1 : 0].get();
    if (!working_ || working_->moving || !source) return shownIsMoving_ ? 0 : kFirstPart;
    return working_->quality == kFull ? kFirstPart + (1 - kFirstPart) * source->progress()
                                      : kFirstPart * source->progress();
}

}  // namespace voledit
