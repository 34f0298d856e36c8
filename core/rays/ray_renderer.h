#pragma once
// Pictures by rays on the CPU, fast: what draws wherever "rays" are asked for. The reference is eval/ray_caster.

#include <memory>

#include "core/base/picture.h"
#include "core/scene/compile.h"

namespace voledit {

/// Draws compiled scenes a little at a time, on all cores. Keeps what does not change from picture to picture, found by
/// comparing. Every term is drawn: a volume under maps in packets of rays, any other by blocks of samples.
class RayRenderer {
public:
    struct Options {
        double stepScale = 1;  // steps are so many times longer than the scene's own
        bool moving = false;   // chains of maps may be followed less closely: edits count for more
    };

    RayRenderer();
    ~RayRenderer();
    RayRenderer(RayRenderer&&) noexcept;
    RayRenderer& operator=(RayRenderer&&) noexcept;

    /// Starts a picture of `size` pixels; what was unfinished is dropped.
    void begin(const CompiledScene& scene, Index2 size, const Options& options);
    void begin(const CompiledScene& scene, Index2 size) { begin(scene, size, Options()); }
    /// Works for about `budgetMs` (≤ 0: to the end). True when the picture is complete.
    bool advance(double budgetMs);
    /// 0…1 of the picture is drawn.
    double progress() const;
    /// The picture; pixels that are not drawn yet hold the background. The same, to the bit, for every number of
    /// threads and however advance() cut it up.
    const Picture& picture() const;
    /// Samples taken for this picture so far.
    std::uint64_t samples() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace voledit
