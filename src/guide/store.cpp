// SPDX-License-Identifier: Apache-2.0
#include "guide/store.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace tyndall::guide {
namespace {

/// Cells for each pixel: those around what the camera sees, and on coarser levels.
constexpr double kCellsPerPixel = 2.0;
constexpr double kFewestCells = 16384.0;
constexpr double kMostCells = 4194304.0;
/// Of the adaptive grid's number.
constexpr double kStaticShare = 0.25;
constexpr double kRadianceShare = 0.5;

std::uint32_t wholeWindows(double cells, std::uint32_t window) {
  return std::max(static_cast<std::uint32_t>(cells) / window, 1u) * window;
}

template <class T>
std::vector<std::byte> contentOf(const gpu::Buffer<T>& buffer) {
  std::vector<std::byte> bytes(buffer.size() * sizeof(T));
  buffer.read(bytes);
  return bytes;
}

template <class T>
std::span<const T> as(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
}

bool sound(const interop::ChainState& state) {
  return std::isfinite(state.weight) && state.weight <= 1e30f && std::isfinite(state.spread) &&
         std::isfinite(state.time) && std::isfinite(state.target.x) && std::isfinite(state.target.y) &&
         std::isfinite(state.target.z);
}

bool sound(const interop::DistanceState& state) {
  return std::isfinite(state.weight) && std::isfinite(state.mean) && std::isfinite(state.variance) &&
         std::isfinite(state.count);
}

/// Before there are cells. As published some hundredths of what those take.
void addDistances(StoreSize& size, const scene::GuideSettings& settings, const glm::uvec2& picture, double bytes) {
  const glm::uvec2 vertices = glm::uvec2(glm::dvec2(picture) / settings.distanceWidth) + 2u; // around every pixel
  size.distanceColumns = vertices.x;
  size.distanceRows = vertices.y;
  size.distanceStates = settings.distanceStates;
  const double own = storeBytes(size);
  if (own > bytes) {
    fail("distance chains take {:.4g} MB for this picture, where {:.4g} MB are left for chains; raise "
         "guide.distance_width, lower guide.distance_states, or allow more memory",
         1e-6 * own, 1e-6 * bytes);
  }
}

} // namespace

StoreSize storeSize(const scene::GuideSettings& settings, const glm::uvec2& picture, double bytes) {
  const std::size_t pixels = std::size_t(picture.x) * picture.y;
  StoreSize size;
  if (settings.preset == scene::Integrator::ScreenChains) {
    size.screen = static_cast<std::uint32_t>(pixels);
    if (storeBytes(size) > bytes) {
      fail("chains in screen space take {:.4g} MB for this picture, where {:.4g} MB are left for chains; allow more "
           "memory, or render a smaller picture",
           1e-6 * storeBytes(size), 1e-6 * bytes);
    }
    return size;
  }
  size.states = settings.states;
  const double perCell = double(sizeof(interop::GuideCell) + settings.states * sizeof(interop::ChainState));
  const double cache = settings.score == scene::GuideScore::Cache ? kRadianceShare : 0.0;
  const double grids = settings.staticGrid ? 1.0 + kStaticShare : 1.0;
  if (scene::guidesDistances(settings)) {
    addDistances(size, settings, picture, bytes);
  }
  const double most = (bytes - storeBytes(size)) / (grids * perCell + cache * sizeof(interop::RadianceCell));
  const double wanted =
      settings.slots > 0 ? settings.slots : std::clamp(kCellsPerPixel * double(pixels), kFewestCells, kMostCells);
  const double cells = std::min(wanted, most);
  size.cells = wholeWindows(cells, settings.window);
  size.staticCells = settings.staticGrid ? wholeWindows(kStaticShare * cells, settings.window) : 0;
  size.radiance = cache > 0.0 ? wholeWindows(cache * cells, settings.window) : 0;
  return size;
}

double storeBytes(const StoreSize& size) {
  const double cells = double(size.cells) + size.staticCells;
  return cells * double(sizeof(interop::GuideCell) + size.states * sizeof(interop::ChainState)) +
         size.radiance * double(sizeof(interop::RadianceCell)) + size.screen * double(sizeof(interop::ScreenChain)) +
         double(size.distanceVertices()) *
             double(size.distanceStates * sizeof(interop::DistanceState) + sizeof(interop::DistanceShare));
}

Store::Store(const gpu::Device& device, const StoreSize& size)
    : size_(size), cells_(device, std::size_t(size.cells) + size.staticCells, gpu::Memory::Device),
      states_(device, cells_.size() * size.states, gpu::Memory::Device),
      radiance_(device, size.radiance, gpu::Memory::Device), screen_(device, size.screen, gpu::Memory::Device),
      distances_(device, size.distanceVertices() * size.distanceStates, gpu::Memory::Device),
      distanceShares_(device, size.distanceVertices(), gpu::Memory::Device) {
  clear();
}

void Store::clear() {
  cells_.fillZero();
  states_.fillZero();
  radiance_.fillZero();
  screen_.fillZero();
  distances_.fillZero();
  distanceShares_.fillZero();
  round_ = 0;
}

StoreContent Store::content() const {
  return {size_,
          round_,
          contentOf(cells_),
          contentOf(states_),
          contentOf(radiance_),
          contentOf(screen_),
          contentOf(distances_),
          contentOf(distanceShares_)};
}

void Store::restore(const StoreContent& content) {
  if (!(content.size == size_)) {
    fail("the chains that were saved fill another store ({} cells of {} states, now {} of {}); give the --memory that "
         "they were learnt with, or render without --resume",
         content.size.cells, content.size.states, size_.cells, size_.states);
  }
  cells_.write(as<interop::GuideCell>(content.cells));
  states_.write(as<interop::ChainState>(content.states));
  radiance_.write(as<interop::RadianceCell>(content.radiance));
  screen_.write(as<interop::ScreenChain>(content.screen));
  distances_.write(as<interop::DistanceState>(content.distances));
  distanceShares_.write(as<interop::DistanceShare>(content.distanceShares));
  round_ = content.round;
}

std::vector<interop::DistanceState> Store::distances() const {
  std::vector<interop::DistanceState> states(distances_.size());
  distances_.read(std::as_writable_bytes(std::span(states)));
  return states;
}

void Store::setDistances(std::span<const interop::DistanceState> states) { distances_.write(states); }

Occupancy Store::occupancy() const {
  const StoreContent now = content();
  Occupancy result;
  std::size_t index = 0;
  for (const interop::GuideCell& cell : as<interop::GuideCell>(now.cells)) {
    (index++ < size_.cells ? result.cells : result.staticCells) += cell.fingerprint != 0 ? 1 : 0;
  }
  const auto count = [&result](const interop::ChainState& state) {
    result.states += state.weight > 0.0f ? 1 : 0;
    result.unsound += sound(state) ? 0 : 1;
  };
  for (const interop::ChainState& state : as<interop::ChainState>(now.states)) {
    count(state);
  }
  for (const interop::ScreenChain& chain : as<interop::ScreenChain>(now.screen)) {
    count(chain.state);
  }
  for (const interop::DistanceState& state : as<interop::DistanceState>(now.distances)) {
    result.distances += state.weight > 0.0f ? 1 : 0;
    result.unsound += sound(state) ? 0 : 1;
  }
  for (const interop::RadianceCell& cell : as<interop::RadianceCell>(now.radiance)) {
    result.radiance += cell.fingerprint != 0 ? 1 : 0;
  }
  return result;
}

void Store::describe(interop::Guide& guide) const {
  guide.cells = cells_.ptr();
  guide.states = states_.ptr();
  guide.radiance = radiance_.ptr();
  guide.screen = screen_.ptr();
  guide.distance.states = distances_.ptr();
  guide.distance.shares = distanceShares_.ptr();
  guide.distance.columns = size_.distanceColumns;
  guide.distance.statesEach = size_.distanceStates;
  guide.cellCount = size_.cells;
  guide.staticCount = size_.staticCells;
  guide.radianceCount = size_.radiance;
  guide.round = round_;
}

} // namespace tyndall::guide
