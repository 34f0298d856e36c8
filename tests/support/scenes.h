#pragma once
// Compiled scenes made by hand, for the evaluators' tests.

#include "core/scene/compile.h"
#include "tests/support/terms.h"

namespace voledit::test {

/// `term` seen by `camera`; ℓ and the unit step are 1, unlit unless asked for, on a blue background.
inline CompiledScene sceneOf(TermPtr term, const Camera& camera, double step) {
    CompiledScene scene;
    scene.root = std::move(term);
    scene.camera = camera;
    scene.render.step = step;
    scene.render.shading = false;
    scene.render.background = {0, 0, 0.5};
    return scene;
}

}  // namespace voledit::test
