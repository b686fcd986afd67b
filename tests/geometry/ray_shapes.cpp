// SPDX-License-Identifier: Apache-2.0
#include "geometry/ray_world.h"

#include <array>

namespace tyndall::test {

geometry::BvhInput triangle(const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2, std::uint32_t index,
                            bool opaque) {
  const std::uint32_t flags = opaque ? interop::kPrimitiveOpaque : 0u;
  return {{v0, v1, v2, interop::kPrimitiveTriangle | flags | index}, {}};
}

geometry::BvhInput sphere(const glm::vec3& centre, float radius, std::uint32_t index, bool opaque) {
  const std::uint32_t flags = opaque ? interop::kPrimitiveOpaque : 0u;
  return {{centre, glm::vec3(radius, 0.0f, 0.0f), glm::vec3(0.0f), interop::kPrimitiveSphere | flags | index}, {}};
}

Soup randomTriangles(std::size_t count, float size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  const auto point = [&] {
    const float x = uniform(random);
    const float y = uniform(random);
    return glm::vec3(x, y, uniform(random));
  };
  Soup soup;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 centre = point();
    const glm::vec3 v0 = centre + size * point();
    const glm::vec3 v1 = centre + size * point();
    soup.push_back(triangle(v0, v1, centre + size * point(), static_cast<std::uint32_t>(i), i % 3 != 0));
  }
  return soup;
}

Soup closedBox(const glm::vec3& halfSize, int cellsPerEdge) {
  Soup soup;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const float side = face % 2 == 0 ? -1.0f : 1.0f;
    const auto corner = [&](int i, int j) {
      glm::vec3 point;
      point[axis] = side;
      point[(axis + 1) % 3] = float(2 * i - cellsPerEdge) / float(cellsPerEdge);
      point[(axis + 2) % 3] = float(2 * j - cellsPerEdge) / float(cellsPerEdge);
      return point * halfSize;
    };
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
      const auto index = static_cast<std::uint32_t>(soup.size());
      soup.push_back(side > 0.0f ? triangle(a, b, c, index) : triangle(a, c, b, index));
    };
    for (int i = 0; i < cellsPerEdge; ++i) {
      for (int j = 0; j < cellsPerEdge; ++j) {
        add(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1));
        add(corner(i, j), corner(i + 1, j + 1), corner(i, j + 1));
      }
    }
  }
  return soup;
}

Soup icosphere(int subdivisions) {
  // An octahedron, whose edges are halved again and again. A midpoint is the same for both of its triangles.
  std::vector<std::array<glm::vec3, 3>> faces;
  for (int octant = 0; octant < 8; ++octant) {
    const glm::vec3 x((octant & 1) != 0 ? 1.0f : -1.0f, 0.0f, 0.0f);
    const glm::vec3 y(0.0f, (octant & 2) != 0 ? 1.0f : -1.0f, 0.0f);
    const glm::vec3 z(0.0f, 0.0f, (octant & 4) != 0 ? 1.0f : -1.0f);
    const bool even = x.x * y.y * z.z > 0.0f;
    faces.push_back(even ? std::array{x, y, z} : std::array{x, z, y});
  }
  const auto middle = [](const glm::vec3& a, const glm::vec3& b) { return glm::normalize(a + b); };
  for (int level = 0; level < subdivisions; ++level) {
    std::vector<std::array<glm::vec3, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const glm::vec3 ab = middle(a, b);
      const glm::vec3 bc = middle(b, c);
      const glm::vec3 ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  Soup soup;
  for (const auto& [a, b, c] : faces) {
    soup.push_back(triangle(a, b, c, static_cast<std::uint32_t>(soup.size())));
  }
  return soup;
}

Soup moved(Soup soup, float scale, const glm::vec3& shift) {
  for (geometry::BvhInput& input : soup) {
    const bool isSphere = (input.primitive.id & interop::kPrimitiveKindMask) == interop::kPrimitiveSphere;
    input.primitive.v0 = input.primitive.v0 * scale + shift;
    input.primitive.v1 = input.primitive.v1 * scale + (isSphere ? glm::vec3(0.0f) : shift);
    input.primitive.v2 = input.primitive.v2 * scale + shift;
  }
  return soup;
}

} // namespace tyndall::test
