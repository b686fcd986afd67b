// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/device.h"
#include "interop/interop.h"

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace tyndall::gpu {

/// Where a buffer lives. Host memory can be mapped and is what the device's results are read from.
enum class Memory { Device, Host };

/// What a buffer holds; the last two only on devices that have ray queries.
enum class BufferUse {
  Data,
  RayGeometry, ///< what acceleration structures are built from
  RayTree      ///< an acceleration structure
};

/// Bytes on the device, reached by address.
class RawBuffer {
public:
  RawBuffer();
  /// @throws Error on exhausted memory, with the bytes asked for and what to do.
  RawBuffer(const Device& device, std::size_t bytes, Memory memory, BufferUse use = BufferUse::Data);
  RawBuffer(RawBuffer&&) noexcept;
  RawBuffer& operator=(RawBuffer&&) noexcept;
  ~RawBuffer();

  std::size_t bytes() const { return bytes_; }
  std::uint64_t address() const { return address_; }
  /// Host memory only; nullptr otherwise.
  std::byte* mapped() const { return mapped_; }
  /// Copies to the device, through a staging buffer where it is not mapped.
  void write(std::span<const std::byte> data, std::size_t offset = 0);
  /// Copies from the device, through a staging buffer where it is not mapped.
  void read(std::span<std::byte> data, std::size_t offset = 0) const;
  void fillZero();

  struct Impl;
  Impl& impl() const { return *impl_; }

private:
  template <class Copy>
  void throughStaging(std::size_t bytes, const Copy& copy) const;

  std::unique_ptr<Impl> impl_;
  std::size_t bytes_ = 0;
  std::uint64_t address_ = 0;
  std::byte* mapped_ = nullptr;
};

/// An array of T on the device; `T` is an interop type.
template <class T>
class Buffer {
public:
  Buffer() = default;
  Buffer(const Device& device, std::size_t count, Memory memory)
      : raw_(device, count * sizeof(T), memory), count_(count) {}
  Buffer(const Device& device, std::span<const T> values, Memory memory = Memory::Device)
      : Buffer(device, values.size(), memory) {
    write(values);
  }

  std::size_t size() const { return count_; }
  std::size_t bytes() const { return raw_.bytes(); }
  interop::Ptr<T> ptr(std::size_t first = 0) const { return {count_ == 0 ? 0 : raw_.address() + first * sizeof(T)}; }
  void write(std::span<const T> values) { raw_.write(std::as_bytes(values)); }
  /// From the first element on.
  void read(std::span<std::byte> data) const { raw_.read(data); }
  void fillZero() { raw_.fillZero(); }
  /// Host memory only.
  std::span<T> mapped() const { return {reinterpret_cast<T*>(raw_.mapped()), count_}; }

private:
  RawBuffer raw_;
  std::size_t count_ = 0;
};

} // namespace tyndall::gpu
