#pragma once
// OpenGL slices through mapped cells: view-aligned planes cut the deformed tetrahedra, polygon vertices carry source
// coordinates, slices are composited front to back in float (architecture.md, "Rendering by slices").

#include <memory>
#include <string>
#include <vector>

#include "core/base/picture.h"
#include "core/scene/compile.h"
#include "render/overlay.h"

namespace voledit {

struct SliceStatistics {
    int slices = 0;
    std::uint64_t polygons = 0;
    std::size_t cells = 0;             // tetrahedra cut
    std::size_t culledCells = 0;       // tetrahedra that cannot be seen
    std::size_t programsCompiled = 0;  // since the renderer was made
};

/// How slices are made; the defaults are what pictures are drawn with, the rest is for tests and measurements.
struct SliceOptions {
    bool march = true;   // walk rays within fragments where a term lets them (march_plan.h), instead of cutting slices
    bool cull = true;    // leave out cells that cannot be seen
    bool mask = true;    // stop at pixels that are nearly opaque
    int segments = 2;    // steps that one slice stands for: a slab is so many steps thick
    int subsamples = 2;  // points of each step that are classified, between the scalars at its ends
    int largestTexture = 0;  // voxels along an axis that volumes may have; 0: what OpenGL allows
};

/// Draws compiled scenes with the current GL context. Keeps textures and programs between pictures and uploads only
/// what changed (it compares the immutable pieces by address). A picture may be spread over several calls.
class SliceRenderer {
public:
    /// Needs a current context, the same one for every later call and for destruction. Throws Error where a shader
    /// does not compile.
    explicit SliceRenderer(const SliceOptions& options = {});
    ~SliceRenderer();
    SliceRenderer(const SliceRenderer&) = delete;
    SliceRenderer& operator=(const SliceRenderer&) = delete;

    /// Starts a picture of `size` pixels with steps of `scene.stepLength() * stepScale`. What was unfinished is
    /// dropped. Throws Error for a term that slices cannot draw, saying to use rays.
    /// @param moving  it is seen for a moment: maps may be baked coarsely, whatever their error
    void begin(const CompiledScene& scene, Index2 size, double stepScale = 1, bool moving = false);
    /// Draws slices, front to back, for about `budgetMs` (≤ 0: all). True when the picture is complete.
    bool advance(double budgetMs);
    /// 0…1 of the slices of this picture are drawn.
    double progress() const;

    /// RGBA32F texture, premultiplied by alpha, background not yet under it, as far as drawn (row 0 at the bottom, as
    /// GL has it). Valid until the next begin() of another size.
    unsigned texture() const;

    /// Reads the picture back and puts the background under it.
    Picture readBack() const;

    const SliceStatistics& statistics() const;
    /// What the picture that begin() started lacks, a line each: volumes too large for OpenGL are drawn reduced.
    const std::vector<std::string>& notices() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// begin, advance(0), readBack.
Picture renderSlices(SliceRenderer& renderer, const CompiledScene& scene, Index2 size);

}  // namespace voledit
