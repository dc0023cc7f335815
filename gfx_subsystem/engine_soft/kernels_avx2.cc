// The variant for x86-64 processors with AVX2: eight lanes.
#include "gfx_subsystem/engine_soft/kernel_headers.h"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,bmi2,lzcnt,popcnt")
#endif

#define USUZUMI_KERNEL avx2
#define USUZUMI_KERNEL_LANES 8
#include "gfx_subsystem/engine_soft/kernels.inc.h"

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace usuzumi::gfx::soft {
namespace {
bool supported() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
}
}  // namespace
extern const Kernels kAvx2Kernels;
const Kernels kAvx2Kernels{"avx2", supported, avx2::run_geometry, avx2::run_tile, avx2::run_clears};
}  // namespace usuzumi::gfx::soft
