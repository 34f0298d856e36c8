#include "app/cli/bench_table.h"

#include <gmock/gmock.h>

#include "core/base/error.h"

namespace voledit {
namespace {

using Json = nlohmann::ordered_json;

Json runOf(double frame, double rate, double decibels) {
    return {{"pictures",
             {{{"scene", "a.voledit"},
               {"size", "64x64"},
               {"renderer", "rays"},
               {"frame_ms", {{"median", frame}, {"min", frame / 2}, {"max", 2 * frame}}},
               {"psnr_db", decibels}}}},
            {"work", {{{"scene", "a.voledit"}, {"locate_mqueries_per_s", rate}}}}};
}

TEST(BenchTable, RatiosAreAboveOneWhereItIsBetterNow) {
    Json now = runOf(10, 30, 50);
    compareRuns(now, runOf(20, 10, 47));
    const Json& picture = now["pictures"][0]["earlier_over_now"];
    EXPECT_DOUBLE_EQ(picture["frame_ms"].get<double>(), 2);
    EXPECT_DOUBLE_EQ(picture["psnr_db"].get<double>(), 3) << "a difference";
    EXPECT_DOUBLE_EQ(now["work"][0]["earlier_over_now"]["locate_mqueries_per_s"].get<double>(), 3);
}

TEST(BenchTable, OnlyTheSameMeasurementIsCompared) {
    Json now = runOf(10, 30, 50), earlier = runOf(20, 10, 47);
    earlier["pictures"][0]["renderer"] = "slices";
    earlier["work"][0]["scene"] = "b.voledit";
    compareRuns(now, earlier);
    EXPECT_FALSE(now["pictures"][0].contains("earlier_over_now"));
    EXPECT_FALSE(now["work"][0].contains("earlier_over_now"));
}

TEST(BenchTable, WhatIsNoRunIsRefused) {
    Json now = runOf(10, 30, 50);
    EXPECT_THROW(compareRuns(now, Json::array()), Error);
    EXPECT_THROW(compareRuns(now, Json{{"pictures", Json::array()}}), Error);
}

TEST(BenchTable, AColumnAFigureAndDashesForWhatIsMissing) {
    Json now = runOf(12.34, 30, 50);
    compareRuns(now, runOf(24.68, 30, 50));
    const std::string table = benchTable(now);
    EXPECT_THAT(table, testing::HasSubstr("12.3"));
    EXPECT_THAT(table, testing::HasSubstr("2.00"));
    EXPECT_THAT(table, testing::HasSubstr(" - "));
    EXPECT_THAT(table, testing::HasSubstr("Mpoints/s"));
}

}  // namespace
}  // namespace voledit
