#include "core/stf/transfer_image.h"

#include <gtest/gtest.h>

namespace voledit {
namespace {

/// The image of `rest` by the text of an [image]; parameter k is 2.
Box3 imageOf(const std::string& text, const Box3& rest) {
    const FormulaFile file = parseFormulaFile("let k2 = k * k\n[map]\nq = u\n[image]\n" + text, "test.stf");
    FormulaSymbols symbols;
    symbols.parameters = {{"k", 1}};
    const std::vector<double> parameters{2};
    return TransferImage(*file.image, file.lets, symbols).of(rest, parameters);
}

const Box3 kRest{{1, 2, 3}, {4, 6, 8}};

TEST(TransferImage, IsFromMinToMax) {
    EXPECT_EQ(imageOf("let d = [k2, 0, 1]\nmin = low - d\nmax = high + d\n", kRest), (Box3{{-3, 2, 2}, {8, 6, 9}}));
    // In either order, as the corners of a box.
    EXPECT_EQ(imageOf("min = -low\nmax = -high\n", kRest), (Box3{{-4, -6, -8}, {-1, -2, -3}}));
}

TEST(TransferImage, IsTheBoxOfAllCombinations) {
    EXPECT_EQ(imageOf("let m = 0.5 * (low + high)\nover i = low[0], m[0], high[0]\nover j = -1, 1\nlet a = i * j\n"
                      "point = [a, j, i]\n",
                      kRest),
              (Box3{{-4, -1, 1}, {4, 1, 4}}));
    EXPECT_EQ(imageOf("point = [k, k2, 0]\n", kRest), (Box3{{2, 4, 0}, {2, 4, 0}}));
}

TEST(TransferImage, IsTheBoxItselfWhereAFormulaHasNoValue) {
    EXPECT_EQ(imageOf("min = low / 0\nmax = high\n", kRest), kRest);
    EXPECT_EQ(imageOf("over i = 1, sqrt(-1)\npoint = i * low\n", kRest), kRest);
}

TEST(TransferImage, KnowsNoPoint) {
    EXPECT_THROW(imageOf("min = u\nmax = high\n", kRest), FormulaError);
    EXPECT_THROW(imageOf("let j = i\nover i = 1, 2\npoint = low * j\n", kRest), FormulaError);
    EXPECT_THROW(imageOf("over i = 1, i\npoint = low * i\n", kRest), FormulaError);
}

}  // namespace
}  // namespace voledit
