// SPDX-License-Identifier: Apache-2.0
// The phase functions: one line registers a model for the device dispatch, the host enum, the scene-file name and
// the property tests. X(Name, GLSL prefix, id, "scene-file name", "parameters in order, blank-separated")
#ifndef TYNDALL_PHASE_LIST_H
#define TYNDALL_PHASE_LIST_H

// clang-format off
#define TYNDALL_PHASE_LIST(X)                                                               \
  X(Isotropic,        isotropic,        0, "isotropic",         "")                         \
  X(HenyeyGreenstein, henyeyGreenstein, 1, "henyey-greenstein", "g")                        \
  X(TwoLobe,          twoLobe,          2, "two-lobe",          "g1 g2 weight")             \
  X(Rayleigh,         rayleigh,         3, "rayleigh",          "")                         \
  X(Draine,           draine,           4, "draine",            "g alpha")                  \
  X(Mie,              mie,              5, "mie",               "diameter")
// clang-format on

#ifdef __cplusplus
namespace tyndall {
enum class PhaseId : unsigned {
#define X(Name, prefix, id, sceneName, parameters) Name = id,
  TYNDALL_PHASE_LIST(X)
#undef X
};
} // namespace tyndall
#endif

#endif
