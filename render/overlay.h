#pragma once
// Lines and points over a picture: lattices, boxes, axes. Colours are sRGB with straight alpha.

#include <memory>
#include <vector>

#include "core/base/types.h"
#include "core/scene/camera.h"

namespace voledit {

struct OverlayLine {
    Vec3 from, to;  // world units
    Vec4f color;
    float width = 1;  // pixels
};

struct OverlayPoint {
    Vec3 at;  // world units
    Vec4f color;
    float radius = 4;  // pixels
    Vec4f ring{0};     // outline
};

struct Overlay {
    std::vector<OverlayLine> lines;
    std::vector<OverlayPoint> points;
};

/// Draws `overlay` with antialiased edges over the currently bound framebuffer, whose viewport is `size` pixels from
/// (0, 0).
class OverlayRenderer {
public:
    OverlayRenderer();
    ~OverlayRenderer();
    OverlayRenderer(const OverlayRenderer&) = delete;
    OverlayRenderer& operator=(const OverlayRenderer&) = delete;

    void draw(const Overlay& overlay, const Camera& camera, Index2 size);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace voledit
