#pragma once
// The viewport's picture: fast while something moves, to full quality by itself when it rests.

#include <memory>
#include <optional>
#include <string>

#include "app/editor/platform/picture_schedule.h"
#include "app/editor/workspace.h"
#include "render/overlay.h"
#include "render/shader_library.h"

namespace voledit {

/// True where the current context draws on the CPU.
bool softwareGl();

/// Needs a current context, the same one for every call and for destruction. PictureSchedule says what is drawn when;
/// this puts it, of whatever resolution, into a texture of the viewport's size.
class ViewportPicture {
public:
    /// `headless`: nothing may depend on time, and `auto` means slices.
    ViewportPicture(ShaderLibrary& shaders, bool headless);
    ~ViewportPicture();

    /// Draws a preview if anything differs from the call before, else goes on refining. True where the picture is a new
    /// one.
    bool update(const CompiledScene& scene, Index2 size, RendererChoice choice, const PictureSchedule::Frame& frame);
    /// Draws the full-quality picture at once, unless it is there.
    void finish(const CompiledScene& scene, Index2 size, RendererChoice choice);

    /// Puts `overlay` over the picture and gives a framebuffer with both, of the size of the last update.
    GLuint framebuffer(const Overlay& overlay, const Camera& camera);

    const PictureSchedule& schedule() const { return schedule_; }
    /// "slices" or "rays".
    std::string rendererName() const { return schedule_.rays() ? "rays" : "slices"; }

private:
    void ensureTargets(Index2 size);
    void present(const RenderSettings& settings);
    void presentTexture(const RenderSettings& settings);

    ShaderLibrary& shaders_;
    bool softwareGl_;
    PictureSchedule schedule_;
    OverlayRenderer overlays_;
    VertexArray noVertices_;
    struct Samplers;
    std::unique_ptr<Samplers> samplers_;
    Index2 size_{0};
    std::vector<std::uint8_t> bytes_;  // of the picture, enlarged
    Texture base_, shown_;
    Framebuffer baseTarget_, shownTarget_;
};

}  // namespace voledit
