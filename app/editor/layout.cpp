#include "app/editor/layout.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace voledit {

namespace {

constexpr float kMenuHeight = 30, kStatusHeight = 26, kPanelWidth = 330;

int pixels(float design, float scale) {
    return int(std::lround(design * scale));
}

}  // namespace

Layout layoutOf(Index2 window, float scale, float timeHeight) {
    const int menu = pixels(kMenuHeight, scale), status = pixels(kStatusHeight, scale);
    // A narrow window keeps more than half of its width for the picture.
    const int panels = std::min(pixels(kPanelWidth, scale), 9 * window.x / 20);
    const int height = std::max(1, window.y - menu - status);
    const int time = std::clamp(pixels(timeHeight, scale), 0, 3 * height / 5);
    const Index2 view = glm::max(Index2(window.x - panels, height - time), Index2(1));
    return {.menu = {{0, 0}, {std::max(1, window.x), menu}},
            .view = {{0, menu}, view},
            .time = {{0, menu + view.y}, {view.x, std::max(1, time)}},
            .panels = {{view.x, menu}, {std::max(1, panels), height}},
            .status = {{0, menu + height}, {std::max(1, window.x), status}}};
}

}  // namespace voledit
