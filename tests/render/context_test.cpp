#include "render/context.h"

#include <glad/gl.h>

#include "tests/render/render_fixtures.h"

namespace voledit {
namespace {

using namespace test;

TEST(Context, AutoPrefersEgl) {
    EXPECT_EQ(offscreen().name(), "egl");
    EXPECT_TRUE(GLAD_GL_VERSION_4_5);
}

TEST(Context, OsmesaIsFoundWithoutBeingLinked) {
    withContext(GlBackend::Osmesa, [] {
        EXPECT_TRUE(GLAD_GL_VERSION_4_5);
        EXPECT_NE(glGetString(GL_RENDERER), nullptr);
    });
}

TEST(Context, OsmesaAndEglDrawTheSamePictureToTheBit) {
    const auto volume = wavesVolume(24);
    const TermPtr plain = makeVolumeTerm(volume, 0, softAppearance());
    const TermPtr bent = makeTransferTerm(bentLattice(plain->bounds), plain, Combine::Union, "bent");
    for (const TermPtr& term : {plain, bent}) {
        const CompiledScene scene = sceneOf(term, 2.0 / 23);
        const Picture egl = slicesOf(scene, {160, 120});
        Picture osmesa;
        withContext(GlBackend::Osmesa, [&] {
            SliceRenderer renderer;
            osmesa = renderSlices(renderer, scene, {160, 120});
        });
        EXPECT_EQ(egl.pixels, osmesa.pixels);
    }
}

}  // namespace
}  // namespace voledit
