#include "render/overlay.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/paths.h"
#include "render/gl_objects.h"
#include "render/gl_state.h"
#include "render/shader_library.h"
#include "render/view.h"

namespace voledit {

namespace {

constexpr float kRingWidth = 1.5F;

/// One corner of the rectangle about a line, as overlay.vert takes it.
struct Corner {
    Vec2f position;
    Vec4f ends;
    Vec2f radii;
    Vec4f fill, ring;
};

struct Segment {
    Vec2 from, to;
};

/// The part of a view-space line (view.h) in front of the eye, in window coordinates; nullopt where nothing is.
std::optional<Segment> projected(Vec3 from, Vec3 to, Index2 size) {
    // Close before the eye a point has no place in the picture any more; the line is cut there.
    const double nearest = 1e-6 * std::max({std::abs(from.z), std::abs(to.z), 1e-30});
    if (from.z < nearest && to.z < nearest) return std::nullopt;
    if (from.z < nearest) from += (to - from) * ((nearest - from.z) / (to.z - from.z));
    if (to.z < nearest) to += (from - to) * ((nearest - to.z) / (from.z - to.z));
    const auto window = [&](const Vec3& p) { return (Vec2(p) / p.z + 1.0) / 2.0 * Vec2(size); };
    return Segment{window(from), window(to)};
}

/// The part of `segment` within the picture and `margin` pixels about it [Liang, Barsky 1984], so that coordinates stay
/// small enough for floats.
std::optional<Segment> clipped(const Segment& segment, Index2 size, double margin) {
    double first = 0, last = 1;
    const Vec2 along = segment.to - segment.from;
    for (int a = 0; a < 2; ++a)
        for (const double side : {-1.0, 1.0}) {
            const double limit = side < 0 ? margin : size[a] + margin;
            const double rest = limit - side * segment.from[a], rate = side * along[a];
            if (rate == 0 && rest < 0) return std::nullopt;
            if (rate > 0) last = std::min(last, rest / rate);
            if (rate < 0) first = std::max(first, rest / rate);
        }
    if (first > last) return std::nullopt;
    return Segment{segment.from + first * along, segment.from + last * along};
}

void append(std::vector<Corner>& corners, const Segment& segment, Index2 size, const Corner& style) {
    const double radius = std::max(style.radii.x, style.radii.y) + 1;
    const Vec2 along = segment.to - segment.from;
    const double length = std::sqrt(along.x * along.x + along.y * along.y);
    const Vec2 ahead = length > 1e-9 ? along / length : Vec2(1, 0), across(-ahead.y, ahead.x);
    std::array<Corner, 4> four;
    for (int n = 0; n < 4; ++n) {
        const Vec2 end = n & 1 ? segment.to + radius * ahead : segment.from - radius * ahead;
        const Vec2 at = end + (n & 2 ? radius : -radius) * across;
        four[std::size_t(n)] = style;
        four[std::size_t(n)].position = Vec2f(at / Vec2(size) * 2.0 - 1.0);
        four[std::size_t(n)].ends = Vec4f(segment.from.x, segment.from.y, segment.to.x, segment.to.y);
    }
    for (const int n : {0, 1, 2, 2, 1, 3}) corners.push_back(four[std::size_t(n)]);
}

std::vector<Corner> cornersOf(const Overlay& overlay, const View& view) {
    std::vector<Corner> corners;
    const auto add = [&](const Vec3& from, const Vec3& to, const Corner& style) {
        const auto whole = projected(view.viewFromWorld(from), view.viewFromWorld(to), view.size);
        if (!whole) return;
        const auto part = clipped(*whole, view.size, std::max(style.radii.x, style.radii.y) + 2);
        if (part) append(corners, *part, view.size, style);
    };
    for (const OverlayLine& line : overlay.lines)
        add(line.from, line.to, {{}, {}, {line.width / 2, line.width / 2}, line.color, {}});
    for (const OverlayPoint& point : overlay.points) {
        const float ring = point.ring.a > 0 ? kRingWidth : 0;
        add(point.at, point.at, {{}, {}, {point.radius, point.radius + ring}, point.color, point.ring});
    }
    return corners;
}

}  // namespace

struct OverlayRenderer::State {
    ShaderLibrary shaders{shaderFolder()};
    Buffer corners = makeBuffer();
    VertexArray array = makeVertexArray();
};

OverlayRenderer::OverlayRenderer() : state_(std::make_unique<State>()) {
    const GLuint array = state_->array.name();
    glVertexArrayVertexBuffer(array, 0, state_->corners.name(), 0, sizeof(Corner));
    floatAttribute(state_->array, 0, 2, offsetof(Corner, position));
    floatAttribute(state_->array, 1, 4, offsetof(Corner, ends));
    floatAttribute(state_->array, 2, 2, offsetof(Corner, radii));
    floatAttribute(state_->array, 3, 4, offsetof(Corner, fill));
    floatAttribute(state_->array, 4, 4, offsetof(Corner, ring));
}

OverlayRenderer::~OverlayRenderer() = default;

void OverlayRenderer::draw(const Overlay& overlay, const Camera& camera, Index2 size) {
    const std::vector<Corner> corners = cornersOf(overlay, makeView(camera, size));
    if (corners.empty()) return;
    const GlStateGuard guard;
    fill(state_->corners, std::span(corners));
    state_->shaders.get({"overlay.vert", "overlay.frag", {}}).use();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(state_->array.name());
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(corners.size()));
}

}  // namespace voledit
