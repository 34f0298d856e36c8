#include "core/rays/ray_renderer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/rays/tile_caster.h"

namespace voledit {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTile = 16;  // pixels: a whole number of packets of every shape

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

struct RayRenderer::State {
    RayCache cache;
    std::unique_ptr<const TileCaster> caster;
    Picture picture;
    Index2 tiles{0};
    std::size_t next = 0;      // tile
    std::size_t portion = 32;  // tiles drawn between two looks at the clock
    std::atomic<std::uint64_t> samples{0};

    std::size_t count() const { return std::size_t(tiles.x) * std::size_t(tiles.y); }

    void draw(std::size_t end) {
        parallelFor(end - next, 1, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = next + from; n < next + to; ++n) {
                const Index2 first = kTile * Index2(int(n) % tiles.x, int(n) / tiles.x);
                samples += caster->cast(picture, first, glm::min(first + kTile, picture.size));
            }
        });
        next = end;
    }
};

RayRenderer::RayRenderer() : state_(std::make_unique<State>()) {}
RayRenderer::~RayRenderer() = default;
RayRenderer::RayRenderer(RayRenderer&&) noexcept = default;
RayRenderer& RayRenderer::operator=(RayRenderer&&) noexcept = default;

void RayRenderer::begin(const CompiledScene& scene, Index2 size, const Options& options) {
    CompiledScene scaled = scene;
    scaled.render.step *= options.stepScale;
    State& s = *state_;
    s.picture = Picture(size, Vec4f(Vec3f(scene.render.background), 0));
    s.tiles = (size + kTile - 1) / kTile;
    s.next = 0;
    s.samples = 0;
    s.caster = makeTileCaster(scaled, size, s.cache, options.moving);
}

bool RayRenderer::advance(double budgetMs) {
    State& s = *state_;
    const Clock::time_point start = Clock::now();
    while (s.next < s.count()) {
        const Clock::time_point portionStart = Clock::now();
        const std::size_t portion = budgetMs > 0 ? s.portion : s.count();
        s.draw(std::min(s.next + portion, s.count()));
        if (budgetMs <= 0) continue;
        // Portions of some 4 ms: short against a frame, long against the cost of starting threads.
        const double took = millisecondsSince(portionStart);
        if (took > 6) s.portion = std::max<std::size_t>(8, s.portion / 2);
        if (took < 2) s.portion = std::min<std::size_t>(4096, s.portion * 2);
        if (millisecondsSince(start) >= budgetMs) break;
    }
    return s.next >= s.count();
}

double RayRenderer::progress() const {
    return state_->count() ? double(state_->next) / double(state_->count()) : 1;
}

const Picture& RayRenderer::picture() const {
    return state_->picture;
}

std::uint64_t RayRenderer::samples() const {
    return state_->samples;
}

}  // namespace voledit
