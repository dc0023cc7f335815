// The variant for processors without vectors, a Cortex-M7 for one: there a textured frame takes 1.9 times as long in
// four lanes that the compiler only pretends, and 116 KB more code. It runs everywhere, so every host tests it.
#include "gfx_subsystem/engine_soft/kernel_headers.h"

#define USUZUMI_KERNEL pixelwise
#define USUZUMI_KERNEL_LANES 4
#define USUZUMI_KERNEL_PIXELWISE
#include "gfx_subsystem/engine_soft/kernels.inc.h"

namespace usuzumi::gfx::soft {
extern const Kernels kPixelwiseKernels;
const Kernels kPixelwiseKernels{"pixelwise", [] { return true; }, pixelwise::run_geometry, pixelwise::run_tile,
                                pixelwise::run_clears};
}  // namespace usuzumi::gfx::soft
