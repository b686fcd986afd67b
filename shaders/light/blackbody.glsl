// SPDX-License-Identifier: Apache-2.0
#ifndef TYNDALL_LIGHT_BLACKBODY_GLSL
#define TYNDALL_LIGHT_BLACKBODY_GLSL

#include "interop/basic.h"
#include "interop/blackbody.h"

/// Radiance of a blackbody [W/(m2 sr)], linear Rec.709, within 0.1 % of light::blackbodyRadiance between
/// kBlackbodyMinKelvin and kBlackbodyMaxKelvin. Colder: continued by Wien's law to 0. Hotter: proportional to the
/// temperature. 0 for kelvin <= 0.
vec3 blackbodyRadiance(vec3Ptr table, float kelvin) {
  if (!(kelvin > 0.0)) {
    return vec3(0.0);
  }
  // ln R is nearly linear in 1 / T (Wien), the ratios of the channels vary slowly.
  const float hottest = 1.0 / kBlackbodyMaxKelvin;
  const float step = (1.0 / kBlackbodyMinKelvin - hottest) / float(kBlackbodyEntries - 1u);
  const float place = (1.0 / kelvin - hottest) / step;
  const uint last = kBlackbodyEntries - 2u;
  const uint lower = uint(clamp(place, 0.0, float(last)));
  const vec3 a = table.at[lower];
  const vec3 b = table.at[lower + 1u];
  const float within = max(place - float(lower), 0.0);
  const vec2 ratios = mix(a.yz, b.yz, min(within, 1.0));
  const float red = exp(a.x + within * (b.x - a.x)) * max(kelvin / kBlackbodyMaxKelvin, 1.0);
  return red * vec3(1.0, ratios);
}

#endif
