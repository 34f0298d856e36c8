#include "core/objects/fitted_terms.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/terms.h"

namespace voledit {
namespace {

using namespace test;

const VolumeTerm& volumeOf(const TermPtr& term) {
    return std::get<VolumeTerm>(term->node);
}

TermPtr wave(Index3 size) {
    VolumeGrid grid{size, 1, placementMatrix(Vec3(1, 2, 3), Vec3(0), Vec3(0.5, 1, 2))};
    std::vector<float> values(grid.sampleCount());
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = std::sin(float(n));
    return makeVolumeTerm(Volume::fromValues(grid, std::move(values)), 0, constantLook(1, Vec3(1)));
}

TEST(FittedTerms, AreTheSameWhereAllVolumesFit) {
    const TermPtr term = makeTransferTerm(bentLattice(0.1, 3), wave({16, 8, 4}), Combine::Union, "");
    VolumeFitter fitter;
    EXPECT_EQ(fitter.fitted(term, 16), term);
    EXPECT_TRUE(fitter.notices().empty());
}

TEST(FittedTerms, HoldMeansOfBoxesAlongTheAxesThatAreTooLong) {
    const TermPtr term = wave({33, 6, 5});
    VolumeFitter fitter;
    const VolumeTerm& fitted = volumeOf(fitter.fitted(term, 7));
    const VolumeGrid& grid = fitted.volume->grid();
    EXPECT_EQ(grid.size, Index3(4, 6, 5)) << "boxes of 8, the last sample left out";
    EXPECT_EQ(grid.spacing(), Vec3(4, 1, 2));
    EXPECT_EQ(grid.origin(), Vec3(1 + 3.5 * 0.5, 2, 3)) << "the middle of the first box";
    double sum = 0;
    for (int i = 8; i < 16; ++i) sum += volumeOf(term).volume->at({i, 3, 2});
    EXPECT_EQ(fitted.volume->at({1, 3, 2}), double(float(sum / 8)));
    ASSERT_EQ(fitter.notices().size(), 1u);
    EXPECT_NE(fitter.notices()[0].find("33x6x5"), std::string::npos);
    EXPECT_NE(fitter.notices()[0].find("4x6x5"), std::string::npos);
}

TEST(FittedTerms, ReplaceVolumesWhereverTheyStandAndKeepAllElse) {
    const TermPtr big = wave({20, 4, 4}), small = wave({8, 4, 4});
    const auto map = bentLattice(0.1, 3);
    const TermPtr recolored =
        makeRecolorTerm({.from = "scalar", .color = {}, .opacity = PiecewiseLinear{{{0, 1}}}, .of = big});
    const TermPtr root =
        makeCvgTerm(CvgOperator::Union,
                    {makeTransferTerm(map, big, Combine::First, "bend", TransferRole::SameList), recolored, small});
    VolumeFitter fitter;
    const TermPtr fitted = fitter.fitted(root, 10);
    const auto& of = std::get<CvgTerm>(fitted->node).of;
    const auto& transfer = std::get<TransferTerm>(of[0]->node);
    EXPECT_EQ(transfer.by, map);
    EXPECT_EQ(transfer.combine, Combine::First);
    EXPECT_EQ(transfer.name, "bend");
    EXPECT_EQ(transfer.role, TransferRole::SameList);
    EXPECT_EQ(of[2], small);
    EXPECT_EQ(transfer.of, std::get<RecolorTerm>(of[1]->node).of) << "what was shared stays so";
    EXPECT_EQ(volumeOf(transfer.of).volume->grid().size, Index3(10, 4, 4));
    EXPECT_EQ(fitter.notices().size(), 1u);
    EXPECT_EQ(fitter.fitted(root, 10), fitted) << "made once";
    const TermPtr again = fitter.fitted(makeTransferTerm(map, big, Combine::Union, ""), 10);
    EXPECT_EQ(volumeOf(std::get<TransferTerm>(again->node).of).volume, volumeOf(transfer.of).volume)
        << "a volume is reduced once for all terms";
}

}  // namespace
}  // namespace voledit
