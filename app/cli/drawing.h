#pragma once
// Headless drawing for `render` and `bench`: one picture-maker over both renderers.

#include <functional>
#include <memory>
#include <string>

#include "core/base/picture.h"
#include "core/base/progress.h"
#include "core/scene/compile.h"

namespace voledit {

struct DrawStatistics {
    int slices = 0;
    std::uint64_t samples = 0;
    std::size_t cells = 0;
};

/// Draws compiled scenes to pictures by one renderer.
class Drawing {
public:
    virtual ~Drawing() = default;
    /// A finished picture, background under it. Throws Error, Cancelled.
    virtual Picture draw(const CompiledScene& scene, Index2 size, Progress* progress) = 0;
    virtual DrawStatistics statistics() const = 0;
    /// "slices", "rays" or "reference".
    virtual std::string renderer() const = 0;
    /// "egl", "osmesa", or "" for rays.
    virtual std::string gl() const = 0;
};

/// Throws UsageError for words that name no renderer or no way to OpenGL.
void checkDrawingNames(const std::string& renderer, const std::string& gl);

/// @param renderer  "slices", "rays", "reference" (plain rays in double precision: slow, what others are measured
/// against), or "" for slices that leave a term which they cannot draw to rays, with a
/// warning, once; which of the two draws a picture depends on that picture's term alone;
/// @param gl  "auto", "egl" or "osmesa". Throws UsageError for other words, Error
/// where the context cannot be made.
std::unique_ptr<Drawing> makeDrawing(const std::string& renderer, const std::string& gl);

/// A picture as it is written: drawn with `supersample` times the pixels along each side and averaged, then finished
/// (core/scene/tones.h) by the scene's exposure, tone mapping and transparency. Throws Error, Cancelled.
Picture drawStill(Drawing& drawing, const CompiledScene& scene, Index2 size, int supersample, Progress* progress);

/// Turns `camera` about its target, around its up-vector, by `degrees`.
Camera orbited(const Camera& camera, double degrees);

/// Moves one control point of the outermost lattice (or the first number of an outermost STF of another kind, or the
/// skeleton of an actor that is the root) by `length`, world units: the edit that `--time-edits` and `bench` time.
/// Throws Error where the root has no transfer.
void nudgeOutermost(Scene& scene, double length);

/// Milliseconds since this process started, and its largest resident set so far in MiB.
double millisecondsSinceStart();
double peakMebibytes();
/// Wall-clock milliseconds that `work` takes.
double millisecondsOf(const std::function<void()>& work);

}  // namespace voledit
