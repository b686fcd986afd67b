#version 460
// SPDX-License-Identifier: Apache-2.0
// The pass `path` through our own tree of the surfaces.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/path/kernel.glsl"

#include "geometry/ray.glsl"
