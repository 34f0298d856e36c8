#include "app/editor/actor_analysis.h"

#include <algorithm>

#include "app/editor/tools/actor_view.h"
#include "core/base/error.h"
#include "core/rigging/curve_skeleton.h"

namespace voledit {

namespace {

std::vector<Vec3> positionsOf(const std::vector<PosedJoint>& joints) {
    std::vector<Vec3> positions;
    for (const PosedJoint& joint : joints) positions.push_back(joint.position);
    return positions;
}

bool same(const RegionOptions& a, const RegionOptions& b) {
    return a.cells == b.cells && a.miterLimit == b.miterLimit && a.smooth == b.smooth &&
           a.preserveVolume == b.preserveVolume && a.disjoint == b.disjoint;
}

}  // namespace

std::shared_ptr<const ActorBody> bodyOf(const TermPtr& of, Progress* progress) {
    auto body = std::make_shared<ActorBody>();
    body->of = of;
    body->voxels = opaqueVoxels(*of, kOpaque, 256, progress);
    report(progress, progress ? progress->fraction() : 0);
    body->distance = distanceField(body->voxels);
    return body;
}

void ActorAnalysis::update(Workspace& workspace, bool wait) {
    do {
        if (wait) work_.wait();
        try {
            work_.poll();
        } catch (const std::exception& error) {
            workspace.notify(Notice::Kind::Problem, error.what());
        }
    } while (startWhatIsMissing(workspace) && wait);
}

bool ActorAnalysis::startWhatIsMissing(Workspace& workspace) {
    ActorState& state = workspace.actors;
    const ActorPtr actor =
        workspace.open ? activeActor(workspace.document.scene(), &workspace.compiled, workspace.selection) : nullptr;
    if (!actor || !state.rigEdit) {
        state.coverage.reset();
        of_.reset();
        return false;
    }
    if (state.body && state.body->of != actor->of) {
        state.body.reset();
        state.coverage.reset();
    }
    if (work_.running() || failed_ == actor->of) return false;
    if (!state.body) {
        // Until it is there, it counts as one that cannot be had: an error is told once.
        failed_ = actor->of;
        work_.start("Looking at the object", [this, &state, of = actor->of](Progress& progress) -> Background::Finish {
            return [this, &state, body = bodyOf(of, &progress)] {
                state.body = body;
                failed_.reset();
            };
        });
        return true;
    }
    // What is dragged is counted when it is let go.
    if (!state.showCoverage || workspace.document.previewing()) return false;
    const std::vector<Vec3> rest = positionsOf(actor->rest);
    if (of_ == state.body && limbs_ == actor->limbs && rest_ == rest && same(options_, actor->options)) return false;
    of_ = state.body;
    limbs_ = actor->limbs;
    rest_ = rest;
    options_ = actor->options;
    work_.start("Counting covered voxels", [&state, body = state.body, actor](Progress&) -> Background::Finish {
        auto counted =
            std::make_shared<const Coverage>(coverageOf(body->voxels, actor->limbs, actor->rest, actor->options));
        return [&state, counted, body] {
            if (state.body == body) state.coverage = counted;
        };
    });
    return true;
}

}  // namespace voledit
