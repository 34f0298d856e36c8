#include "app/editor/platform/term_shape.h"

#include <gtest/gtest.h>

#include "tests/app/editor/editor_rig.h"

namespace voledit {
namespace {

TEST(TermShape, StaysWhileNumbersChange) {
    Workspace workspace;
    test::openIn(workspace, test::smallScene(true));
    const TermShape shape = shapeOf(workspace.compiled);
    workspace.document.apply(
        "move", [](Scene& scene) { moveControlPoints(scene, "lattice", std::vector<std::size_t>{0}, Vec3(1, 2, 3)); });
    test::recompile(workspace);
    EXPECT_EQ(shapeOf(workspace.compiled), shape);
    workspace.compiled.render.ambient = 0.9;
    EXPECT_EQ(shapeOf(workspace.compiled), shape);
}

TEST(TermShape, TellsStructuresVolumesAndLightApart) {
    Workspace with, without;
    test::openIn(with, test::smallScene(true));
    test::openIn(without, test::smallScene(false));
    EXPECT_NE(shapeOf(with.compiled), shapeOf(without.compiled));
    Workspace other;
    test::openIn(other, test::smallScene(true));  // another volume
    EXPECT_NE(shapeOf(with.compiled), shapeOf(other.compiled));
    CompiledScene shadowed = with.compiled;
    shadowed.render.shadows = 1;
    EXPECT_NE(shapeOf(with.compiled), shapeOf(shadowed));
}

// Shared nodes may stand for 2⁵⁰ uses.
TEST(TermShape, SharedNodesCountOnce) {
    Workspace workspace;
    test::openIn(workspace, test::smallScene(false));
    CompiledScene scene = workspace.compiled;
    for (int n = 0; n < 50; ++n) scene.root = makeCvgTerm(CvgOperator::Union, {scene.root, scene.root});
    EXPECT_LT(shapeOf(scene).size(), 300u);
}

}  // namespace
}  // namespace voledit
