// SPDX-License-Identifier: Apache-2.0
// What the store says of the vertex at hand, the first one of a pixel that does not scatter by a delta.
#ifndef TYNDALL_PATH_VIEW_GLSL
#define TYNDALL_PATH_VIEW_GLSL

#include "guide/view.glsl"
#include "passes/path/direction.glsl"

void view(GuidePtr guide, ScatterPoint vertex) {
  const vec3 point = vertex.place.position + guide.at[0].shift;
  const vec3 horizon = vertex.transmits ? vec3(0.0) : vertex.place.normal;
  if (!kGuideScreen) {
    io.views.at[path.slot] = viewCell(guide, point, horizon, facingOf(vertex));
  } else if (path.events == 1u && onSurface(vertex)) { // others read no chains
    io.views.at[path.slot] = viewScreenChain(guide, chainOfPixel(guide, ivec2(pixelInFlight())), point, horizon);
  }
}

#endif
