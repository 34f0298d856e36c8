// The editor without a window.

#include "app/editor/platform/painter.h"
#include "app/editor/platform/platform.h"
#include "app/editor/renderer_choice.h"
#include "render/context.h"

namespace voledit {

namespace {

class Offscreen final : public Platform {
public:
    explicit Offscreen(const EditorOptions& options)
        : size_(options.size.value_or(Index2(1280, 800))), gl_(options.gl) {}
    ~Offscreen() override {
        if (context_) context_->makeCurrent();
    }

    float displayScale() const override { return 1; }
    Index2 size() const override { return size_; }

    FrameInput nextFrame(bool, double) override {
        FrameInput input;
        input.size = size_;
        return input;
    }

    // Nothing is drawn before a screenshot; who would draw is known all the same.
    void show(Editor& editor) override {
        const Workspace& workspace = editor.workspace();
        if (!workspace.open || (workspace.compiled.root == seen_ && workspace.renderer == seenChoice_)) return;
        seen_ = workspace.compiled.root;
        seenChoice_ = workspace.renderer;
        const bool wantsRays = workspace.renderer == RendererChoice::Rays;
        const std::string problem = wantsRays ? "" : whySlicesCannotDraw(seen_);
        editor.drawnBy(wantsRays || !problem.empty() ? "rays" : "slices", problem);
    }
    bool refining() const override { return false; }

    Picture screenshot(Editor& editor) override {
        if (!context_) {
            context_ = createOffscreenContext(gl_);
            painter_ = std::make_unique<Painter>(true);
        }
        context_->makeCurrent();
        return painter_->screenshot(editor);
    }

private:
    Index2 size_;
    GlBackend gl_;
    std::unique_ptr<GlContext> context_;  // outlives what was made in it
    std::unique_ptr<Painter> painter_;
    TermPtr seen_;
    RendererChoice seenChoice_ = RendererChoice::Auto;
};

}  // namespace

std::unique_ptr<Platform> makeOffscreen(const EditorOptions& options) {
    return std::make_unique<Offscreen>(options);
}

}  // namespace voledit
