// Slices of a rigged body over a motion, against rays.

#include <gtest/gtest.h>

#include "tests/render/render_fixtures.h"
#include "tests/support/rigged_body.h"

namespace voledit {
namespace {

TEST(ActorSlices, MatchRaysOverAMotion) {
    Body body = rigged("cmu_jumping_jacks");
    setCamera(body.scene, {{-10, 3, 40}, {0, 0.3, 0}, {0, 1, 0}, 26});
    CompiledScene compiled;
    // At 0.34 s cells at the crotch are pressed nearly flat.
    for (const double t : {0.0, 0.34, 0.8, 1.02, 2.2}) {
        compiled = compile(body.scene, body.assets, t, &compiled);
        EXPECT_GE(psnr(test::slicesOf(compiled, {480, 360}), test::raysOf(compiled, {480, 360}, 4)), 50)
            << "at " << t << " s";
    }
}

}  // namespace
}  // namespace voledit
