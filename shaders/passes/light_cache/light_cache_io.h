// SPDX-License-Identifier: Apache-2.0
// Pass `light_cache`: the depths of one light cache, one invocation per column.
//
// In:  the grids and the caches, complete but for what `depths` points to; the columns of one cache to build.
// Out: `depths` of those columns, every node.
#ifndef TYNDALL_LIGHT_CACHE_IO_H
#define TYNDALL_LIGHT_CACHE_IO_H

#include "interop/light_cache.h"

GPU_BEGIN

// Push constants. Column c has a = c % count.x, b = c / count.x.
struct LightCacheInputs {
  GPU_PTR(CellGrid) grids;
  GPU_PTR(LightCache) caches;
  uint cache;       // index into caches
  uint firstColumn;
  uint columnCount; // columns [firstColumn, firstColumn + columnCount) are built
};

GPU_END
#endif
