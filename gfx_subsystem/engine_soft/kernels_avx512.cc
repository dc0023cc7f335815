// The variant for x86-64 processors with AVX512: sixteen lanes.
#include "gfx_subsystem/engine_soft/kernel_headers.h"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,bmi,bmi2,lzcnt,popcnt,avx512f,avx512bw,avx512dq,avx512vl"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,bmi2,lzcnt,popcnt,avx512f,avx512bw,avx512dq,avx512vl")
#endif

#define USUZUMI_KERNEL avx512
#define USUZUMI_KERNEL_LANES 16
#include "gfx_subsystem/engine_soft/kernels.inc.h"

#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace usuzumi::gfx::soft {
namespace {
bool supported() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("bmi2");
}
}  // namespace
extern const Kernels kAvx512Kernels;
const Kernels kAvx512Kernels{"avx512", supported, avx512::run_geometry, avx512::run_tile, avx512::run_clears};
}  // namespace usuzumi::gfx::soft
