#include "gfx_subsystem/engine_soft/round.h"

namespace usuzumi::gfx::soft {

extern const Kernels kBaselineKernels;
#if defined(__x86_64__)
extern const Kernels kAvx2Kernels, kAvx512Kernels;
#endif

std::span<const Kernels* const> all_kernels() {
#if defined(__x86_64__)
  static constexpr const Kernels* kAll[] = {&kBaselineKernels, &kAvx2Kernels, &kAvx512Kernels};
#else
  static constexpr const Kernels* kAll[] = {&kBaselineKernels};
#endif
  return kAll;
}

}  // namespace usuzumi::gfx::soft
