// Compiled with -mavx2 (CMakeLists.txt); without fused multiply-adds its numbers are those of any processor.

#include "core/expression/block_kernels.h"
#ifdef __AVX2__
#include "core/expression/block_loops.h"
#endif

namespace voledit {

BlockKernel avx2BlockKernel() {
#ifdef __AVX2__
    return runBlock;
#else
    return nullptr;
#endif
}

}  // namespace voledit
