#include "core/scene/compile.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/matrix.hpp>
#include <set>
#include <tuple>
#include <unordered_map>

#include "core/base/error.h"
#include "core/scene/appearance.h"
#include "core/stf/affine.h"
#include "core/stf/cell_map.h"

namespace voledit {

namespace {

/// A transfer without what does not change its map: name, enabled.
struct TransferInputs {
    Transfer transfer;
    Frame frame;

    TransferInputs(const Transfer& t, const Frame& f) : transfer(t), frame(f) {
        transfer.name.clear();
        transfer.enabled = true;
        transfer.frame.reset();
        if (std::holds_alternative<AffineTransfer>(transfer.kind)) frame = Frame{};  // an affine map has no use for it
    }
    bool operator==(const TransferInputs&) const = default;

    /// Equal inputs give equal numbers; few others do.
    std::size_t hash() const {
        std::size_t h = std::hash<double>()(transfer.amount) ^ transfer.kind.index();
        const auto mix = [&](double x) { h = h * 1099511628211u + std::hash<double>()(x); };
        for (int a = 0; a < 3; ++a) mix(frame.corner[a]);
        for (int a = 0; a < 3; ++a) mix(frame.edge[std::size_t(a)][a]);
        if (const auto* ffd = std::get_if<FfdTransfer>(&transfer.kind))
            for (const auto& [point, move] : ffd->moves) mix(double(point) + move.vector.x + move.vector.y * 3);
        return h;
    }
};

}  // namespace

struct CompiledScene::Cache {
    struct VolumeEntry {
        Appearance appearance;
        TermPtr term;
    };
    struct TransferEntry {
        TransferInputs inputs;
        TransferPtr map;
    };
    // Keys are addresses of what the entry's own term keeps alive.
    std::map<std::pair<const Volume*, int>, std::vector<VolumeEntry>> volumes;
    std::unordered_multimap<std::size_t, TransferEntry> transfers;
    std::map<std::tuple<const SpatialTransferFunction*, const Term*, Combine, std::string, TransferRole>, TermPtr>
        terms;
};

namespace {

TransferPtr affineMap(const Mat4& worldFromRest, double amount) {
    if (amount == 1) return std::make_shared<AffineMap>(worldFromRest);
    const double determinant = glm::determinant(Mat3(worldFromRest));
    if (determinant == 0) return std::make_shared<AffineMap>(worldFromRest);  // reports it
    const Mat4 blended = Mat4(1) + amount * (glm::inverse(worldFromRest) - Mat4(1));
    return std::make_shared<AffineMap>(glm::inverse(blended));
}

TransferPtr latticeMap(const FfdTransfer& ffd, const Frame& frame, Outside outside, double amount) {
    auto map = std::make_shared<LatticeMap>(latticeOf(ffd, frame), ffd.cells, outside);
    if (amount == 1) return map;
    return scaledCells(*map, amount);
}

TransferPtr makeMap(const Transfer& transfer, const Frame& frame) {
    if (const auto* affine = std::get_if<AffineTransfer>(&transfer.kind))
        return affineMap(worldFromRest(affine->placement), transfer.amount);
    return latticeMap(std::get<FfdTransfer>(transfer.kind), frame, transfer.outside.value_or(Outside::Hide),
                      transfer.amount);
}

/// Compiles objects and transfers, taking equal pieces from `previous` and noting all in `next`.
class Compiler {
public:
    Compiler(const Scene& scene, const LoadedVolumes& volumes, const CompiledScene::Cache* previous)
        : scene_(scene), volumes_(volumes), previous_(previous), next_(std::make_shared<CompiledScene::Cache>()) {}

    TermPtr object(const Object& object) {
        return std::visit([this](const auto& kind) { return compiled(kind); }, object.kind);
    }

    /// `of` transferred by entry `n` of a `by` list.
    TermPtr applied(const TransferObject& object, std::size_t n, const TermPtr& of) {
        const Transfer& by = *object.by[n];
        const auto [transfer, name] = resolved(by);
        const Frame frame = frameFor(*transfer, by, of);
        const bool identity = !transfer->enabled || transfer->amount == 0;
        const TransferRole role = n + 1 == object.by.size() ? TransferRole::Outermost : TransferRole::SameList;
        return transferTerm(identity ? identityMap() : transferMap(*transfer, frame), {of, object.combine, name, role});
    }

    /// Frames that left-out ones of `scene.transfers` took, by name.
    const std::map<std::string, Frame>& firstFrames() const { return firstFrames_; }
    std::shared_ptr<const CompiledScene::Cache> cache() const { return next_; }

private:
    TermPtr compiled(const ObjectUse& use) {
        const auto known = objects_.find(use.name);
        if (known != objects_.end()) {
            if (!known->second) throw Error("object \"" + use.name + "\"", "it uses itself", "break the cycle");
            return known->second;
        }
        const auto found = scene_.objects.find(use.name);
        if (found == scene_.objects.end())
            throw Error("use of \"" + use.name + "\"", "the scene has no such object", "name one of `objects`");
        objects_[use.name] = nullptr;
        return objects_[use.name] = object(*found->second);
    }

    TermPtr compiled(const VolumeObject& object) {
        const auto found = volumes_.find(object.asset);
        if (found == volumes_.end() || !found->second)
            throw Error("asset \"" + object.asset + "\"", "its volume is not loaded",
                        "add it to the scene's assets with kind \"volume\"");
        const auto& volume = found->second;
        if (object.channel < 0 || object.channel >= volume->grid().channels)
            throw Error("asset \"" + object.asset + "\"",
                        "it has no channel " + std::to_string(object.channel) + " (it has " +
                            std::to_string(volume->grid().channels) + ", counted from 0)",
                        "change the object's `channel`");
        const auto key = std::pair(volume.get(), object.channel);
        auto& entries = next_->volumes[key];
        const auto sought = [&](const auto& entry) { return entry.appearance == object.appearance; };
        if (const auto made = std::find_if(entries.begin(), entries.end(), sought); made != entries.end())
            return made->term;
        TermPtr term;
        if (previous_)
            if (const auto old = previous_->volumes.find(key); old != previous_->volumes.end())
                if (const auto made = std::find_if(old->second.begin(), old->second.end(), sought);
                    made != old->second.end())
                    term = made->term;
        if (!term) term = makeVolumeTerm(volume, object.channel, resolve(object.appearance, *volume));
        entries.push_back({object.appearance, term});
        return term;
    }

    TermPtr compiled(const PlaceObject& place) {
        const TermPtr of = object(*place.of);
        Transfer move;
        move.kind = AffineTransfer{place.placement};
        return transferTerm(transferMap(move, Frame{}), {of, Combine::Union, "", TransferRole::Place});
    }

    TermPtr compiled(const TransferObject& object) {
        TermPtr term = this->object(*object.of);
        for (std::size_t n = 0; n < object.by.size(); ++n) term = applied(object, n, term);
        return term;
    }

    /// Follows `use`; the name is the transfer's own or else its name in `transfers`.
    std::pair<const Transfer*, std::string> resolved(const Transfer& by) const {
        const Transfer* transfer = &by;
        std::string name = by.name;
        std::set<std::string> seen;
        while (const auto* use = std::get_if<TransferUse>(&transfer->kind)) {
            const auto found = scene_.transfers.find(use->name);
            if (found == scene_.transfers.end())
                throw Error("use of \"" + use->name + "\"", "the scene has no such transfer",
                            "name one of `transfers`");
            if (!seen.insert(use->name).second)
                throw Error("transfer \"" + use->name + "\"", "it uses itself", "break the cycle");
            transfer = &*found->second;
            name = transfer->name.empty() ? use->name : transfer->name;
        }
        return {transfer, name};
    }

    /// A frame left out is the operand's box; a shared transfer keeps the box of its first use.
    Frame frameFor(const Transfer& transfer, const Transfer& by, const TermPtr& of) {
        if (transfer.frame) return *transfer.frame;
        if (!std::holds_alternative<TransferUse>(by.kind)) return frameOf(of->bounds);
        const std::string* key = nullptr;
        for (const Transfer* t = &by; const auto* use = std::get_if<TransferUse>(&t->kind);
             t = &*scene_.transfers.at(use->name))
            key = &use->name;
        return firstFrames_.try_emplace(*key, frameOf(of->bounds)).first->second;
    }

    TransferPtr identityMap() {
        Transfer identity;
        identity.kind = AffineTransfer{};
        return transferMap(identity, Frame{});
    }

    TransferPtr transferMap(const Transfer& transfer, const Frame& frame) {
        TransferInputs inputs(transfer, frame);
        const std::size_t hash = inputs.hash();
        if (auto made = findMap(*next_, hash, inputs)) return made;
        TransferPtr map = previous_ ? findMap(*previous_, hash, inputs) : nullptr;
        if (!map) map = makeMap(transfer, frame);
        next_->transfers.emplace(hash, CompiledScene::Cache::TransferEntry{std::move(inputs), map});
        return map;
    }

    static TransferPtr findMap(const CompiledScene::Cache& cache, std::size_t hash, const TransferInputs& inputs) {
        const auto [begin, end] = cache.transfers.equal_range(hash);
        const auto found = std::find_if(begin, end, [&](const auto& e) { return e.second.inputs == inputs; });
        return found == end ? nullptr : found->second.map;
    }

    struct TermInputs {
        TermPtr of;
        Combine combine;
        std::string name;
        TransferRole role;
    };

    TermPtr transferTerm(const TransferPtr& by, const TermInputs& in) {
        const auto key = std::tuple(by.get(), in.of.get(), in.combine, in.name, in.role);
        auto& term = next_->terms[key];
        if (!term && previous_)
            if (const auto old = previous_->terms.find(key); old != previous_->terms.end()) term = old->second;
        if (!term) term = makeTransferTerm(by, in.of, in.combine, in.name, in.role);
        return term;
    }

    const Scene& scene_;
    const LoadedVolumes& volumes_;
    const CompiledScene::Cache* previous_;
    std::shared_ptr<CompiledScene::Cache> next_;
    std::map<std::string, TermPtr> objects_;  // null while being compiled
    std::map<std::string, Frame> firstFrames_;
};

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

/// Writes the frames of inline transfers into `object`'s tree, compiling from the leaves up as `compile` does.
void writeFrames(Scene& scene, ObjectRef& ref, Compiler& compiler, std::set<std::string>& done) {
    if (const auto* use = std::get_if<ObjectUse>(&ref->kind)) {
        const auto found = scene.objects.find(use->name);
        if (found != scene.objects.end() && done.insert(use->name).second)
            writeFrames(scene, found->second, compiler, done);
    } else if (std::holds_alternative<PlaceObject>(ref->kind)) {
        writeFrames(scene, std::get<PlaceObject>(ref.edit().kind).of, compiler, done);
    } else if (std::holds_alternative<TransferObject>(ref->kind)) {
        auto& object = std::get<TransferObject>(ref.edit().kind);
        writeFrames(scene, object.of, compiler, done);
        TermPtr term = compiler.object(*object.of);
        for (std::size_t n = 0; n < object.by.size(); ++n) {
            const TermPtr before = term;
            term = compiler.applied(object, n, before);
            auto& by = object.by[n];
            if (std::holds_alternative<FfdTransfer>(by->kind) && !by->frame) by.edit().frame = frameOf(before->bounds);
        }
    }
}

}  // namespace

CompiledScene compile(const Scene& scene, const LoadedAssets& assets, double t, const CompiledScene* previous,
                      double aspect) {
    Compiler compiler(scene, assets.volumes, previous ? previous->cache.get() : nullptr);
    CompiledScene compiled;
    compiled.root = compiler.object(*scene.root);
    compiled.cache = compiler.cache();
    compiled.render = scene.render;
    compiled.time = t;
    const auto spacing = smallestSpacing(scene, assets.volumes);
    compiled.opacityDistance = scene.opacityDistance.value_or(spacing.value_or(1));
    const Vec3 size = compiled.root->bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    compiled.unitStep = spacing.value_or(longest > 0 ? longest / 256 : 1);
    compiled.camera = scene.camera ? *scene.camera : fittingCamera(compiled.root->bounds, aspect);
    return compiled;
}

Scene withDefaultsWrittenOut(const Scene& scene, const LoadedAssets& assets) {
    const double start = scene.timeline.start / scene.timeline.fps;
    const CompiledScene compiled = compile(scene, assets, start, nullptr);
    Scene written = scene;
    written.camera = compiled.camera;
    written.opacityDistance = compiled.opacityDistance;

    Compiler compiler(scene, assets.volumes, compiled.cache.get());
    std::set<std::string> done;
    writeFrames(written, written.root, compiler, done);
    for (const auto& [name, frame] : compiler.firstFrames()) {
        auto& transfer = written.transfers.at(name);
        if (std::holds_alternative<FfdTransfer>(transfer->kind)) transfer.edit().frame = frame;
    }
    return written;
}

Lattice latticeOf(const FfdTransfer& ffd, const Frame& frame) {
    Lattice lattice{ffd.basis, ffd.points, frame, restControlPoints(ffd.basis, ffd.points, frame)};
    for (const auto& [point, move] : ffd.moves) {
        if (point >= lattice.control.size())
            throw Error("lattice", "it has no control point " + std::to_string(point), "points are counted from 0");
        lattice.control[point] = move.absolute ? move.vector : lattice.control[point] + move.vector;
    }
    return lattice;
}

}  // namespace voledit
