// Actors and `skeleton` STFs of a scene → regions of limbs → mapped cells.
#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <set>

#include "core/base/error.h"
#include "core/rigging/rig.h"
#include "core/scene/actor_pose.h"
#include "core/scene/compiler.h"
#include "core/scene/limits.h"
#include "core/stf/cell_map.h"

namespace voledit {

namespace {

/// Opacity from which on a voxel counts when regions are fitted: all that can be seen.
constexpr double kFittedOpacity = 0.02;

Mat4 objectFromSkeletonOf(const Placement& fit) {
    const Mat4 result = worldFromRest(fit);
    const double determinant = glm::determinant(Mat3(result));
    if (std::isfinite(determinant) && determinant != 0) return result;
    const Vec3 scale = fit.scale;
    const bool isZero = !fit.matrix && (scale.x == 0 || scale.y == 0 || scale.z == 0);
    throw Error("skeleton", isZero ? "fit.scale is 0, which flattens it" : "fit flattens it or is not finite",
                "give the length in the object of one unit of the skeleton");
}

RegionOptions optionsOf(const ActorRig& rig, const Skeleton& skeleton) {
    RegionOptions options;
    options.cells = rig.cells;
    options.miterLimit = rig.miterLimit;
    options.smooth = rig.smooth;
    options.preserveVolume = rig.preserveVolume;
    if (rig.allDisjoint || !rig.disjoint.empty()) options.disjoint.assign(skeleton.joints.size(), rig.allDisjoint);
    for (const std::string& name : rig.disjoint)
        options.disjoint[std::size_t(jointIn(skeleton, name, "disjoint"))] = true;
    return options;
}

/// The limb as far as it is written.
Limb limbOf(const SceneLimb& written, const Skeleton& skeleton) {
    Limb limb;
    limb.name = written.name;
    limb.from = jointIn(skeleton, written.from, "limb \"" + written.name + "\"");
    limb.to = jointIn(skeleton, written.to, "limb \"" + written.name + "\"");
    int above = skeleton.joints[std::size_t(limb.to)].parent;
    while (above != Joint::kNoParent && above != limb.from) above = skeleton.joints[std::size_t(above)].parent;
    if (above == Joint::kNoParent)
        throw Error("limb \"" + written.name + "\"",
                    "joint \"" + written.to + "\" is not below \"" + written.from + "\"",
                    "a limb goes from a joint to one of its descendants");
    if (written.size) limb.size = **written.size;
    limb.offset = written.offset;
    limb.roll = *written.roll * std::numbers::pi / 180;
    if (written.pad) limb.pad = **written.pad;
    return limb;
}

std::vector<Limb> limbsOf(const std::vector<SceneLimb>& written, const Skeleton& skeleton) {
    std::vector<Limb> limbs;
    for (const SceneLimb& limb : written) limbs.push_back(limbOf(limb, skeleton));
    return limbs;
}

void checkCells(const ActorRig& rig, std::size_t limbs) {
    const double cells = double(limbs) * rig.cells.x * rig.cells.y * rig.cells.z;
    if (cells > double(kMostCells))
        throw Error("skeleton",
                    "its " + std::to_string(limbs) + " limbs have more than the " + std::to_string(kMostCells) +
                        " cells that fit",
                    "give fewer `cells` to a limb, or list the limbs that matter");
}

}  // namespace

/// Skeleton, poses, limbs as written, options; neither sizes that are left out nor regions.
CompiledActor Compiler::posedRig(const ActorRig& rig, const std::vector<SceneLimb>& limbs, Skeleton skeleton) {
    CompiledActor actor;
    actor.skeleton = std::move(skeleton);
    actor.objectFromSkeleton = objectFromSkeletonOf(rig.skeleton.fit);
    actor.motionPose = restPose(actor.skeleton);
    if (!rig.motion.empty()) {
        const auto motion = motionOf(in_.assets, rig.motion);
        PieceKey key("mapped joints", motion, rig.motionMap);
        for (const Joint& joint : actor.skeleton.joints) {
            key.add(joint.name);
            key.add(joint.parent);
        }
        using Map = std::map<std::string, std::string>;
        const auto joints =
            piece<Map>(key, [&] { return std::make_shared<const Map>(mappedJoints(rig, actor.skeleton, *motion)); });
        actor.motionPose = motionPoseOf(rig, actor.skeleton, *motion, *joints, timeFor(true));
    }
    actor.pose = withOwnRotations(actor.motionPose, rig.skeleton, actor.skeleton);
    actor.rest = laidInto(posedJoints(actor.skeleton, restPose(actor.skeleton)), actor.objectFromSkeleton);
    actor.posed = laidInto(posedJoints(actor.skeleton, actor.pose), actor.objectFromSkeleton);
    actor.options = optionsOf(rig, actor.skeleton);
    actor.limbs = limbsOf(limbs, actor.skeleton);
    checkCells(rig, limbs.size());
    return actor;
}

/// Gives sizes to limbs that leave them out: those that hold what limb l shows of `of[l]` at the timeline's start.
void Compiler::fitLimbs(CompiledActor& actor, const std::vector<SceneLimb>& written, const std::vector<TermPtr>& of) {
    const auto isLeftOut = [](const SceneLimb& limb) { return !limb.size; };
    if (std::none_of(written.begin(), written.end(), isLeftOut)) return;
    auto& known = in_.fitted[at_];
    if (known.size() != written.size()) {
        known = actor.limbs;
        std::set<TermPtr> done;
        for (std::size_t l = 0; l < written.size(); ++l) {
            if (written[l].size || !done.insert(of[l]).second) continue;
            std::vector<bool> fit;
            for (const TermPtr& shown : of) fit.push_back(shown == of[l]);
            const auto limbs = fittedTo(of[l], actor, fit);
            for (std::size_t k = 0; k < written.size(); ++k)
                if (fit[k]) known[k] = (*limbs)[k];
        }
    }
    for (std::size_t l = 0; l < written.size(); ++l) {
        if (written[l].size) continue;
        actor.limbs[l].size = known[l].size;
        actor.limbs[l].offset = known[l].offset;
        if (!written[l].pad) actor.limbs[l].pad = known[l].pad;
    }
}

/// Fits limbs as if none of them were written, so that pulling at one limb's box changes no other and fits nothing
/// anew.
std::shared_ptr<const std::vector<Limb>> Compiler::fittedTo(const TermPtr& of, const CompiledActor& actor,
                                                            const std::vector<bool>& fit) {
    const auto voxels = piece<OpaqueVoxels>(PieceKey("opaque voxels", of), [&] {
        return std::make_shared<const OpaqueVoxels>(opaqueVoxels(*of, kFittedOpacity));
    });
    std::vector<Limb> bare = actor.limbs;
    for (Limb& limb : bare) {
        limb.size = Vec2(1);
        limb.offset = limb.pad = Vec2(0);
    }
    return piece<std::vector<Limb>>(PieceKey("fitted limbs", voxels, actor.rest, bare, fit), [&] {
        return std::make_shared<const std::vector<Limb>>(fittedLimbs(*voxels, actor.rest, bare, fit));
    });
}

std::shared_ptr<const LimbRegions> Compiler::regionsOf(const CompiledActor& actor) {
    const auto& [cells, miterLimit, smooth, preserveVolume, disjoint] = actor.options;
    const PieceKey key("limb regions", actor.limbs, actor.rest, actor.posed, cells, miterLimit, smooth, preserveVolume,
                       disjoint);
    return piece<LimbRegions>(key, [&] {
        return std::make_shared<const LimbRegions>(limbRegions(actor.limbs, actor.rest, actor.posed, actor.options));
    });
}

/// Ψ of some limbs (indices ascending).
TransferPtr Compiler::mapOf(const std::shared_ptr<const LimbRegions>& regions, const std::vector<int>& limbs,
                            Outside outside) {
    return piece<SpatialTransferFunction>(PieceKey("limb cells", regions, limbs, outside), [&] {
        const bool all = limbs.size() + 1 == regions->firstCell.size();
        return std::make_shared<const CellMap>(all ? joinedCells(*regions) : cellsOf(*regions, limbs), outside);
    });
}

TermPtr Compiler::compiled(const ActorObject& object) {
    TermPtr of;
    {
        const At at(*this, "of");
        of = this->object(*object.of);
    }
    Skeleton skeleton = skeletonOf(object.rig.skeleton, in_.assets);
    const std::vector<SceneLimb> limbs = limbsOf(object.rig.skeleton, skeleton);
    std::vector<TermPtr> ofLimb(limbs.size(), of);
    for (std::size_t l = 0; l < limbs.size(); ++l) {
        if (!limbs[l].of) continue;
        const At at(*this, at_ + "/skeleton/limbs/" + std::to_string(l) + "/of");
        ofLimb[l] = this->object(**limbs[l].of);
    }
    auto actor = std::make_shared<CompiledActor>(posedRig(object.rig, limbs, std::move(skeleton)));
    actor->path = at_;
    actor->name = object.name;
    actor->of = of;
    actor->worldFromObject = worldFromHere_;
    fitLimbs(*actor, limbs, ofLimb);
    actor->regions = regionsOf(*actor);
    actors_.push_back(actor);
    // One transfer for all that show the actor's object, so that their regions join without a seam.
    std::vector<int> shared;
    for (std::size_t l = 0; l < limbs.size(); ++l)
        if (!limbs[l].of) shared.push_back(int(l));
    std::vector<TermPtr> parts;
    const auto add = [&](const std::vector<int>& which, const TermPtr& operand, const std::string& name) {
        parts.push_back(transferred(mapOf(actor->regions, which, Outside::Hide), operand, {Combine::Union, name}));
    };
    if (!shared.empty()) add(shared, of, object.name);
    for (std::size_t l = 0; l < limbs.size(); ++l)
        if (limbs[l].of) add({int(l)}, ofLimb[l], limbs[l].name);
    if (parts.size() == 1) return parts.front();
    return piece<Term>(PieceKey("cvg", CvgOperator::Union, parts, FieldPtr()),
                       [&] { return makeCvgTerm(CvgOperator::Union, parts); });
}

TransferPtr Compiler::made(const SkeletonTransfer& transfer, const Transfer& common, const Box3* box) {
    Skeleton skeleton = skeletonOf(transfer.rig.skeleton, in_.assets);
    const std::vector<SceneLimb> limbs = limbsOf(transfer.rig.skeleton, skeleton);
    const auto limb =
        std::find_if(limbs.begin(), limbs.end(), [&](const SceneLimb& one) { return one.name == transfer.limb; });
    if (limb == limbs.end())
        throw Error("limb \"" + transfer.limb + "\"", "the skeleton has none of this name",
                    "name one of its limbs: \"" + limbs.front().name + "\" …");
    CompiledActor actor = posedRig(transfer.rig, limbs, std::move(skeleton));
    if (box && operand_)
        fitLimbs(actor, limbs, std::vector<TermPtr>(limbs.size(), operand_));
    else if (const auto left = std::find_if(limbs.begin(), limbs.end(), [](const auto& one) { return !one.size; });
             left != limbs.end())
        throw Error("limb \"" + left->name + "\"", "it has no size, and there is no object to fit it to",
                    "give it a `size`");
    const TransferPtr map =
        mapOf(regionsOf(actor), {int(limb - limbs.begin())}, common.outside.value_or(Outside::Hide));
    return scaled(map, common.amount);
}

}  // namespace voledit
