#include "app/cli/drawing.h"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <sstream>

#include "app/cli/arguments.h"
#include "core/base/error.h"
#include "core/eval/ray_caster.h"
#include "core/rays/ray_renderer.h"
#include "core/scene/actor_edits.h"
#include "core/scene/nodes.h"
#include "core/scene/scene_children.h"
#include "core/scene/tones.h"
#include "render/context.h"
#include "render/slice_renderer.h"

namespace voledit {

namespace {

class RayDrawing final : public Drawing {
public:
    Picture draw(const CompiledScene& scene, Index2 size, Progress* progress) override {
        renderer_.begin(scene, size);
        while (!renderer_.advance(progress ? 200 : 0)) report(progress, renderer_.progress());
        return renderer_.picture();
    }
    DrawStatistics statistics() const override { return {.slices = 0, .samples = renderer_.samples(), .cells = 0}; }
    std::string renderer() const override { return "rays"; }
    std::string gl() const override { return ""; }

private:
    RayRenderer renderer_;
};

/// The oracle: plain rays in double precision.
class ReferenceDrawing final : public Drawing {
public:
    Picture draw(const CompiledScene& scene, Index2 size, Progress* progress) override {
        rays_ = {};
        return castRays(scene, size, &rays_, progress);
    }
    DrawStatistics statistics() const override { return {.slices = 0, .samples = rays_.samples, .cells = 0}; }
    std::string renderer() const override { return "reference"; }
    std::string gl() const override { return ""; }

private:
    RayStatistics rays_;
};

class SliceDrawing final : public Drawing {
public:
    SliceDrawing(GlBackend backend, bool orRays)
        : context_(createOffscreenContext(backend)), slices_(new SliceRenderer), orRays_(orRays) {}

    Picture draw(const CompiledScene& scene, Index2 size, Progress* progress) override {
        byRays_ = false;
        try {
            slices_->begin(scene, size);
        } catch (const Error& error) {
            if (!orRays_) throw;
            if (!std::exchange(warned_, true)) printWarnings({std::string(error.what()) + " (drawn by rays)"});
            byRays_ = true;
            return rays_.draw(scene, size, progress);
        }
        if (!slices_->notices().empty() && !std::exchange(noticed_, true)) printWarnings(slices_->notices());
        while (!slices_->advance(progress ? 200 : 0)) report(progress, slices_->progress());
        return slices_->readBack();
    }
    DrawStatistics statistics() const override {
        if (byRays_) return rays_.statistics();
        const SliceStatistics& s = slices_->statistics();
        return {.slices = s.slices, .samples = 0, .cells = s.cells};
    }
    std::string renderer() const override { return byRays_ ? "rays" : "slices"; }
    std::string gl() const override { return byRays_ ? "" : context_->name(); }

private:
    std::unique_ptr<GlContext> context_;
    std::unique_ptr<SliceRenderer> slices_;  // goes before its context
    bool orRays_;
    RayDrawing rays_;
    bool noticed_ = false;
    bool byRays_ = false, warned_ = false;  // whether the last picture was drawn by rays; whether that was ever said
};

/// The outermost STF of `object`, for changing; follows `use`. Null where there is none.
Transfer* outermost(Scene& scene, ObjectRef& object) {
    if (auto* use = std::get_if<ObjectUse>(&object->kind) ? &std::get<ObjectUse>(object.edit().kind) : nullptr)
        return outermost(scene, scene.objects.at(use->name));
    if (std::holds_alternative<PlaceObject>(object->kind))
        return outermost(scene, std::get<PlaceObject>(object.edit().kind).of);
    if (!std::holds_alternative<TransferObject>(object->kind)) return nullptr;
    auto& transfers = std::get<TransferObject>(object.edit().kind);
    if (transfers.by.empty()) return outermost(scene, transfers.of);
    SharedValue<Transfer>* last = &transfers.by.back();
    while (const auto* use = std::get_if<TransferUse>(&(*last)->kind)) last = &scene.transfers.at(use->name);
    return &last->edit();
}

}  // namespace

void checkDrawingNames(const std::string& renderer, const std::string& gl) {
    if (!renderer.empty() && renderer != "slices" && renderer != "rays" && renderer != "reference")
        throw UsageError("--renderer " + renderer + ": there are slices, rays and reference");
    if (gl != "auto" && gl != "egl" && gl != "osmesa")
        throw UsageError("--gl " + gl + ": there are auto, egl and osmesa");
}

std::unique_ptr<Drawing> makeDrawing(const std::string& renderer, const std::string& gl) {
    checkDrawingNames(renderer, gl);
    if (renderer == "rays") return std::make_unique<RayDrawing>();
    if (renderer == "reference") return std::make_unique<ReferenceDrawing>();
    const GlBackend backend = gl == "egl" ? GlBackend::Egl : gl == "osmesa" ? GlBackend::Osmesa : GlBackend::Auto;
    return std::make_unique<SliceDrawing>(backend, renderer.empty());
}

Picture drawStill(Drawing& drawing, const CompiledScene& scene, Index2 size, int supersample, Progress* progress) {
    return finishedPicture(reduced(drawing.draw(scene, size * supersample, progress), supersample), scene.render);
}

Camera orbited(const Camera& camera, double degrees) {
    Camera turned = camera;
    const Mat4 turn = glm::rotate(Mat4(1), glm::radians(degrees), camera.up);
    turned.eye = camera.target + transformVector(turn, camera.eye - camera.target);
    return turned;
}

void nudgeOutermost(Scene& scene, double length) {
    if (const auto actors = actorPaths(scene); !actors.empty() && actors.front() == followedUse(scene, kRootPath)) {
        editRig(scene, actors.front(),
                [&](ActorRig& rig) { rig.skeleton.fit.translate = *rig.skeleton.fit.translate + Vec3(length, 0, 0); });
        return;
    }
    Transfer* transfer = outermost(scene, scene.root);
    if (!transfer) throw Error("--time-edits: the scene's root has no transfer to edit; add a lattice first");
    if (auto* ffd = std::get_if<FfdTransfer>(&transfer->kind)) {
        const std::size_t last =
            std::size_t(ffd->points.x) * std::size_t(ffd->points.y) * std::size_t(ffd->points.z) - 1;
        auto& vector = ffd->moves[last].vector;
        vector = *vector + Vec3(length, 0, 0);
        return;
    }
    if (auto* affine = std::get_if<AffineTransfer>(&transfer->kind); affine && affine->placement.matrix) {
        Mat4 matrix = *affine->placement.matrix;
        matrix[3].x += length;
        affine->placement.matrix = matrix;
        return;
    }
    bool first = true;
    const auto nudge = [&]<class T>(const ValueName&, T& value) {
        if constexpr (!std::is_same_v<T, TrackedFrame>) {
            auto numbers = numbersOf(*value);
            if (numbers.empty() || !std::exchange(first, false)) return;
            numbers[0] += length;
            auto changed = *value;
            setNumbers(changed, numbers);
            value = std::move(changed);
        }
    };
    std::visit([&](auto& kind) { visitTrackedOfKind(kind, nudge); }, transfer->kind);
}

double millisecondsSinceStart() {
    // Field 22 of /proc/self/stat, counted behind the name's closing bracket, is the start in clock ticks since boot.
    std::ifstream file("/proc/self/stat");
    std::string text((std::istreambuf_iterator<char>(file)), {});
    std::istringstream fields(text.substr(text.rfind(')') + 1));
    std::string field;
    for (int i = 3; i <= 22; ++i) fields >> field;
    timespec now{};
    clock_gettime(CLOCK_BOOTTIME, &now);
    const double started = std::stod(field) / static_cast<double>(sysconf(_SC_CLK_TCK));
    return (static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9 - started) * 1e3;
}

double peakMebibytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

double millisecondsOf(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace voledit
