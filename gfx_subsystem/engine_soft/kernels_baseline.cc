// The variant of four lanes: SSE2 on x86-64, NEON on Arm, plain code elsewhere.
#include "gfx_subsystem/engine_soft/kernel_headers.h"

#define USUZUMI_KERNEL baseline
#define USUZUMI_KERNEL_LANES 4
#include "gfx_subsystem/engine_soft/kernels.inc.h"

namespace usuzumi::gfx::soft {
extern const Kernels kBaselineKernels;
const Kernels kBaselineKernels{"baseline", [] { return true; }, baseline::run_geometry, baseline::run_tile,
                               baseline::run_clears};
}  // namespace usuzumi::gfx::soft
