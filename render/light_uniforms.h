#pragma once
// A scene's lights and surroundings as shaders/common/lighting.glsl and surroundings.glsl take them.

#include <memory>

#include "core/eval/surroundings.h"
#include "render/gl_objects.h"
#include "render/view.h"

namespace voledit {

void setLights(Program& program, const RenderSettings& settings, const Lights& lights);

/// What surroundings look up, on the GPU; uploaded only when it is another one.
class SurroundingsTexture {
public:
    /// Throws Error where the GPU's memory is too small.
    void prepare(const Surroundings& surroundings);
    /// Sets the uniforms of programs with SURROUNDINGS. Depths count from `referenceDepth` (shaders/slice.vert).
    void setUniforms(Program& program, const RenderSettings& settings, const View& view, double referenceDepth) const;
    void bind() const;

private:
    void uploadGrid(const OpacityGrid& grid);

    std::shared_ptr<const OpacityGrid> grid_;
    std::shared_ptr<const Openness> openness_;
    std::shared_ptr<const ShadowVolume> shadows_;
    Vec3f towardFirst_{0};
    Texture alpha_, clearance_, open_, left_;
};

}  // namespace voledit
