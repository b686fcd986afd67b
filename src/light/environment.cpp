// SPDX-License-Identifier: Apache-2.0
#include "light/environment.h"

#include "base/error.h"
#include "light/alias_table.h"
#include "math/colour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tyndall::light {
namespace {

constexpr glm::uvec2 kMaxCells{1024, 512};

/// The texel with bad channels set to 0; counts it in `bad` if there was one.
glm::vec3 sanitised(const glm::vec3& texel, double scale, std::size_t& bad) {
  glm::vec3 result(0.0f);
  bool good = true;
  for (int c = 0; c < 3; ++c) {
    const double value = static_cast<double>(texel[c]) * scale;
    const bool usable = value >= 0.0 && value <= static_cast<double>(std::numeric_limits<float>::max());
    result[c] = usable ? static_cast<float>(value) : 0.0f;
    good = good && usable;
  }
  bad += good ? 0 : 1;
  return result;
}

/// Mean luminance over the square of texel (x, y): the bilinear interpolant's integral is a tensor product of
/// (1/8, 3/4, 1/8) over the neighbours.
double meanLuminance(const std::vector<double>& luminances, const glm::ivec2& size, int x, int y) {
  constexpr double kWeights[3] = {0.125, 0.75, 0.125};
  double sum = 0.0;
  for (int dy = -1; dy <= 1; ++dy) {
    const int row = std::clamp(y + dy, 0, size.y - 1);
    for (int dx = -1; dx <= 1; ++dx) {
      const int column = (x + dx + size.x) % size.x;
      const std::size_t index = static_cast<std::size_t>(row) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(column);
      sum += kWeights[dx + 1] * kWeights[dy + 1] * luminances[index];
    }
  }
  return sum;
}

/// Which cells texel `i` of `count` covers, of `cells` over the same length (cells <= count: two at most), and the
/// fraction of the texel in the first of them.
struct Cover {
  std::uint32_t first;
  std::uint32_t second;
  double inFirst;
};

Cover coverOf(std::uint32_t i, std::uint32_t count, std::uint32_t cells) {
  // In units where a texel is `cells` long and a cell is `count` long, all is exact.
  const std::uint64_t begin = std::uint64_t(i) * cells;
  const std::uint64_t first = begin / count;
  const std::uint64_t border = (first + 1) * count;
  if (begin + cells <= border) {
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first), 1.0};
  }
  return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first + 1), double(border - begin) / double(cells)};
}

/// Power of each cell; texels that straddle a border give each side its share of the area.
std::vector<double> cellWeights(const EnvironmentTable& table) {
  std::vector<double> luminances(table.texels.size());
  std::transform(table.texels.begin(), table.texels.end(), luminances.begin(),
                 [](const glm::vec3& texel) { return luminance(glm::dvec3(texel)); });
  std::vector<double> weights(std::size_t(table.cellCount.x) * table.cellCount.y, 0.0);
  for (std::uint32_t y = 0; y < table.size.y; ++y) {
    const double step = std::numbers::pi / table.size.y;
    const double solidAngle = 2.0 * std::numbers::pi / table.size.x * (std::cos(y * step) - std::cos((y + 1) * step));
    const Cover row = coverOf(y, table.size.y, table.cellCount.y);
    for (std::uint32_t x = 0; x < table.size.x; ++x) {
      const double power = solidAngle * meanLuminance(luminances, glm::ivec2(table.size), int(x), int(y));
      const Cover column = coverOf(x, table.size.x, table.cellCount.x);
      double* upper = &weights[std::size_t(row.first) * table.cellCount.x];
      double* lower = &weights[std::size_t(row.second) * table.cellCount.x];
      upper[column.first] += power * row.inFirst * column.inFirst;
      upper[column.second] += power * row.inFirst * (1.0 - column.inFirst);
      lower[column.first] += power * (1.0 - row.inFirst) * column.inFirst;
      lower[column.second] += power * (1.0 - row.inFirst) * (1.0 - column.inFirst);
    }
  }
  return weights;
}

} // namespace

EnvironmentTable makeEnvironment(std::span<const glm::vec3> texels, const glm::uvec2& size, double scale) {
  TYNDALL_CHECK(size.x > 0 && size.y > 0 && texels.size() == std::size_t(size.x) * size.y);
  EnvironmentTable table;
  table.size = size;
  table.cellCount = glm::min(size, kMaxCells);
  table.texels.reserve(texels.size());
  for (const glm::vec3& texel : texels) {
    table.texels.push_back(sanitised(texel, scale, table.badTexels));
  }
  const std::vector<double> weights = cellWeights(table);
  for (const double weight : weights) {
    table.power += weight;
  }
  table.cells = makeAliasTable(weights);
  return table;
}

interop::EnvironmentMap deviceMap(const EnvironmentTable& table, double rotation, interop::Ptr<glm::vec3> texels,
                                  interop::Ptr<interop::AliasEntry> cells) {
  const glm::dvec2 count(table.cellCount);
  // cos a - cos b = 2 sin((a + b) / 2) sin((b - a) / 2): exact for the middle's sine.
  const double solidAngle = 2.0 * std::numbers::pi / count.x * 2.0 * std::sin(0.5 * std::numbers::pi / count.y);
  return {.texels = texels,
          .cells = cells,
          .size = table.size,
          .cellCount = table.cellCount,
          .rotation = static_cast<float>(rotation / 360.0),
          .cellSolidAngle = static_cast<float>(solidAngle)};
}

} // namespace tyndall::light
