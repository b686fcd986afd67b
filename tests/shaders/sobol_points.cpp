// SPDX-License-Identifier: Apache-2.0
#include "shaders/sobol_points.h"

#include "support/probe.h"
#include "support/statistics.h"

// Needs <cstdint> before it.
#include "kernels/sobol_probe.h"

#include <algorithm>

namespace tyndall::test::sobol {
namespace {

/// By the recurrence of [Joe08] section 2.
FourDirections sobolDirections(const Polynomial& polynomial) {
  const std::size_t degree = polynomial.m.size();
  std::vector<std::uint32_t> m = polynomial.m;
  while (m.size() < 4) {
    const std::size_t k = m.size();
    std::uint32_t next = (m[k - degree] << degree) ^ m[k - degree];
    for (std::size_t j = 1; j < degree; ++j) {
      next ^= ((polynomial.inner >> (degree - 1 - j)) & 1u) * (m[k - j] << j);
    }
    m.push_back(next);
  }
  return {m[0] << 3, m[1] << 2, m[2] << 1, m[3]};
}

} // namespace

Draw draw(const Request& request) {
  struct Push {
    interop::Ptr<std::uint32_t> words;
    std::uint32_t count;
    std::uint32_t width;
    std::uint32_t firstDimension;
    std::uint32_t dimensions;
  };
  const ProbeRunner probe(k_sobol_probe_spirv, {{0, request.mode}, {1, request.planted}});
  const auto out = ProbeRunner::results<std::uint32_t>(kPoints * request.sets * request.dimensions);
  probe.run(Push{out.ptr(), request.sets, kWidth, request.first, request.dimensions}, request.sets);
  return {request.dimensions, ProbeRunner::download(out)};
}

double uniformPValue(const std::vector<std::uint64_t>& counts) {
  return chiSquaredPValue(counts, std::vector<double>(counts.size(), 1.0 / static_cast<double>(counts.size())));
}

std::uint32_t sobolPoint(const FourDirections& directions, std::uint32_t index) {
  std::uint32_t digits = 0;
  for (std::size_t bit = 0; bit < 4; ++bit) {
    digits ^= ((index >> bit) & 1u) * directions[bit];
  }
  return digits;
}

FourDirections expectedDirections(std::uint32_t d, const Polynomial& polynomial) {
  // Van der Corput: no polynomial, all m are 1.
  const FourDirections first{8, 4, 2, 1};
  const FourDirections second = sobolDirections(polynomial);
  if (d >= 3) {
    return d % 2 == 1 ? first : second;
  }
  const FourDirections& own = d == 0 ? first : (d == 1 ? second : FourDirections{1, 2, 4, 8});
  FourDirections result{};
  std::ranges::transform(std::array{7u, 9u, 2u, 1u}, result.begin(),
                         [&](std::uint32_t i) { return sobolPoint(own, i); });
  return result;
}

} // namespace tyndall::test::sobol
