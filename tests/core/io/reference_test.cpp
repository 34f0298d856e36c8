// Every shared volume against values that other readers found (shared/data/SOURCES.md tells which).

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/fields/statistics.h"
#include "core/io/io_client.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using nlohmann::json;

json reference(const std::string& file) {
    const auto path = test::shared("data/volumes/reference.json");
    if (!path) return {};
    std::ifstream in(*path);
    return json::parse(in)["volumes/" + file];
}

class SharedVolume : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        const auto path = test::shared(std::string("data/volumes/") + GetParam());
        if (!path) GTEST_SKIP() << "shared test data is not there";
        expected_ = reference(GetParam());
        IoClient io;
        file_ = io.readVolume(*path);
    }

    /// LPS from the reference's own space.
    Vec3 lps(const json& p) const {
        const bool ras = expected_["physical_space"].get<std::string>().starts_with("RAS");
        const double sign = ras ? -1 : 1;
        return {sign * p[0].get<double>(), sign * p[1].get<double>(), p[2].get<double>()};
    }

    json expected_;
    VolumeFile file_;
};

TEST_P(SharedVolume, LiesWhereItShould) {
    const VolumeGrid& grid = file_.volume->grid();
    const json& m = expected_["index_to_physical"];
    for (int a = 0; a < 3; ++a) {
        EXPECT_EQ(grid.size[a], expected_["dims"][std::size_t(a)].get<int>());
        EXPECT_NEAR(grid.spacing()[a], expected_["spacing"][std::size_t(a)].get<double>(), 1e-6);
    }
    for (int c = 0; c < 4; ++c) {
        const auto n = std::size_t(c);
        const Vec3 column = lps({m[0][n], m[1][n], m[2][n]});
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(grid.worldFromIndex[c][r], column[r], 1e-6) << "column " << c;
    }
    EXPECT_THAT(file_.warnings, testing::IsEmpty());
}

TEST_P(SharedVolume, HasItsStatistics) {
    const VolumeStatistics found = countedStatistics(*file_.volume);
    EXPECT_EQ(found.min, file_.volume->statistics().min);
    EXPECT_EQ(found.max, file_.volume->statistics().max);
    const auto near = [](double a, double b) { return std::abs(a - b) <= std::max(1e-5 * std::abs(b), 5e-6); };
    EXPECT_PRED2(near, found.min, expected_["min"].get<double>());
    EXPECT_PRED2(near, found.max, expected_["max"].get<double>());
    EXPECT_PRED2(near, found.mean, expected_["mean"].get<double>());
    std::uint64_t counted = 0;
    for (const auto n : found.histogram) counted += n;
    EXPECT_EQ(counted, file_.volume->grid().sampleCount());
}

TEST_P(SharedVolume, HasItsSamples) {
    for (const json& sample : expected_["samples"]) {
        const double value = sample["value"].get<double>();
        const Index3 index{sample["index"][0], sample["index"][1], sample["index"][2]};
        EXPECT_NEAR(file_.volume->at(index), value, std::max(1e-5 * std::abs(value), 5e-6));
        const Vec3 p = lps(sample["physical"]);
        double found = 0;
        file_.volume->sample(std::span(&p, 1), std::span(&found, 1));
        // The reference rounds its positions to 5e-6.
        EXPECT_NEAR(found, value, std::max(1e-4 * std::abs(value), 0.02)) << sample.dump();
    }
}

INSTANTIATE_TEST_SUITE_P(, SharedVolume,
                         testing::Values("anatomical_bigendian.nii", "aneurism.nrrd", "brain_dicom",
                                         "ch2_brain_t1.nii.gz", "chest_cta_heart.nii.gz", "ct_head.mhd",
                                         "engine.nii.gz", "engine_png", "heptane_fire.nii.gz", "human_body.mhd",
                                         "nifti_space/AIL.nii.gz", "nifti_space/IPR.nii.gz", "nifti_space/LAS.nii.gz",
                                         "nifti_space/RAS.nii.gz", "smoke.vdb", "sphere_levelset.vdb", "stent.nrrd",
                                         "stroke_FLAIR_oblique.nrrd", "stroke_T1_oblique.nii.gz", "tooth.nhdr",
                                         "tooth_stack.tif"),
                         [](const auto& test) {
                             std::string name = test.param;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

TEST(SharedVolumes, PairsHoldTheSameVoxels) {
    IoClient io;
    for (const auto& [first, second] :
         {std::pair("engine.nii.gz", "engine_png"), std::pair("tooth.nhdr", "tooth_stack.tif")}) {
        VOLEDIT_SHARED_OR_SKIP(a, std::string("data/volumes/") + first);
        VOLEDIT_SHARED_OR_SKIP(b, std::string("data/volumes/") + second);
        const auto one = io.readVolume(a).volume, other = io.readVolume(b).volume;
        EXPECT_EQ(one->type(), other->type());
        EXPECT_TRUE(std::ranges::equal(one->voxels(), other->voxels())) << first;
    }
}

TEST(SharedVolumes, OneGridInTwoFormatsLiesInOnePlace) {
    VOLEDIT_SHARED_OR_SKIP(a, "data/volumes/stroke_T1_oblique.nii.gz");
    VOLEDIT_SHARED_OR_SKIP(b, "data/volumes/stroke_FLAIR_oblique.nrrd");
    IoClient io;
    const auto one = io.readVolume(a).volume, other = io.readVolume(b).volume;
    EXPECT_EQ(one->grid().size, other->grid().size);
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 3; ++r)
            EXPECT_NEAR(one->grid().worldFromIndex[c][r], other->grid().worldFromIndex[c][r], 1e-5);
}

}  // namespace
}  // namespace voledit
