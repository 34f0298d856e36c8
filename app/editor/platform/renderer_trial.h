#pragma once
// Slices or rays: both are measured once for each structure of a scene and size of the viewport.

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "app/editor/platform/picture_source.h"
#include "app/editor/platform/term_shape.h"

namespace voledit {

/// The faster renderer for a scene's structure on this machine.
struct RendererVerdict {
    bool rays = true;
    std::string why;  // a sentence
};

/// Remembers its verdicts. Both renderers draw the same small picture twice: what is uploaded and compiled at first is
/// not compared. Rays begin; slices are given up when they take several times as long.
class RendererTrial {
public:
    /// `clock`: milliseconds.
    explicit RendererTrial(std::function<double()> clock) : clock_(std::move(clock)) {}

    /// Null where it is not measured yet.
    const RendererVerdict* find(const TermShape& shape, Index2 size) const;
    /// Draws, and so blocks: about `patienceMs` a renderer, and once what the slices need to begin.
    const RendererVerdict& measure(const CompiledScene& scene, Index2 size, PictureSource& rays, PictureSource& slices,
                                   double patienceMs);
    /// Where it is known without a trial.
    void decide(const CompiledScene& scene, Index2 size, RendererVerdict verdict);

private:
    using Key = std::pair<TermShape, int>;  // and the viewport's size in octaves of pixels
    static Key keyOf(const TermShape& shape, Index2 size);
    double costOf(PictureSource& source, const CompiledScene& scene, Index2 size, double patienceMs);

    std::function<double()> clock_;
    std::map<Key, RendererVerdict> verdicts_;
};

}  // namespace voledit
