#include "core/scene/compile.h"

#include <algorithm>
#include <exception>

#include "core/base/error.h"
#include "core/scene/compiler.h"
#include "core/scene/json_text.h"
#include "core/scene/limits.h"
#include "core/scene/scene_at.h"
#include "core/scene/scene_walk.h"

namespace voledit {

/// What the timeline's start decides.
struct SceneStart {
    Scene scene;  // with its tracks
    LoadedAssets assets;
    DefaultFrames frames;
    FittedLimbs fitted;
    Box3 rootBounds;

    bool isOf(const Scene& other, const LoadedAssets& others) const {
        return scene == other && assets.volumes == others.volumes && assets.meshes == others.meshes &&
               assets.transfers == others.transfers && assets.motions == others.motions;
    }
};

struct CompiledScene::Cache {
    std::shared_ptr<const Pieces> pieces;       // of this compilation
    std::shared_ptr<const Pieces> startPieces;  // of the timeline's start; null where the scene has no tracks
    std::shared_ptr<const SceneStart> start;
};

// ---- Compiler: the frame that all kinds of nodes share
// ---------------------------------------------------------------

Compiler::At::At(Compiler& compiler, NodePath path)
    : compiler_(compiler), before_(std::move(path)), exceptions_(std::uncaught_exceptions()) {
    compiler_.at_.swap(before_);
}

Compiler::At::At(Compiler& compiler, const char* member, std::size_t index)
    : At(compiler, compiler.at_ + "/" + member + "/" + std::to_string(index)) {}

Compiler::At::~At() {
    // The innermost place that an error leaves is where it happened.
    if (std::uncaught_exceptions() > exceptions_ && compiler_.failedAt_.empty()) compiler_.failedAt_ = compiler_.at_;
    compiler_.at_.swap(before_);
}

TermPtr Compiler::root() {
    try {
        const At at(*this, "root");
        return object(*in_.scene.root);
    } catch (const FormulaError&) {
        throw;  // names its place itself
    } catch (const Error& error) {
        throw Error(abridged(failedAt_) + ": " + error.what());
    }
}

void Compiler::count(const void* piece, const PieceKey& key) {
    std::size_t nodes = 1;
    for (const auto& owner : key.owners())
        if (const auto found = nodes_.find(owner.get()); found != nodes_.end()) nodes += found->second;
    if (nodes > kMostTermNodes)
        throw Error("scene", "one point would visit more than " + std::to_string(kMostTermNodes) + " of its nodes",
                    "use shared objects fewer times within each other");
    nodes_[piece] = nodes;
}

// ---- Compiling a scene ----------------------------------------------------------------------------------------------

namespace {

/// Smallest spacing among the volumes of the scene's assets, before any place; nullopt without volumes.
std::optional<double> smallestSpacing(const Scene& scene, const LoadedVolumes& volumes) {
    std::optional<double> smallest;
    for (const auto& [name, asset] : scene.assets) {
        const auto found = volumes.find(name);
        if (asset.kind != AssetKind::Volume || found == volumes.end() || !found->second) continue;
        const Vec3 spacing = found->second->grid().spacing();
        const double least = std::min({spacing.x, spacing.y, spacing.z});
        if (!smallest || least < *smallest) smallest = least;
    }
    return smallest;
}

double startTime(const Scene& scene) {
    return scene.timeline.start / scene.timeline.fps;
}

std::shared_ptr<const SceneStart> startOf(const Scene& scene, const LoadedAssets& assets, const Compiler& compiler,
                                          const Term& root) {
    return std::make_shared<const SceneStart>(
        SceneStart{scene, assets, compiler.frames(), compiler.fitted(), root.bounds});
}

/// Actors are compiled the innermost first.
std::vector<std::shared_ptr<const CompiledActor>> inTreeOrder(
    const Scene& scene, std::vector<std::shared_ptr<const CompiledActor>> actors) {
    if (actors.size() < 2) return actors;
    std::map<NodePath, std::size_t> rank;
    forEachNode(scene, [&](const NodePath& path, const NodePointer&) { rank.emplace(path, rank.size()); });
    std::sort(actors.begin(), actors.end(),
              [&](const auto& a, const auto& b) { return rank[a->path] < rank[b->path]; });
    return actors;
}

/// Finds what the timeline's start decides of a scene that is to be compiled at another time.
void compileStart(const Scene& scene, const LoadedAssets& assets, const CompiledScene::Cache* previous,
                  CompiledScene::Cache& cache) {
    if (previous && previous->start->isOf(scene, assets)) {
        cache.start = previous->start;
        cache.startPieces = previous->startPieces;
        return;
    }
    const double time = startTime(scene);
    const Scene first = sceneAt(scene, time);
    Compiler compiler({first, assets, time, previous ? previous->startPieces.get() : nullptr});
    const TermPtr root = compiler.root();
    cache.start = startOf(scene, assets, compiler, *root);
    cache.startPieces = compiler.pieces();
}

/// Compiles `scene`, which is `now` at t, into `compiled`.
void compileTerm(const Scene& scene, const Scene& now, const LoadedAssets& assets, double t,
                 const CompiledScene::Cache* previous, CompiledScene& compiled) {
    auto cache = std::make_shared<CompiledScene::Cache>();
    const auto compileNow = [&] {
        Compiler compiler({now, assets, t, previous ? previous->pieces.get() : nullptr,
                           cache->start ? cache->start->frames : DefaultFrames{},
                           cache->start ? cache->start->fitted : FittedLimbs{}});
        compiled.root = compiler.root();
        compiled.warnings = compiler.warnings();
        compiled.actors = inTreeOrder(scene, compiler.actors());
        cache->pieces = compiler.pieces();
        return compiler;
    };
    const bool isStart = t == startTime(scene);
    if (!isStart && animated(scene)) compileStart(scene, assets, previous, *cache);
    const Compiler compiler = compileNow();
    if (!cache->start && !isStart && compiler.readsTime()) {  // formulas over t, without any track
        compileStart(scene, assets, previous, *cache);
        compileNow();
    }
    if (!cache->start) {
        cache->start = startOf(scene, assets, compiler, *compiled.root);
        cache->startPieces = compiler.pieces();
    }
    compiled.cache = cache;
}

}  // namespace

CompiledScene compile(const Scene& scene, const LoadedAssets& assets, double t, const CompiledScene* previous,
                      double aspect) {
    CompiledScene compiled;
    const Scene now = sceneAt(scene, t);
    compileTerm(scene, now, assets, t, previous ? previous->cache.get() : nullptr, compiled);
    compiled.render = now.render;
    compiled.time = t;
    const auto spacing = smallestSpacing(scene, assets.volumes);
    compiled.opacityDistance = now.opacityDistance ? **now.opacityDistance : spacing.value_or(1);
    const Box3& bounds = compiled.cache->start->rootBounds;
    const Vec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    compiled.unitStep = spacing.value_or(longest > 0 ? longest / 256 : 1);
    compiled.camera = now.camera ? Camera(*now.camera) : fittingCamera(bounds, aspect);
    return compiled;
}

const std::map<std::string, Frame>& defaultFrames(const CompiledScene& scene) {
    return scene.cache->start->frames;
}

Scene withDefaultsWrittenOut(const Scene& scene, const LoadedAssets& assets) {
    const CompiledScene compiled = compile(scene, assets, startTime(scene), nullptr);
    Scene written = scene;
    if (!written.camera) written.camera = compiled.camera;
    if (!written.opacityDistance) written.opacityDistance = compiled.opacityDistance;
    writeFrames(written, defaultFrames(compiled));
    return written;
}

Lattice latticeOf(const FfdTransfer& ffd, const Frame& frame) {
    Lattice lattice{ffd.basis, ffd.points, frame, restControlPoints(ffd.basis, ffd.points, frame)};
    for (const auto& [point, move] : ffd.moves) {
        if (point >= lattice.control.size())
            throw Error("lattice", "it has no control point " + std::to_string(point), "points are counted from 0");
        lattice.control[point] = move.absolute ? *move.vector : lattice.control[point] + *move.vector;
    }
    return lattice;
}

}  // namespace voledit
