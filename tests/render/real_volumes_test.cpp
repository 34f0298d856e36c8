// Real scans under a bent lattice: slices against fine rays, OSMesa against EGL, an unmoved lattice against none.

#include <iostream>

#include "core/io/io_client.h"
#include "core/scene/appearance.h"
#include "tests/render/render_fixtures.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using namespace test;

struct RealCase {
    const char* file;
    const char* preset;
};

class RealVolumes : public testing::TestWithParam<RealCase> {};

TEST_P(RealVolumes, SlicesMatchRays) {
    constexpr Index2 kSize{480, 360};
    VOLEDIT_SHARED_OR_SKIP(path, std::string("data/volumes/") + GetParam().file);
    IoClient client;
    const auto volume = client.readVolume(path).volume;
    Appearance preset;
    preset.preset = GetParam().preset;
    const TransferFunction appearance = resolve(preset, *volume);
    const TermPtr plain = makeVolumeTerm(volume, 0, appearance);
    const Vec3 spacing = volume->grid().spacing();
    const double unit = std::min(std::min(spacing.x, spacing.y), spacing.z);
    const auto scene = [&](const TransferPtr& by) {
        return sceneOf(by ? makeTransferTerm(by, plain, Combine::Union, "") : plain, unit);
    };
    const CompiledScene bent = scene(bentLattice(plain->bounds, Index3(16)));
    const Picture slices = slicesOf(bent, kSize);
    const double rays = psnr(slices, raysOf(bent, kSize, 4));
    CompiledScene without = scene(nullptr), rest = scene(restLattice(plain->bounds, Index3(16)));
    rest.camera = without.camera;
    const double unmoved = psnr(slicesOf(rest, kSize), slicesOf(without, kSize));
    std::cout << GetParam().file << " " << GetParam().preset << ": " << rays << " dB against rays, " << unmoved
              << " dB of an unmoved lattice against none\n";
    EXPECT_GE(rays, 40);
    EXPECT_GE(unmoved, 50);
    Picture osmesa;
    withContext(GlBackend::Osmesa, [&] {
        SliceRenderer renderer;
        osmesa = renderSlices(renderer, bent, kSize);
    });
    EXPECT_EQ(slices.pixels, osmesa.pixels);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealVolumes,
                         testing::Values(RealCase{"ct_head.mhd", "ct-bone"}, RealCase{"ct_head.mhd", "ct-skin"},
                                         RealCase{"chest_cta_heart.nii.gz", "ct-angiography"},
                                         RealCase{"engine.nii.gz", "grey"}),
                         [](const auto& p) { return "case" + std::to_string(p.index); });

}  // namespace
}  // namespace voledit
