// Every header shared with other sources that the kernels use; see kernels.inc.h.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "gfx_subsystem/engine_soft/clip.h"
#include "gfx_subsystem/engine_soft/round.h"
