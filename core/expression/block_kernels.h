#pragma once
// Loops that compute one operation over a block of points. Internal to core/expression.

#include <cstddef>
#include <cstdint>

namespace voledit {

enum class Op : std::uint8_t;

/// An operand over a block: one number for each point, or one for all.
struct BlockOperand {
    const double* values = nullptr;  // null: `uniform`
    double uniform = 0;
};

struct BlockStep {
    Op op{};
    std::uint64_t payload = 0;
    const BlockOperand* in = nullptr;  // as many as the operation has; at least one with values
    double* result = nullptr;          // may be an operand's values
    double* cosine = nullptr;          // with Op::Sine, where not null: takes the cosine
};

/// Computes `step` for n points.
using BlockKernel = void (*)(const BlockStep& step, std::size_t n);

/// For any processor.
void portableBlockKernel(const BlockStep& step, std::size_t n);
/// The same numbers, faster, for processors with AVX2; null where the compiler has none.
BlockKernel avx2BlockKernel();
/// The fastest that this processor runs.
BlockKernel blockKernel();

}  // namespace voledit
