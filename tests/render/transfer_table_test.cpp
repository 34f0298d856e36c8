#include "render/transfer_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace voledit {
namespace {

double thicknessAt(const TransferTable& table, double value) {
    const double entry =
        std::clamp((value - table.low) / (table.high - table.low), 0.0, 1.0) * (TransferTable::kSize - 1);
    const auto n = std::min(std::size_t(entry), std::size_t(TransferTable::kSize - 2));
    const double t = entry - double(n);
    return (1 - t) * table.thickness[n] + t * table.thickness[n + 1];
}

TransferFunction ramp() {
    TransferFunction f;
    f.color.points = {{-500, {1, 0, 0}}, {1500, {0, 1, 0}}};
    f.opacity.points = {{100, 0}, {300, 0.6}, {300, 0.1}, {900, 0.9}};
    return f;
}

TEST(TransferTable, HoldsTheFunctionBetweenAndBeyondItsCorners) {
    const TransferFunction f = ramp();
    const TransferTable table = makeTransferTable(f, -1000, 3000);
    for (double value = -1000; value < 3000; value += 7.3) {
        if (std::abs(value - 300) < 1) continue;  // the step is one entry wide
        EXPECT_NEAR(thicknessAt(table, value), -std::log(1 - f.opacity(value)), 4e-3) << value;
    }
}

TEST(TransferTable, RangeStaysWithinTheData) {
    const TransferTable table = makeTransferTable(ramp(), 0, 255);
    EXPECT_GE(table.low, 0);
    EXPECT_LE(table.high, 255);
    EXPECT_NEAR(thicknessAt(table, 200), -std::log(1 - 0.3), 1e-4);
}

TEST(TransferTable, VisibleIsExactForTheTable) {
    TransferFunction f = ramp();
    f.opacity.points = {{100, 0}, {110, 0.5}, {120, 0}, {800, 0}, {810, 0.5}};
    const TransferTable table = makeTransferTable(f, -1000, 3000);
    EXPECT_FALSE(table.visible(-900, 98));
    EXPECT_TRUE(table.visible(-900, 101));
    EXPECT_FALSE(table.visible(122, 797));
    EXPECT_TRUE(table.visible(122, 803));
    EXPECT_TRUE(table.visible(2000, 3000)) << "held beyond its end";
    const double scale = (table.high - table.low) / (TransferTable::kSize - 1);
    EXPECT_EQ(thicknessAt(table, table.low + table.firstVisible * scale - 0.1), 0);
    EXPECT_GT(thicknessAt(table, table.low + (table.firstVisible + 1.5) * scale), 0);
}

TEST(TransferTable, ConstantAndEmptyFunctions) {
    TransferFunction f;
    const TransferTable empty = makeTransferTable(f, 5, 5);
    EXPECT_FALSE(empty.visible(-kInfinity, kInfinity));
    f.opacity.points = {{3, 0.5}};
    const TransferTable constant = makeTransferTable(f, 0, 10);
    for (const double value : {-1.0, 0.0, 3.0, 10.0}) EXPECT_NEAR(thicknessAt(constant, value), std::log(2), 1e-6);
}

}  // namespace
}  // namespace voledit
