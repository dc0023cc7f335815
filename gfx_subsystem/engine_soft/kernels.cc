#include "gfx_subsystem/engine_soft/round.h"

namespace usuzumi::gfx::soft {

extern const Kernels kPixelwiseKernels, kBaselineKernels;
#if defined(__x86_64__)
extern const Kernels kAvx2Kernels, kAvx512Kernels;
#endif

std::span<const Kernels* const> all_kernels() {
#if defined(__x86_64__)
  static constexpr const Kernels* kAll[] = {&kPixelwiseKernels, &kBaselineKernels, &kAvx2Kernels, &kAvx512Kernels};
#elif defined(__ARM_NEON)
  static constexpr const Kernels* kAll[] = {&kBaselineKernels};
#else
  static constexpr const Kernels* kAll[] = {&kPixelwiseKernels};
#endif
  return kAll;
}

}  // namespace usuzumi::gfx::soft
