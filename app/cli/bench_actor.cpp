#include "app/cli/bench_actor.h"

#include <algorithm>
#include <cmath>

#include "app/cli/bench_measure.h"
#include "core/eval/term_path.h"
#include "core/eval/voxelise.h"

namespace voledit {

namespace {

using Json = nlohmann::ordered_json;

/// The volume that a program without deformations would make for this frame: scalars on cubes of the source's
/// smallest spacing over the root's box.
CompiledScene revoxelised(const CompiledScene& scene, const VolumeTerm& source) {
    const Vec3 extent = scene.root->bounds.size();
    Index3 cells;
    for (int i = 0; i < 3; ++i) cells[i] = std::max(1, int(std::ceil(extent[i] / scene.unitStep)));
    VoxeliseRequest request;
    request.grid = cellCentredGrid(scene.root->bounds, cells, 1);
    request.what = VoxeliseWhat::Scalar;
    request.type = source.volume->type();
    CompiledScene copy = scene;
    copy.root = makeVolumeTerm(voxelise(scene, request), 0, source.appearance, source.interpolation);
    return copy;
}

}  // namespace

Json benchPlaying(Drawing& drawing, const OpenedScene& opened, Index2 size, int frames) {
    const Timeline& timeline = opened.scene.timeline;
    const double aspect = double(size.x) / size.y;
    const auto timeOf = [&](int n) {
        return (timeline.start + n % std::max(1, timeline.end - timeline.start)) / timeline.fps;
    };
    CompiledScene compiled = compile(opened.scene, opened.assets, timeOf(0), nullptr, aspect);
    drawing.draw(compiled, size, nullptr);
    const Term* source = oneSourceOf(*compiled.root);
    const auto* volume = source ? std::get_if<VolumeTerm>(&source->node) : nullptr;
    std::vector<double> compiling, drawn, direct, voxelising, resampled;
    for (int n = 1; n <= frames; ++n) {
        compiling.push_back(
            millisecondsOf([&] { compiled = compile(opened.scene, opened.assets, timeOf(n), &compiled, aspect); }));
        drawn.push_back(millisecondsOf([&] { drawing.draw(compiled, size, nullptr); }));
        direct.push_back(compiling.back() + drawn.back());
        if (!volume) continue;
        CompiledScene copy;
        voxelising.push_back(millisecondsOf([&] { copy = revoxelised(compiled, *volume); }));
        resampled.push_back(voxelising.back() + millisecondsOf([&] { drawing.draw(copy, size, nullptr); }));
    }
    Json json = {{"frames", frames},
                 {"compile_ms", medianOf(compiling)},
                 {"draw_ms", medianOf(drawn)},
                 {"frame_ms", medianOf(direct)},
                 {"frames_per_second", 1000 / medianOf(direct)}};
    if (volume) {
        json["voxelise_ms"] = medianOf(voxelising);
        json["revoxelised_frame_ms"] = medianOf(resampled);
        json["revoxelised_over_direct"] = medianOf(resampled) / medianOf(direct);
    }
    return json;
}

}  // namespace voledit
