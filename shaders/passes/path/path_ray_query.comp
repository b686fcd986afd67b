#version 460
// SPDX-License-Identifier: Apache-2.0
// The pass `path` with rays cast by the device. A module of its own: it declares a capability that few devices have.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require

#include "passes/path/kernel.glsl"

#include "geometry/ray_query.glsl"
