// SPDX-License-Identifier: Apache-2.0
// The surface materials, for both compilers: X(Name, prefix, id, "scene name"). Adding one: docs/adding.md.
#ifndef TYNDALL_MATERIAL_LIST_H
#define TYNDALL_MATERIAL_LIST_H

#include "interop/interop.h"

// clang-format off
#define TYNDALL_MATERIAL_LIST(X)                \
  X(Null,       null,       0, "null")          \
  X(Diffuse,    diffuse,    1, "diffuse")       \
  X(Conductor,  conductor,  2, "conductor")     \
  X(Dielectric, dielectric, 3, "dielectric")    \
  X(MetalRough, metalRough, 4, "metal_rough")
// clang-format on

#ifdef __cplusplus
namespace tyndall {
enum class MaterialId : interop::uint {
#define X(Name, prefix, id, sceneName) Name = id,
  TYNDALL_MATERIAL_LIST(X)
#undef X
};
} // namespace tyndall
#else
#define X(Name, prefix, id, sceneName) const uint kMaterial##Name = id;
TYNDALL_MATERIAL_LIST(X)
#undef X
#endif
#endif
