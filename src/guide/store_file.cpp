// SPDX-License-Identifier: Apache-2.0
#include "guide/store_file.h"

#include "base/error.h"

#include <cstddef>
#include <cstring>

namespace tyndall::guide {
namespace {

/// What another layout of cells or of this file changes.
constexpr std::uint64_t kLayout = 0x74'6e69'6168 + (std::uint64_t(sizeof(interop::GuideCell)) << 40) +
                                  (std::uint64_t(sizeof(interop::ChainState)) << 48) +
                                  (std::uint64_t(sizeof(interop::RadianceCell) + sizeof(interop::ScreenChain)) << 56);

struct Header {
  std::uint64_t layout = kLayout;
  StoreSize size;
  std::uint32_t round = 0;
  std::uint32_t cells = 0; ///< that follow, each with its index and states; then those of the cache, then all of the
                           ///< screen, then distance chains and what is learnt of their share
  std::uint32_t radiance = 0;
};

class Writer {
public:
  explicit Writer(std::size_t bytes) { bytes_.reserve(bytes); }
  void put(const void* data, std::size_t count) {
    const auto* first = static_cast<const std::byte*>(data);
    bytes_.insert(bytes_.end(), first, first + count);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

private:
  std::vector<std::byte> bytes_;
};

class Reader {
public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  void get(void* data, std::size_t count) {
    check(count <= bytes_.size());
    std::memcpy(data, bytes_.data(), count);
    bytes_ = bytes_.subspan(count);
  }
  void check(bool sound) const {
    if (!sound) {
      fail("these are not the chains of a guided render, or those of another version of this program");
    }
  }
  void checkEnd() const { check(bytes_.empty()); }

private:
  std::span<const std::byte> bytes_;
};

/// Equal parts of a table, one for each cell. A fingerprint comes first in both kinds of cells; 0: free.
struct Table {
  std::span<const std::byte> cells;
  std::size_t cellBytes;

  std::size_t count() const { return cells.size() / cellBytes; }
  bool taken(std::size_t index) const {
    std::uint32_t fingerprint = 0;
    std::memcpy(&fingerprint, cells.data() + index * cellBytes, sizeof(fingerprint));
    return fingerprint != 0;
  }
  std::uint32_t takenCount() const {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      number += taken(i) ? 1 : 0;
    }
    return number;
  }
};

static_assert(offsetof(interop::GuideCell, fingerprint) == 0 && offsetof(interop::RadianceCell, fingerprint) == 0);

} // namespace

std::vector<std::byte> packStore(const StoreContent& content) {
  const Table cells{content.cells, sizeof(interop::GuideCell)};
  const Table radiance{content.radiance, sizeof(interop::RadianceCell)};
  const std::size_t stateBytes = content.size.states * sizeof(interop::ChainState);
  Header header;
  header.size = content.size;
  header.round = content.round;
  header.cells = cells.takenCount();
  header.radiance = radiance.takenCount();
  Writer writer(sizeof(header) + header.cells * (sizeof(std::uint32_t) + cells.cellBytes + stateBytes) +
                header.radiance * (sizeof(std::uint32_t) + radiance.cellBytes) + content.screen.size() +
                content.distances.size() + content.distanceShares.size());
  writer.put(&header, sizeof(header));
  for (std::uint32_t i = 0; i < cells.count(); ++i) {
    if (cells.taken(i)) {
      writer.put(&i, sizeof(i));
      writer.put(content.cells.data() + i * cells.cellBytes, cells.cellBytes);
      writer.put(content.states.data() + i * stateBytes, stateBytes);
    }
  }
  for (std::uint32_t i = 0; i < radiance.count(); ++i) {
    if (radiance.taken(i)) {
      writer.put(&i, sizeof(i));
      writer.put(content.radiance.data() + i * radiance.cellBytes, radiance.cellBytes);
    }
  }
  writer.put(content.screen.data(), content.screen.size());
  writer.put(content.distances.data(), content.distances.size());
  writer.put(content.distanceShares.data(), content.distanceShares.size());
  return writer.take();
}

StoreContent unpackStore(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  Header header;
  reader.get(&header, sizeof(header));
  reader.check(header.layout == kLayout);
  const std::size_t cellCount = std::size_t(header.size.cells) + header.size.staticCells;
  const std::size_t stateBytes = header.size.states * sizeof(interop::ChainState);
  StoreContent content;
  content.size = header.size;
  content.round = header.round;
  content.cells.resize(cellCount * sizeof(interop::GuideCell));
  content.states.resize(cellCount * stateBytes);
  content.radiance.resize(header.size.radiance * sizeof(interop::RadianceCell));
  for (std::uint32_t i = 0; i < header.cells; ++i) {
    std::uint32_t index = 0;
    reader.get(&index, sizeof(index));
    reader.check(index < cellCount);
    reader.get(content.cells.data() + index * sizeof(interop::GuideCell), sizeof(interop::GuideCell));
    reader.get(content.states.data() + index * stateBytes, stateBytes);
  }
  for (std::uint32_t i = 0; i < header.radiance; ++i) {
    std::uint32_t index = 0;
    reader.get(&index, sizeof(index));
    reader.check(index < header.size.radiance);
    reader.get(content.radiance.data() + index * sizeof(interop::RadianceCell), sizeof(interop::RadianceCell));
  }
  content.screen.resize(header.size.screen * sizeof(interop::ScreenChain));
  reader.get(content.screen.data(), content.screen.size());
  content.distances.resize(header.size.distanceVertices() * header.size.distanceStates *
                           sizeof(interop::DistanceState));
  reader.get(content.distances.data(), content.distances.size());
  content.distanceShares.resize(header.size.distanceVertices() * sizeof(interop::DistanceShare));
  reader.get(content.distanceShares.data(), content.distanceShares.size());
  reader.checkEnd();
  return content;
}

} // namespace tyndall::guide
