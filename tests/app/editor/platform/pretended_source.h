#pragma once
// A renderer that only lets time pass.

#include <algorithm>

#include "app/editor/platform/picture_source.h"
#include "core/base/error.h"

namespace voledit::test {

/// What was asked of it, and what it costs, milliseconds.
struct Pretence {
    double rate = 20;    // a million pixels × steps
    double setup = 0.5;  // each picture
    double first = 0;    // the first picture, besides
    double piece = 1;    // it does not stop within
    bool movingDiffers = false, refuses = false;
    int begun = 0, completed = 0;
    Index2 size{0};
    PictureEffort effort;
};

class PretendedSource final : public PictureSource {
public:
    PretendedSource(Pretence& pretence, double& now) : pretence_(pretence), now_(now) {}

    void begin(const CompiledScene& scene, Index2 size, const PictureEffort& effort) override {
        if (pretence_.refuses) throw Error("it cannot draw this; use rays");
        now_ += pretence_.setup + (pretence_.begun++ == 0 ? pretence_.first : 0);
        pretence_.size = size;
        pretence_.effort = effort;
        whole_ = 1e-6 * size.x * size.y / (scene.render.step * effort.step) * pretence_.rate;
        left_ = whole_;
    }
    bool advance(double budgetMs) override {
        const double pieces = std::max(1.0, std::ceil(budgetMs / pretence_.piece));
        const double works = budgetMs <= 0 ? left_ : std::min(left_, pieces * pretence_.piece);
        now_ += works;
        left_ -= works;
        if (left_ <= 1e-9 && works > 0) ++pretence_.completed;
        return left_ <= 1e-9;
    }
    double progress() const override { return whole_ > 0 ? 1 - left_ / whole_ : 1; }
    bool movingDiffers() const override { return pretence_.movingDiffers; }
    SourceTexture texture() override { return {}; }
    const Picture& picture() override { return picture_; }

private:
    Pretence& pretence_;
    double& now_;
    double whole_ = 0, left_ = 0;
    Picture picture_;
};

}  // namespace voledit::test
