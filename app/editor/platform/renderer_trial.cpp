#include "app/editor/platform/renderer_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/editor/platform/frame_governor.h"
#include "core/base/error.h"

namespace voledit {

namespace {

// What is tried: a picture as it is drawn while something moves.
constexpr double kDivisor = 3, kStep = 1.5;
// So many times the rays' time, and at least so long, slices may take before they are given up.
constexpr double kPatience = 2, kLeastMs = 15;

std::string sentence(const char* winner, double won, const char* loser, double lost, bool gaveUp) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  gaveUp ? "%s are faster here: %.0f ms for a small picture, %s more than %.0f ms"
                         : "%s are faster here: %.0f ms for a small picture, %s %.0f ms",
                  winner, won, loser, lost);
    return text.data();
}

}  // namespace

RendererTrial::Key RendererTrial::keyOf(const TermShape& shape, Index2 size) {
    return {shape, int(std::lround(std::log2(double(size.x) * size.y)))};
}

const RendererVerdict* RendererTrial::find(const TermShape& shape, Index2 size) const {
    const auto found = verdicts_.find(keyOf(shape, size));
    return found == verdicts_.end() ? nullptr : &found->second;
}

void RendererTrial::decide(const CompiledScene& scene, Index2 size, RendererVerdict verdict) {
    verdicts_[keyOf(shapeOf(scene), size)] = std::move(verdict);
}

// Milliseconds for the picture, the whole of it reckoned from a part where it is not done in time.
double RendererTrial::costOf(PictureSource& source, const CompiledScene& scene, Index2 size, double patienceMs) {
    const PictureEffort effort{kStep, true};
    source.begin(scene, size, effort);
    source.advance(patienceMs);
    const double start = clock_();
    source.begin(scene, size, effort);
    const bool done = source.advance(patienceMs);
    const double took = clock_() - start;
    return done ? took : std::max(took, patienceMs) / std::max(source.progress(), 1e-3);
}

const RendererVerdict& RendererTrial::measure(const CompiledScene& scene, Index2 size, PictureSource& rays,
                                              PictureSource& slices, double patienceMs) {
    const Index2 small = glm::max(Index2(Vec2(size) / kDivisor), Index2(1));
    RendererVerdict verdict;
    try {
        const double raysMs = costOf(rays, scene, small, patienceMs);
        const double limit = std::max(kLeastMs, kPatience * std::min(raysMs, patienceMs));
        const double slicesMs = costOf(slices, scene, small, limit);
        verdict.rays = raysMs <= slicesMs;
        verdict.why = verdict.rays ? sentence("Rays", raysMs, "slices", std::min(slicesMs, limit), slicesMs > limit)
                                   : sentence("Slices", slicesMs, "rays", raysMs, false);
    } catch (const Error& error) {
        verdict = {true, error.what()};  // slices cannot draw it
    }
    return verdicts_[keyOf(shapeOf(scene), size)] = std::move(verdict);
}

}  // namespace voledit
