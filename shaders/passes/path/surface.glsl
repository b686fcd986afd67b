// SPDX-License-Identifier: Apache-2.0
// What a ray has hit: place, material, and what lies on either side.
#ifndef TYNDALL_PATH_SURFACE_GLSL
#define TYNDALL_PATH_SURFACE_GLSL

#include "geometry/motion.glsl"
#include "geometry/offset.glsl"
#include "material/normal.glsl"
#include "material/resolve.glsl"
#include "passes/path/scatter.glsl"

struct HitAttributes {
  SurfacePoint place; // normal: geometric, of the front
  vec3 normal;        // interpolated, unit
  vec3 tangent;       // along growing u, not unit; 0 without textures
  vec2 uv;
  uint material;
  uint emitter;       // or kNoEmitter
};

SurfaceHit hitOf() {
  return SurfaceHit(path.hit.t, path.hit.primitive, path.hit.instance, path.hit.place, false);
}

vec2 triangleUv(SurfacesPtr surfaces, uint triangle, vec2 place) {
  TrianglePtr triangles = surfaces.at[0].triangles;
  VertexPtr vertices = surfaces.at[0].vertices;
  const vec2 uv0 = vertices.at[triangles.at[triangle].vertices[0]].uv;
  const vec2 uv1 = vertices.at[triangles.at[triangle].vertices[1]].uv;
  const vec2 uv2 = vertices.at[triangles.at[triangle].vertices[2]].uv;
  return uv0 + place.x * (uv1 - uv0) + place.y * (uv2 - uv0);
}

// In the triangle's own space.
vec3 triangleNormal(SurfacesPtr surfaces, uint triangle, vec2 place, vec3 geometric) {
  TrianglePtr triangles = surfaces.at[0].triangles;
  VertexPtr vertices = surfaces.at[0].vertices;
  const vec3 n0 = vertices.at[triangles.at[triangle].vertices[0]].normal;
  const vec3 n1 = vertices.at[triangles.at[triangle].vertices[1]].normal;
  const vec3 n2 = vertices.at[triangles.at[triangle].vertices[2]].normal;
  const vec3 sum = n0 + place.x * (n1 - n0) + place.y * (n2 - n0);
  const float squared = dot(sum, sum);
  return squared > 1e-12 ? sum * inversesqrt(squared) : geometric;
}

// Derivative of the position by u; 0 where the texture is not spread out.
vec3 triangleTangent(SurfacesPtr surfaces, uint primitive, uint triangle) {
  BvhPrimitivePtr primitives = surfaces.at[0].primitives;
  TrianglePtr triangles = surfaces.at[0].triangles;
  VertexPtr vertices = surfaces.at[0].vertices;
  const vec3 edge1 = primitives.at[primitive].v1 - primitives.at[primitive].v0;
  const vec3 edge2 = primitives.at[primitive].v2 - primitives.at[primitive].v0;
  const vec2 uv0 = vertices.at[triangles.at[triangle].vertices[0]].uv;
  const vec2 uv1 = vertices.at[triangles.at[triangle].vertices[1]].uv - uv0;
  const vec2 uv2 = vertices.at[triangles.at[triangle].vertices[2]].uv - uv0;
  const float area = uv1.x * uv2.y - uv1.y * uv2.x;
  return area == 0.0 ? vec3(0.0) : (uv2.y * edge1 - uv1.y * edge2) * sign(area);
}

HitAttributes hitAttributes(ScenePtr scene) {
  SurfacesPtr surfaces = scene.at[0].surfaces;
  HitAttributes hit;
  hit.place = surfacePoint(surfaces, hitOf(), path.ray.origin, path.ray.direction);
  hit.normal = hit.place.normal;
  hit.tangent = vec3(0.0);
  hit.uv = vec2(0.0);
  const uint id = surfaces.at[0].primitives.at[path.hit.primitive].id;
  const uint index = id & kPrimitiveIndexMask;
  if (kSpheres && (id & kPrimitiveKindMask) == kPrimitiveSphere) {
    hit.material = surfaces.at[0].spheres.at[index].material;
    hit.emitter = surfaces.at[0].spheres.at[index].emitter;
    return hit;
  }
  hit.material = surfaces.at[0].triangles.at[index].material;
  hit.emitter = surfaces.at[0].triangles.at[index].emitter;
  const bool instanced = kInstances && path.hit.instance != kNoInstance;
  const vec3 normal = triangleNormal(surfaces, index, path.hit.place, vec3(0.0));
  if (normal != vec3(0.0)) {
    hit.normal = normal;
    if (instanced) {
      hit.normal = normalize(normal * mat3(surfaces.at[0].instances.at[path.hit.instance].objectFromWorld));
    }
  }
  if (kTextures) {
    hit.uv = triangleUv(surfaces, index, path.hit.place);
    hit.tangent = triangleTangent(surfaces, path.hit.primitive, index);
    if (instanced) {
      hit.tangent = mat3(surfaces.at[0].instances.at[path.hit.instance].worldFromObject) * hit.tangent;
    }
  }
  return hit;
}

// Where the point that was hit has been in the previous frame.
vec3 placeBefore(ScenePtr scene, HitAttributes hit) {
  if (!kGuideMotion) {
    return hit.place.position;
  }
  SurfacesPtr surfaces = scene.at[0].surfaces;
  const uint id = surfaces.at[0].primitives.at[path.hit.primitive].id;
  const uint index = id & kPrimitiveIndexMask;
  uint motion;
  if (kSpheres && (id & kPrimitiveKindMask) == kPrimitiveSphere) {
    motion = surfaces.at[0].spheres.at[index].motion;
  } else if (kInstances && path.hit.instance != kNoInstance) {
    motion = surfaces.at[0].instances.at[path.hit.instance].motion;
  } else {
    motion = surfaces.at[0].triangles.at[index].motion;
  }
  return previousPlace(surfaces, motion, hit.place.position);
}

float iorOf(SurfacesPtr surfaces, uint interior) {
  return interior == kNoInterior ? 1.0 : surfaces.at[0].interiors.at[interior].ior;
}

// The interiors in front of a surface and behind it, from those that the ray comes through.
uvec2 sidesOf(uint interiors, uint own) {
  return own == kNoInterior ? uvec2(interiors) : uvec2(interiors & ~(1u << own), interiors | (1u << own));
}

// Whether a ray goes through a surface as if it were not there, and the ray behind it.
struct SurfacePass {
  bool passes;
  PathRay beyond;
};

// It passes a medium's container, a hole, and a refracting boundary inside another object that decides.
SurfacePass surfacePass(ScenePtr scene, HitAttributes hit, inout Rng rng) {
  SurfacesPtr surfaces = scene.at[0].surfaces;
  MaterialPtr materials = surfaces.at[0].materials;
  const uint own = kInteriors ? materials.at[hit.material].interior : kNoInterior;
  const uvec2 sides = sidesOf(path.ray.interiors, own);
  const uint model = materials.at[hit.material].model;
  SurfacePass result;
  result.passes = model == kMaterialNull;
  if (kInteriors && model == kMaterialDielectric && own != kNoInterior) {
    const uint other = decidingInterior(surfaces, sides.x);
    result.passes = kPlantedBug != kBugNoPriority && other != kNoInterior &&
                    decidingInterior(surfaces, sides.y) == other; // also with this one
  }
  const float opacity = materialOpacity(materials, hit.material, surfaces.at[0].textures, hit.uv);
  const bool hole = opacity < 1.0 && !(rngFloat(rng) < opacity);
  result.beyond = path.ray;
  result.beyond.origin = offsetOrigin(hit.place, path.ray.direction);
  if (path.ray.tMax < kInfiniteDistance) {
    result.beyond.tMax = path.ray.tMax - path.hit.t;
  }
  result.beyond.interiors = dot(path.ray.direction, hit.place.normal) < 0.0 ? sides.y : sides.x;
  result.passes = result.passes || hole;
  return result;
}

struct SurfaceVertex {
  ScatterPoint scatter;
  vec3 emission;       // towards where the path comes from [W/(m2 sr)]
  uint emitter;
  vec3 frontNormal;    // geometric
};

SurfaceVertex surfaceVertex(ScenePtr scene, HitAttributes hit) {
  SurfacesPtr surfaces = scene.at[0].surfaces;
  MaterialPtr materials = surfaces.at[0].materials;
  const vec3 wo = -path.ray.direction;
  const bool front = dot(wo, hit.place.normal) > 0.0;
  const uint own = kInteriors ? materials.at[hit.material].interior : kNoInterior;
  const uvec2 sides = sidesOf(path.ray.interiors, own);
  const uint model = materials.at[hit.material].model;
  const bool transmits = model == kMaterialDielectric;
  float etaRatio = materials.at[hit.material].ior;
  if (kInteriors && transmits && own != kNoInterior) {
    etaRatio = iorOf(surfaces, own) / iorOf(surfaces, decidingInterior(surfaces, sides.x));
  }
  const ResolvedMaterial resolved =
      resolveMaterial(materials, hit.material, surfaces.at[0].textures, hit.uv, etaRatio);
  SurfaceVertex vertex;
  vertex.frontNormal = hit.place.normal;
  vertex.emitter = hit.emitter;
  const bool shines = front || (materials.at[hit.material].flags & kMaterialTwoSided) != 0u;
  vertex.emission = shines ? resolved.emission : vec3(0.0);
  // Opaque surfaces are the same from both sides: their frame is turned to the path.
  const bool turned = !transmits && !front;
  vertex.scatter.place = hit.place;
  vertex.scatter.before = placeBefore(scene, hit);
  if (turned) {
    vertex.scatter.place.normal = -hit.place.normal;
  }
  vec3 normal = turned ? -hit.normal : hit.normal;
  mat3 frame = frameAbout(normal);
  if (kTextures && hit.tangent != vec3(0.0)) {
    const vec3 along = hit.tangent - dot(hit.tangent, normal) * normal;
    if (dot(along, along) > 0.0) {
      const vec3 tangent = normalize(along);
      const vec3 up = cross(normal, tangent);
      frame = mat3(tangent, up, normal);
    }
  }
  normal = perturbNormal(resolved.normal, frame, vertex.scatter.place.normal, wo);
  vertex.scatter.frame = frameAbout(normal);
  vertex.scatter.incoming = path.ray.direction;
  vertex.scatter.bsdf = resolved.bsdf;
  vertex.scatter.surface = true;
  vertex.scatter.flightT = -1.0;
  vertex.scatter.transmits = transmits;
  vertex.scatter.above = turned ? sides.y : sides.x;
  vertex.scatter.below = turned ? sides.x : sides.y;
  return vertex;
}

#endif
