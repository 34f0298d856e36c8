#pragma once
// What becomes of composited colours on their way to a screen or a file: exposure, tone mapping, transparency.

#include <array>

#include "core/base/picture.h"
#include "core/scene/camera.h"

namespace voledit {

/// Colours of the object alone (sRGB values, not multiplied by alpha) through exposure and tone mapping, both on linear
/// light. The filmic curve leaves middle grey (0.18) where it is and takes white to 0.73, so that eight times white is
/// still told from four times (Narkowicz 2015, "ACES filmic tone mapping curve", scaled). From a table, to 1/2000.
class Tones {
public:
    explicit Tones(const RenderSettings& settings);

    /// True where every colour stays as it is, to the bit.
    bool none() const { return none_; }
    float operator()(float color) const;
    /// A pixel whose colour is multiplied by alpha, without background.
    Vec4f operator()(const Vec4f& premultiplied) const;

private:
    static constexpr int kEntries = 4096;
    static constexpr float kLargest = 4;  // what is brighter is as bright as this
    std::array<float, kEntries + 1> table_{};
    bool none_ = false;
};

/// `drawn` as a renderer gives it (background under it), as `settings` want it seen: tones on the object, the
/// background as it was picked. Where `settings.transparent`, the background is left out instead: colours are
/// multiplied by alpha. In parallel.
Picture finishedPicture(Picture drawn, const RenderSettings& settings);

/// A picture of size / `factor` whose pixels are the means of factor × factor. Needs sizes that are multiples.
Picture reduced(Picture picture, int factor);

}  // namespace voledit
