// SPDX-License-Identifier: Apache-2.0
#include "guide/log_order.h"

#include "base/error.h"

#include <algorithm>
#include <numeric>

namespace tyndall::guide {
namespace {

struct Entry {
  std::uint32_t window; ///< those of the cache come after all others
  std::uint32_t kind;
  std::uint32_t place;
};

std::uint32_t windowsOfChains(const WindowLayout& layout) {
  return (layout.size.cells + layout.size.staticCells) / layout.window;
}

std::size_t windowCount(const WindowLayout& layout) {
  return std::size_t(windowsOfChains(layout)) + layout.size.radiance / layout.window;
}

std::uint32_t windowOf(const interop::GuideUpdate& update, const WindowLayout& layout) {
  switch (update.kind) {
  case interop::kUpdateSample:
  case interop::kUpdateMiss:
    return update.place / layout.size.states / layout.window;
  case interop::kUpdateRadiance:
    return windowsOfChains(layout) + update.place / layout.window;
  default:
    return update.place / layout.window;
  }
}

/// Where each bucket begins, and the end.
template <class Bucket>
std::vector<std::uint32_t> beginnings(const std::vector<Entry>& entries, std::size_t buckets, const Bucket& bucketOf) {
  std::vector<std::uint32_t> first(buckets + 1);
  for (const Entry& entry : entries) {
    ++first[bucketOf(entry) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

/// By bucket; those of one bucket stay in their order. Updates are many and windows few: comparing them takes twice as
/// long.
template <class Bucket>
std::vector<Entry> sorted(const std::vector<Entry>& entries, std::size_t buckets, const Bucket& bucketOf) {
  std::vector<std::uint32_t> next = beginnings(entries, buckets, bucketOf);
  std::vector<Entry> result(entries.size());
  for (const Entry& entry : entries) {
    result[next[bucketOf(entry)]++] = entry;
  }
  return result;
}

} // namespace

LogOrder logOrder(std::span<const interop::GuideUpdate> log, std::span<const std::uint32_t> counts,
                  std::uint32_t perPixel, const WindowLayout& layout) {
  TYNDALL_CHECK(counts.size() * perPixel <= log.size());
  std::vector<Entry> entries;
  entries.reserve(std::reduce(counts.begin(), counts.end(), std::size_t(0)));
  for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
    TYNDALL_CHECK(counts[pixel] <= perPixel);
    for (std::size_t place = pixel * perPixel; place < pixel * perPixel + counts[pixel]; ++place) {
      entries.push_back({windowOf(log[place], layout), log[place].kind, static_cast<std::uint32_t>(place)});
    }
  }
  const auto windowOfEntry = [](const Entry& entry) { return std::size_t(entry.window); };
  entries = sorted(entries, interop::kUpdateKinds, [](const Entry& entry) { return std::size_t(entry.kind); });
  entries = sorted(entries, windowCount(layout), windowOfEntry);
  LogOrder order;
  order.first = beginnings(entries, windowCount(layout), windowOfEntry);
  order.first.erase(std::unique(order.first.begin(), order.first.end()), order.first.end()); // windows without any
  order.places.reserve(entries.size());
  for (const Entry& entry : entries) {
    order.places.push_back(entry.place);
  }
  return order;
}

} // namespace tyndall::guide
