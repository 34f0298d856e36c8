#include "core/expression/block_kernels.h"

#include "core/expression/block_loops.h"

namespace voledit {

void portableBlockKernel(const BlockStep& step, std::size_t n) {
    runBlock(step, n);
}

BlockKernel blockKernel() {
#ifdef __x86_64__
    static const BlockKernel fastest =
        avx2BlockKernel() && __builtin_cpu_supports("avx2") ? avx2BlockKernel() : portableBlockKernel;
    return fastest;
#else
    return portableBlockKernel;
#endif
}

}  // namespace voledit
