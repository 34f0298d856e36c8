#include "core/scene/appearance.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace voledit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

template <class T>
std::shared_ptr<const Volume> volumeOf(std::vector<T> values) {
    VolumeGrid grid;
    grid.size = {int(values.size()), 1, 1};
    return Volume::fromValues(grid, std::move(values));
}

TEST(Presets, AreTheContractsAndSorted) {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) names.push_back(preset.name);
    EXPECT_THAT(names, testing::IsSupersetOf(
                           {"ct-angiography", "ct-bone", "ct-muscle", "ct-skin", "fire", "grey", "mri", "smoke"}));
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST(Presets, AreWellFormed) {
    for (const Preset& preset : presets()) {
        EXPECT_FALSE(preset.title.empty()) << preset.name;
        EXPECT_FALSE(preset.description.empty()) << preset.name;
        const auto& tables = preset.tables;
        ASSERT_GE(tables.color.points.size(), 2u) << preset.name;
        ASSERT_GE(tables.opacity.points.size(), 2u) << preset.name;
        const auto unit = [](double x) { return x >= 0 && x <= 1; };
        for (std::size_t i = 0; i < tables.color.points.size(); ++i) {
            const auto& point = tables.color.points[i];
            EXPECT_TRUE(unit(point.color.r) && unit(point.color.g) && unit(point.color.b)) << preset.name;
            EXPECT_TRUE(i == 0 || point.value >= tables.color.points[i - 1].value) << preset.name;
        }
        for (std::size_t i = 0; i < tables.opacity.points.size(); ++i) {
            EXPECT_TRUE(unit(tables.opacity.points[i].y)) << preset.name;
            EXPECT_TRUE(i == 0 || tables.opacity.points[i].x >= tables.opacity.points[i - 1].x) << preset.name;
        }
        const double air = preset.relative ? 0 : -1000;
        EXPECT_EQ(tables.opacity(air), 0) << preset.name << " shows air";
    }
}

TEST(PresetNamed, ListsTheNamesThatThereAre) {
    EXPECT_EQ(presetNamed("ct-bone").title, "CT bone");
    EXPECT_THAT([] { presetNamed("ct-wood"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("ct-wood"), HasSubstr("ct-bone"), HasSubstr("smoke"))));
}

TEST(Resolve, NothingGivenIsTheGreyRamp) {
    const auto volume = volumeOf<float>({-5, 0, 15});
    EXPECT_EQ(resolve({}, *volume), greyRamp(-5, 15));
}

TEST(Resolve, RelativePresetsStretchOverTheVolumesRange) {
    const auto volume = volumeOf<float>({100, 200, 300});
    Appearance appearance;
    appearance.preset = "fire";
    const TransferFunction tables = resolve(appearance, *volume);
    const Preset& fire = presetNamed("fire");
    ASSERT_TRUE(fire.relative);
    for (const double x : {0.0, 0.13, 0.5, 1.0}) {
        EXPECT_NEAR(tables.opacity(100 + 200 * x), fire.tables.opacity(x), 1e-12);
        EXPECT_NEAR(tables.color(100 + 200 * x).r, fire.tables.color(x).r, 1e-12);
    }
}

TEST(Resolve, PresetsInDataUnitsStayAsTheyAre) {
    const auto volume = volumeOf<std::int16_t>({-1000, 0, 1000});
    Appearance appearance;
    appearance.preset = "ct-bone";
    EXPECT_EQ(resolve(appearance, *volume), presetNamed("ct-bone").tables);
}

TEST(Resolve, TablesWinWhereTheyAreGiven) {
    const auto volume = volumeOf<float>({0, 10});
    Appearance appearance;
    appearance.opacity = PiecewiseLinear{{{0, 0.5}}};
    appearance.gradientOpacity = PiecewiseLinear{{{0, 0}, {1, 1}}};
    const TransferFunction tables = resolve(appearance, *volume);
    EXPECT_EQ(tables.opacity, *appearance.opacity);
    EXPECT_EQ(tables.gradientOpacity, *appearance.gradientOpacity);
    EXPECT_EQ(tables.color, greyRamp(0, 10).color);
}

TEST(SuggestedPreset, KnowsCtAndFogAndElseTakesGrey) {
    EXPECT_EQ(suggestedPreset(*volumeOf<std::int16_t>({-1024, -990, -1000, -950, 0, 2000, -1000})), "ct-skin");
    EXPECT_EQ(suggestedPreset(*volumeOf<float>({-1000, -1000, -990, -980, 0, 2000, -1000})), "ct-skin");
    EXPECT_EQ(suggestedPreset(*volumeOf<std::int16_t>({-1024, 40, 60, 300, 2000})), "ct-angiography") << "cut out";
    EXPECT_EQ(suggestedPreset(*volumeOf<std::int16_t>({0, 5, 2000})), "grey");
    EXPECT_EQ(suggestedPreset(*volumeOf<std::int16_t>({-30000, 0, 30000})), "grey");
    EXPECT_EQ(suggestedPreset(*volumeOf<float>({0, 0, 0, 0, 0, 0.5F, 5.7F})), "smoke");
    EXPECT_EQ(suggestedPreset(*volumeOf<float>({0, 1, 2, 3, 4, 5})), "grey");
    EXPECT_EQ(suggestedPreset(*volumeOf<float>({-0.15F, -0.15F, -0.15F, 0.15F})), "grey");
    EXPECT_EQ(suggestedPreset(*volumeOf<std::uint8_t>({0, 128, 255})), "grey");
    EXPECT_EQ(suggestedPreset(*volumeOf<std::uint8_t>({7, 7, 7})), "");
}

}  // namespace
}  // namespace voledit
