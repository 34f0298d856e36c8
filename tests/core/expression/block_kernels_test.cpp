#include "core/expression/block_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/expression/formula_graph.h"

namespace voledit {
namespace {

bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

/// Numbers of all kinds: ordinary, whole, signed zeros, huge, tiny, infinite, NaN.
std::vector<double> numbers(std::mt19937& random, std::size_t count) {
    const std::array<double, 12> special{0.0, -0.0, 1, -1, 2, -3, 1e300, -1e-310, kInfinity, -kInfinity, kNaN, 0.5};
    std::uniform_real_distribution<double> ordinary(-3, 3);
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(random() % 3 ? ordinary(random) : special[random() % special.size()]);
    return result;
}

/// Every operation, with operands that vary or not, against one number at a time.
void checkAgainstSingleNumbers(BlockKernel kernel) {
    std::mt19937 random(3);
    constexpr std::size_t kCount = 203;  // no multiple of any vector's width
    for (int number = int(Op::Negate); number <= int(Op::Noise); ++number) {
        const Op op = static_cast<Op>(number);
        const int operands = operandCount(op);
        for (int varying = 1; varying < 1 << operands; ++varying)
            for (std::uint64_t payload = op == Op::IntegerPower ? 3 : 0; payload <= (op == Op::IntegerPower ? 16u : 0u);
                 ++payload) {
                std::array<std::vector<double>, 3> in;
                std::array<BlockOperand, 3> operand;
                for (int o = 0; o < operands; ++o) {
                    in[std::size_t(o)] = numbers(random, kCount);
                    // Conditions are 0 or 1.
                    if (op == Op::Not || op == Op::And || op == Op::Or || (op == Op::Select && o == 0))
                        for (double& x : in[std::size_t(o)]) x = x > 0 ? 1 : 0;
                    if (op == Op::Power && o == 1 && random() % 2) in[1][0] = double(random() % 40) - 20;
                    if (varying >> o & 1)
                        operand[std::size_t(o)].values = in[std::size_t(o)].data();
                    else
                        operand[std::size_t(o)].uniform = in[std::size_t(o)][0];
                }
                std::vector<double> result(kCount);
                kernel({.op = op, .payload = payload, .in = operand.data(), .result = result.data()}, kCount);
                for (std::size_t i = 0; i < kCount; ++i) {
                    std::array<double, 3> x{};
                    for (int o = 0; o < operands; ++o) x[std::size_t(o)] = in[std::size_t(o)][varying >> o & 1 ? i : 0];
                    const double expected = applied({.op = op, .payload = payload}, x[0], x[1], x[2]);
                    ASSERT_TRUE(same(result[i], expected))
                        << "operation " << number << " of " << x[0] << ", " << x[1] << ", " << x[2] << ": " << result[i]
                        << " instead of " << expected;
                }
            }
    }
}

TEST(BlockKernels, GiveTheNumbersOfSingleOperations) {
    checkAgainstSingleNumbers(portableBlockKernel);
}

TEST(BlockKernels, GiveTheSameNumbersOnEveryProcessor) {
    if (blockKernel() == portableBlockKernel) GTEST_SKIP() << "this processor has no AVX2";
    checkAgainstSingleNumbers(blockKernel());
}

TEST(BlockKernels, MayWriteOverAnOperand) {
    std::mt19937 random(4);
    for (const Op op : {Op::Add, Op::Minimum, Op::Modulo, Op::Power}) {
        const auto a = numbers(random, 256), b = numbers(random, 256);
        std::vector<double> apart(256), over = a;
        const std::array<BlockOperand, 2> first{{{a.data()}, {b.data()}}}, second{{{over.data()}, {b.data()}}};
        blockKernel()({.op = op, .in = first.data(), .result = apart.data()}, 256);
        blockKernel()({.op = op, .in = second.data(), .result = over.data()}, 256);
        for (std::size_t i = 0; i < 256; ++i) EXPECT_TRUE(same(apart[i], over[i]));
    }
}

TEST(BlockKernels, SineAndCosineTogetherAreThoseAlone) {
    std::mt19937 random(5);
    auto angle = numbers(random, 256);
    std::vector<double> sine(256), cosine(256);
    const BlockOperand operand{angle.data()};
    blockKernel()({.op = Op::Sine, .in = &operand, .result = sine.data(), .cosine = cosine.data()}, 256);
    for (std::size_t i = 0; i < 256; ++i) {
        EXPECT_TRUE(same(sine[i], std::sin(angle[i])));
        EXPECT_TRUE(same(cosine[i], std::cos(angle[i])));
    }
}

}  // namespace
}  // namespace voledit
