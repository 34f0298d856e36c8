#include "core/stf/transfer_arguments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/stf/library_maps.h"

namespace voledit {
namespace {

TransferDefinitionPtr every() {
    return TransferDefinition::parse(R"(
parameter n number = 1 degrees strength "n"
parameter s number = 2 strength from 1 "s"
parameter b pair = [3, 4] "b"
parameter v vector = 5 uniform "v"
parameter l line = [1, 2, 3] along [0, 3, 4] "l"
parameter k axis = z "k"
parameter a axes = [x, z] "a"
[map]
q = u
)",
                                     "every", "every.stf");
}

TEST(TransferArguments, FillEverySlotInOrder) {
    const auto definition = every();
    const auto arguments = completeArguments(*definition, {{"v", Numbers{6}}});
    const FormulaSymbols symbols = symbolsFor(*definition, arguments);
    std::vector<std::string> names;
    std::size_t slots = 0;
    for (const FormulaSymbol& symbol : symbols.parameters) {
        names.push_back(symbol.name);
        slots += std::size_t(symbol.width);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"n", "s", "b", "v", "l_point", "l_direction", "size", "hand", "t"}));
    EXPECT_EQ(symbols.constants.at("k"), Numbers{2});
    EXPECT_EQ(symbols.constants.at("a"), (Numbers{1, 0, 1}));
    const Frame frame{Vec3(0), {Vec3(0, 3, 4), Vec3(2, 0, 0), Vec3(0, 0, 7)}};
    const auto values = parameterValues(*definition, arguments, frame, 1, 9);
    EXPECT_EQ(values.size(), slots);
    const Numbers expected{kPi / 180, 2, 3, 4, 0, 6, 6, 6, 1, 2, 3, 0, 0.6, 0.8, 5, 2, 7, -1, 9};
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_DOUBLE_EQ(values[i], expected[i]) << i;
    const auto half = parameterValues(*definition, arguments, frame, 0.5, 9);
    EXPECT_DOUBLE_EQ(half[0], kPi / 360);
    EXPECT_DOUBLE_EQ(half[1], 1.5);
}

TEST(TransferArguments, SayWhatIsAllowedInWords) {
    EXPECT_EQ(allowedInWords({}), "any number");
    EXPECT_EQ(allowedInWords({0, 1}), "at least 0 and at most 1");
    EXPECT_EQ(allowedInWords({std::nextafter(0.0, 1), kInfinity}), "above 0");
    EXPECT_EQ(allowedInWords({-kInfinity, std::nextafter(1.0, 0)}), "below 1");
    EXPECT_EQ(allowedInWords({std::nextafter(-0.1, 1), 0.3}), "above -0.1 and at most 0.3");
    EXPECT_EQ(allowedInWords({-kInfinity, std::nextafter(0.0, -1)}), "below 0");
}

TEST(TransferArguments, SlidersOfLengthsAndPositionsFollowTheBox) {
    TransferParameter parameter;
    parameter.slider = {-1, 2};
    const Box3 box{{0, -10, 5}, {4, 10, 6}};
    EXPECT_EQ(sliderFor(parameter, box), (Interval{-1, 2}));
    parameter.unit = "length";
    EXPECT_EQ(sliderFor(parameter, box), (Interval{-20, 40}));
    parameter.unit = "position";
    EXPECT_EQ(sliderFor(parameter, box), (Interval{-30, 30}));
    EXPECT_EQ(sliderFor(parameter, Box3{}), (Interval{-1, 2}));
}

}  // namespace
}  // namespace voledit
