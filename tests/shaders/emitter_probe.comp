#version 460
// SPDX-License-Identifier: Apache-2.0
// light/emitter.glsl: samples of one emitter from one point (kMode 0), or the density of given hits (kMode 1).
#extension GL_GOOGLE_include_directive : require
#include "light/emitter.glsl"
#include "emitter_probe_io.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const uint kPlanted = 0u;
const uint kAreaDensity = 1u;   // density per area instead of per solid angle
const uint kSkewedTriangle = 2u; // barycentric coordinates without the square root
const uint kWrongCone = 3u;     // the cone's cosine in place of its sine
layout(push_constant, scalar) uniform Push { EmitterProbe probe; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= probe.count) {
    return;
  }
  EmitterHit hit = probe.hits.at[kMode == 0u ? 0u : i];
  if (kMode == 0u) {
    Rng rng = rngSeed(uvec2(i, 41u), 7u, 1u);
    LightSample drawn = sampleEmitter(probe.emitters, 0u, probe.point, rng);
    const Emitter light = probe.emitters.at[0].emitters.at[0];
    if (kPlanted == kAreaDensity) {
      drawn.pdf *= abs(dot(drawn.normal, drawn.direction));
    } else if (kPlanted == kSkewedTriangle) {
      const vec2 xi = rngFloat2(rng);
      drawn = triangleEmitterSample(light, probe.point, vec2(xi.x * xi.x, xi.y));
    } else if (kPlanted == kWrongCone) {
      SphereCone cone = sphereCone(light, probe.point);
      cone.oneMinusCos *= 0.9;
      drawn = sphereOutsideSample(light, probe.point, cone, rngFloat2(rng));
    }
    hit = EmitterHit(drawn.direction, drawn.distance, drawn.normal, drawn.radiance, drawn.pdf, 0.0, drawn.barycentric,
                     drawn.delta ? 1u : 0u);
  }
  hit.again = emitterDirectionPdf(probe.emitters, 0u, probe.point, hit.direction, hit.distance, hit.normal);
  probe.results.at[i] = hit;
}
