#pragma once
// The viewport's picture: fast while something moves, to full quality by itself when it rests.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/editor/platform/picture_source.h"
#include "app/editor/workspace.h"
#include "render/overlay.h"
#include "render/shader_library.h"

namespace voledit {

/// Needs a current context, the same one for every call and for destruction.
///
/// A change is drawn at once at the finest quality that the time budget has been seen to allow; then better pictures
/// follow in the background, each replacing the one before when it is complete, until one of the viewport's size and
/// the scene's own step is there: the same picture that `voledit render` gives.
class ViewportPicture {
public:
    explicit ViewportPicture(ShaderLibrary& shaders);
    ~ViewportPicture();

    /// How long an update may take, milliseconds.
    struct Budget {
        double refineMs = 25;              // for one step of refining
        std::optional<double> playedMs{};  // of a frame while a scene plays: previews keep to it, nothing is refined
    };
    /// Draws a preview if anything differs from the call before, else goes on refining.
    void update(const CompiledScene& scene, Index2 size, RendererChoice choice, const Budget& budget);
    /// Draws the full-quality picture at once, unless it is there.
    void finish(const CompiledScene& scene, Index2 size, RendererChoice choice);

    /// Puts `overlay` over the picture and gives the texture of both: RGBA8, `size` of the last update.
    GLuint texture(const Overlay& overlay, const Camera& camera);

    bool finished() const { return level_ == 0 && !refining_; }
    /// 0…1 of the way to full quality.
    double progress() const;
    /// What draws now: "slices" or "rays".
    std::string rendererName() const { return rays_ ? "rays" : "slices"; }
    /// Why rays drew where slices were wanted; empty where they were not.
    const std::string& slicesProblem() const { return slicesProblem_; }
    /// True if the last update drew a preview of something new.
    bool changed() const { return changed_; }

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

    void ensureTargets(Index2 size);
    bool wantRays(const CompiledScene& scene, RendererChoice choice);
    void measureSources(const CompiledScene& scene);
    double drawLevel(PictureSource& source, const CompiledScene& scene, int level);
    void begin(PictureSource& source, const CompiledScene& scene, int level);
    void present(const SourceTexture& texture);
    double drawOrLeaveToRays(const CompiledScene& scene, int level);
    void drawPreview(const CompiledScene& scene, const Budget& budget);
    PictureSource& source(bool rays);

    ShaderLibrary& shaders_;
    std::unique_ptr<PictureSource> sources_[2];  // slices, rays; made when first needed
    OverlayRenderer overlays_;
    VertexArray noVertices_;
    struct Samplers;
    std::unique_ptr<Samplers> samplers_;

    std::optional<Wanted> wanted_;
    Index2 size_{0};
    Texture base_, shown_;
    Framebuffer baseTarget_, shownTarget_;
    Vec3f background_{0};
    bool rays_ = false;
    std::string slicesProblem_;
    bool changed_ = false;
    bool refining_ = false;  // a source is working on `working_`
    int level_ = 0;          // of the picture in base_; 0 is full quality
    int working_ = 0;
    int previewLevel_[2] = {3, 3};          // for each source: what the budget has been seen to allow
    std::vector<const void*> measuredFor_;  // what the choice between the sources was made for
    bool raysAreFaster_ = true;
};

}  // namespace voledit
