// `voledit info` and `voledit sample` on every shared volume, against values that other programs read from the files
// (nibabel, numpy, VTK, pydicom, tifffile, OpenVDB; ../shared/data/SOURCES.md says how to read them).

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/base/types.h"
#include "tests/support/fixtures.h"

namespace voledit {
namespace {

using nlohmann::json;
using test::run;

json reference() {
    const auto path = test::shared("data/volumes/reference.json");
    if (!path) return json::object();
    return json::parse(std::ifstream(*path));
}

/// Index to LPS of a reference entry; NIfTI's RAS has x and y negated.
Mat4 lpsFromIndex(const json& entry) {
    Mat4 m(1.0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c) m[c][r] = entry["index_to_physical"][std::size_t(r)][std::size_t(c)].get<double>();
    if (entry["physical_space"].get<std::string>().starts_with("RAS"))
        for (int c = 0; c < 4; ++c) m[c][0] = -m[c][0], m[c][1] = -m[c][1];
    return m;
}

void expectNear(double found, double wanted, const std::string& what) {
    EXPECT_NEAR(found, wanted, std::max(5e-6, 1e-5 * std::abs(wanted))) << what;
}

class SharedVolume : public testing::TestWithParam<std::string> {};

TEST_P(SharedVolume, InfoAgreesWithOtherReaders) {
    VOLEDIT_SHARED_OR_SKIP(path, "data/" + GetParam());
    const json entry = reference()[GetParam()];
    const auto result = run("voledit", {"info", path.string(), "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json info = json::parse(result.out);
    EXPECT_EQ(info["kind"], "volume");
    EXPECT_EQ(info["size"], entry["dims"]);
    for (const char* name : {"min", "max", "mean"}) expectNear(info[name], entry[name], name);
    const Mat4 wanted = lpsFromIndex(entry);
    for (int c = 0; c < 3; ++c) {
        const double spacing = info["spacing"][std::size_t(c)];
        expectNear(spacing, entry["spacing"][std::size_t(c)], "spacing");
        for (int r = 0; r < 3; ++r)
            EXPECT_NEAR(info["direction"][std::size_t(3 * r + c)].get<double>() * spacing, wanted[c][r], 2e-5)
                << "direction of axis " << c;
        EXPECT_NEAR(info["origin"][std::size_t(c)].get<double>(), wanted[3][c], 2e-4);
    }
    std::uint64_t counted = 0;
    for (const json& n : info["histogram"]) counted += n.get<std::uint64_t>();
    EXPECT_EQ(counted, info["size"][0].get<std::uint64_t>() * info["size"][1].get<std::uint64_t>() *
                           info["size"][2].get<std::uint64_t>());
}

TEST_P(SharedVolume, SamplesAgreeWithOtherReaders) {
    VOLEDIT_SHARED_OR_SKIP(path, "data/" + GetParam());
    const json entry = reference()[GetParam()];
    const double sign = entry["physical_space"].get<std::string>().starts_with("RAS") ? -1 : 1;
    std::vector<std::string> arguments{"sample", path.string(), "--json"};
    for (const json& s : entry["samples"]) {
        const auto& p = s["physical"];
        std::ostringstream at;
        at.precision(12);
        at << sign * p[0].get<double>() << ',' << sign * p[1].get<double>() << ',' << p[2].get<double>();
        arguments.insert(arguments.end(), {"--at", at.str()});
    }
    const auto result = run("voledit", arguments);
    ASSERT_EQ(result.status, 0) << result.err;
    const json samples = json::parse(result.out)["samples"];
    ASSERT_EQ(samples.size(), entry["samples"].size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        // Positions in the reference are rounded to 1e-5, so a value may be off by that share of its neighbourhood.
        const double wanted = entry["samples"][i]["value"];
        const double range = entry["max"].get<double>() - entry["min"].get<double>();
        EXPECT_NEAR(samples[i]["value"].get<double>(), wanted, 1e-4 * range) << "sample " << i;
    }
}

std::vector<std::string> volumeNames() {
    std::vector<std::string> names;
    const json all = reference();
    for (const auto& [name, entry] : all.items()) names.push_back(name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Shared, SharedVolume, testing::ValuesIn(volumeNames()), [](const auto& parameter) {
    std::string name = parameter.param;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
});
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SharedVolume);

TEST(SampleCommand, IsNullOutsideAndTrilinearBetween) {
    const auto folder = test::scratchFolder();
    std::ofstream(folder / "v.raw", std::ios::binary).write("\x00\x0a\x14\x1e\x28\x32\x3c\x46", 8);
    const auto result = run("voledit", {"sample", (folder / "v.raw").string(), "--raw", "2x2x2,uint8", "--json", "--at",
                                        "0.5,0.5,0.5", "--at", "-1,0,0", "--at", "1.0005,0,0"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json samples = json::parse(result.out)["samples"];
    EXPECT_DOUBLE_EQ(samples[0]["value"].get<double>(), 35);  // the mean of 0, 10, …, 70
    EXPECT_TRUE(samples[1]["value"].is_null());
    EXPECT_DOUBLE_EQ(samples[2]["value"].get<double>(), 10);  // within 0.001 voxel of the box is inside
}

}  // namespace
}  // namespace voledit
