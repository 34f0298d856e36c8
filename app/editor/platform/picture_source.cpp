#include "app/editor/platform/picture_source.h"

#include "core/rays/ray_renderer.h"

namespace voledit {

namespace {

class SliceSource final : public PictureSource {
public:
    void begin(const CompiledScene& scene, Index2 size, const PictureEffort& effort) override {
        renderer_.begin(scene, size, effort.step, effort.moving);
    }
    bool advance(double budgetMs) override { return renderer_.advance(budgetMs); }
    double progress() const override { return renderer_.progress(); }
    bool movingDiffers() const override { return true; }
    std::vector<std::string> notices() const override { return renderer_.notices(); }
    SourceTexture texture() override { return {.name = renderer_.texture(), .flipped = false, .opaque = false}; }
    const Picture& picture() override { return picture_ = renderer_.readBack(); }

private:
    SliceRenderer renderer_;
    Picture picture_;
};

class RaySource final : public PictureSource {
public:
    void begin(const CompiledScene& scene, Index2 size, const PictureEffort& effort) override {
        renderer_.begin(scene, size, {.stepScale = effort.step, .moving = effort.moving});
        uploaded_ = false;
    }
    bool advance(double budgetMs) override { return renderer_.advance(budgetMs); }
    double progress() const override { return renderer_.progress(); }
    bool movingDiffers() const override { return true; }

    SourceTexture texture() override {
        const Picture& picture = renderer_.picture();
        if (!texture_ || size_ != picture.size) texture_ = makeTexture2D(GL_RGBA32F, size_ = picture.size);
        if (!uploaded_)
            glTextureSubImage2D(texture_.name(), 0, 0, 0, size_.x, size_.y, GL_RGBA, GL_FLOAT, picture.pixels.data());
        uploaded_ = true;
        return {.name = texture_.name(), .flipped = true, .opaque = true};
    }
    const Picture& picture() override { return renderer_.picture(); }

private:
    RayRenderer renderer_;
    Texture texture_;
    Index2 size_{0};
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
