#include "app/editor/platform/picture_source.h"

#include <algorithm>
#include <chrono>

#include "core/eval/ray_caster.h"

namespace voledit {

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

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
        scene_ = scene;
        scene_.render.step *= stepScale;
        if (picture_.size != size) {
            picture_ = Picture(size);
            texture_ = makeTexture2D(GL_RGBA32F, size);
        }
        row_ = 0;
        uploaded_ = false;
    }

    bool advance(double budgetMs) override {
        const Clock::time_point start = Clock::now();
        while (row_ < picture_.size.y) {
            const int last = std::min(row_ + rows_, picture_.size.y);
            const Clock::time_point chunk = Clock::now();
            castRows(scene_, picture_, row_, last, nullptr);
            row_ = last;
            adapt(millisecondsSince(chunk));
            if (budgetMs > 0 && millisecondsSince(start) >= budgetMs) break;
        }
        return row_ >= picture_.size.y;
    }

    double progress() const override { return picture_.size.y > 0 ? double(row_) / picture_.size.y : 1; }

    SourceTexture texture() override {
        if (!uploaded_)
            glTextureSubImage2D(texture_.name(), 0, 0, 0, picture_.size.x, picture_.size.y, GL_RGBA, GL_FLOAT,
                                picture_.pixels.data());
        uploaded_ = true;
        return {.name = texture_.name(), .flipped = true, .opaque = true};
    }

private:
    // Chunks of about 8 ms: short against a frame, long against the cost of starting threads.
    void adapt(double milliseconds) {
        if (milliseconds > 12)
            rows_ = std::max(2, rows_ / 2);
        else if (milliseconds < 4)
            rows_ = std::min(256, rows_ * 2);
    }

    CompiledScene scene_;
    Picture picture_;
    Texture texture_;
    int row_ = 0, rows_ = 8;
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
