// The kernels of one variant. The including source defines USUZUMI_KERNEL (a namespace) and USUZUMI_KERNEL_LANES, and
// switches the compiler to its instruction set only after every shared header is in: an inline function of theirs
// compiled here for a newer processor must not be the copy that the linker keeps for all.
#include "gfx_subsystem/engine_soft/geometry_job.h"
#include "gfx_subsystem/engine_soft/tile_job.h"
