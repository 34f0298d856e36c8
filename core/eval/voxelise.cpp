#include "core/eval/voxelise.h"

#include <algorithm>
#include <atomic>
#include <cassert>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/eval/rounded.h"
#include "core/eval/term_path.h"
#include "core/eval/voxelise_chain.h"
#include "core/fields/voxel_type.h"

namespace voledit {

namespace {

int channelsOf(VoxeliseWhat what) {
    return what == VoxeliseWhat::Rgba ? 4 : what == VoxeliseWhat::Displacement ? 3 : 1;
}

/// Values of grid samples, `channels` for each point, as doubles.
class Evaluator {
public:
    Evaluator(const CompiledScene& scene, const VoxeliseRequest& request)
        : root_(*scene.root), request_(request), outermost_(outermostTransfer(root_)) {
        if (request.what == VoxeliseWhat::Displacement && outermost_.list.empty())
            throw Error("voxelize --what displacement", "the scene's root holds no transfer",
                        "add one outside of any union, intersection or other operator, or ask for scalar, opacity or "
                        "rgba");
    }

    void operator()(std::span<const Vec3> p, std::span<double> values) const {
        if (request_.what == VoxeliseWhat::Displacement) return displacement(p, values);
        std::vector<ObjectSample> samples(p.size());
        sample(root_, p, samples, false, request_.what == VoxeliseWhat::Scalar ? "scalar" : "");
        for (std::size_t i = 0; i < p.size(); ++i) {
            const ObjectSample& s = samples[i];
            if (request_.what == VoxeliseWhat::Scalar) {
                values[i] = s.value == s.value ? s.value : request_.fill;
            } else if (request_.what == VoxeliseWhat::Opacity) {
                values[i] = s.opacity;
            } else {
                for (std::size_t c = 0; c < 3; ++c) values[4 * i + c] = s.opacity > 0 ? s.color[int(c)] : 0;
                values[4 * i + 3] = s.opacity;
            }
        }
    }

private:
    /// In the transfer's own space: what stands above it carries p there first.
    void displacement(std::span<const Vec3> p, std::span<double> values) const {
        std::vector<Vec3> start(p.begin(), p.end());
        for (const TransferTerm* above : outermost_.above) above->by->map(start, start);
        std::vector<Vec3> q = start;
        for (const TransferTerm* transfer : outermost_.list) transfer->by->map(q, q);
        for (std::size_t i = 0; i < p.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) values[3 * i + c] = q[i][int(c)] - start[i][int(c)];
    }

    const Term& root_;
    const VoxeliseRequest& request_;
    OutermostTransfer outermost_;
};

/// World positions of row `row` (of size.y · size.z) of the grid.
void rowPoints(const VolumeGrid& grid, std::size_t row, std::span<Vec3> p) {
    const double j = double(row % std::size_t(grid.size.y)), k = double(row / std::size_t(grid.size.y));
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = transformPoint(grid.worldFromIndex, {double(i), j, k});
}

template <class T>
std::shared_ptr<const Volume> evaluated(const VolumeGrid& grid, const Evaluator& evaluate, Progress* progress) {
    std::vector<T> result(grid.valueCount());
    const auto length = std::size_t(grid.size.x), channels = std::size_t(grid.channels);
    const std::size_t rows = std::size_t(grid.size.y) * std::size_t(grid.size.z);
    std::atomic<std::size_t> done{0};
    parallelFor(rows, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<Vec3> p(length);
        std::vector<double> values(length * channels);
        for (std::size_t row = begin; row < end; ++row) {
            rowPoints(grid, row, p);
            evaluate(p, values);
            std::transform(values.begin(), values.end(), result.begin() + std::ptrdiff_t(row * length * channels),
                           rounded<T>);
        }
        report(progress, double(done += end - begin) / double(rows));
    });
    return Volume::fromValues(grid, std::move(result));
}

}  // namespace

std::shared_ptr<const Volume> voxelise(const CompiledScene& scene, const VoxeliseRequest& request, Progress* progress) {
    if (request.what == VoxeliseWhat::Scalar && !oneSourceOf(*scene.root))
        throw Error("voxelize --what scalar", "the scene's root is not one volume or mesh", "ask for opacity or rgba");
    VolumeGrid grid = request.grid;
    grid.channels = channelsOf(request.what);
    const Evaluator evaluate(scene, request);
    if (request.what == VoxeliseWhat::Scalar)
        if (const auto chain = scalarChainOf(*scene.root); chain && mayVoxeliseChain(*chain, request))
            return voxeliseChain(*chain, request, evaluate, progress);
    return withVoxelType(request.type, [&](auto t) { return evaluated<decltype(t)>(grid, evaluate, progress); });
}

VolumeGrid cellCentredGrid(const Box3& bounds, Index3 size, int channels) {
    const Vec3 spacing = bounds.size() / Vec3(size);
    VolumeGrid grid{size, channels, Mat4(1.0)};
    for (int a = 0; a < 3; ++a) grid.worldFromIndex[a][a] = spacing[a];
    grid.worldFromIndex[3] = Vec4(bounds.min + 0.5 * spacing, 1);
    return grid;
}

}  // namespace voledit
