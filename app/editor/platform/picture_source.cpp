#include "app/editor/platform/picture_source.h"

#include "core/rays/ray_renderer.h"

namespace voledit {

namespace {

class SliceSource final : public PictureSource {
public:
    void begin(const CompiledScene& scene, Index2 size, double stepScale) override {
        renderer_.begin(scene, size, stepScale);
    }
    bool advance(double budgetMs) override { return renderer_.advance(budgetMs); }
    double progress() const override { return renderer_.progress(); }
    SourceTexture texture() override { return {.name = renderer_.texture(), .flipped = false, .opaque = false}; }

private:
    SliceRenderer renderer_;
};

class RaySource final : public PictureSource {
public:
    void begin(const CompiledScene& scene, Index2 size, double stepScale) override {
        renderer_.begin(scene, size, {.stepScale = stepScale, .moving = stepScale > 1});
        if (size_ != size) {
            size_ = size;
            texture_ = makeTexture2D(GL_RGBA32F, size);
        }
        uploaded_ = false;
    }
    bool advance(double budgetMs) override { return renderer_.advance(budgetMs); }
    double progress() const override { return renderer_.progress(); }

    SourceTexture texture() override {
        if (!uploaded_)
            glTextureSubImage2D(texture_.name(), 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT,
                                renderer_.picture().pixels.data());
        uploaded_ = true;
        return {.name = texture_.name(), .flipped = true, .opaque = true};
    }

private:
    RayRenderer renderer_;
    Texture texture_;
    Index2 size_{0, 0};
    bool uploaded_ = false;
};

}  // namespace

std::unique_ptr<PictureSource> makeSliceSource() {
    return std::make_unique<SliceSource>();
}
std::unique_ptr<PictureSource> makeRaySource() {
    return std::make_unique<RaySource>();
}

}  // namespace voledit
