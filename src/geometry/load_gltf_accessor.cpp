// SPDX-License-Identifier: Apache-2.0
#include "base/error.h"
#include "geometry/load_gltf_parts.h"

#include <algorithm>
#include <cstring>

namespace tyndall::geometry {
namespace {

/// Elements in a buffer, `stride` bytes apart. data == nullptr: all are 0.
struct View {
  const unsigned char* data = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
};

std::size_t sizeOf(int componentType) {
  switch (componentType) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return 1;
  case TINYGLTF_COMPONENT_TYPE_SHORT:
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return 2;
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
  case TINYGLTF_COMPONENT_TYPE_FLOAT:
    return 4;
  default:
    fail("its numbers are of the unknown type {}", componentType);
  }
}

/// `count` elements of `elementSize` bytes from `offset` on in a buffer view, whatever the file says, lie in its
/// buffer.
View viewOf(const tinygltf::Model& source, int index, std::size_t offset, std::size_t elementSize, std::size_t count) {
  if (index < 0 || static_cast<std::size_t>(index) >= source.bufferViews.size()) {
    fail("it names buffer view {}, which is not there", index);
  }
  const tinygltf::BufferView& view = source.bufferViews[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= source.buffers.size()) {
    fail("buffer view {} names buffer {}, which is not there", index, view.buffer);
  }
  const std::vector<unsigned char>& data = source.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    fail("buffer view {} reaches beyond its buffer of {} bytes", index, data.size());
  }
  const std::size_t stride = view.byteStride == 0 ? elementSize : view.byteStride;
  if (count > 0) {
    const bool fits = offset <= view.byteLength && elementSize <= view.byteLength - offset &&
                      (count - 1) <= (view.byteLength - offset - elementSize) / stride;
    if (!fits) {
      fail("{} elements do not fit into buffer view {} of {} bytes", count, index, view.byteLength);
    }
  }
  return {data.data() + view.byteOffset + offset, stride, count};
}

const tinygltf::Accessor& accessorAt(const tinygltf::Model& source, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= source.accessors.size()) {
    fail("it names accessor {}, which is not there", index);
  }
  return source.accessors[static_cast<std::size_t>(index)];
}

template <class T>
T valueAt(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Of unsigned integers.
std::uint32_t integerAt(const unsigned char* bytes, int type) {
  switch (type) {
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return *bytes;
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return valueAt<std::uint16_t>(bytes);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return valueAt<std::uint32_t>(bytes);
  default:
    fail("its indices are of type {}, which is no unsigned integer", type);
  }
}

/// glTF 2.0, 3.6.2.2: normalised integers.
float numberAt(const unsigned char* bytes, int type, bool normalised) {
  const auto scaled = [normalised](auto value, float largest) {
    const auto number = static_cast<float>(value);
    return normalised ? std::max(number / largest, -1.0F) : number;
  };
  switch (type) {
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return scaled(valueAt<std::int8_t>(bytes), 127.0F);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return scaled(*bytes, 255.0F);
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return scaled(valueAt<std::int16_t>(bytes), 32767.0F);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return scaled(valueAt<std::uint16_t>(bytes), 65535.0F);
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return scaled(valueAt<std::uint32_t>(bytes), 4294967295.0F);
  default:
    return valueAt<float>(bytes);
  }
}

View elementsOf(const tinygltf::Model& source, const tinygltf::Accessor& accessor, std::size_t elementSize) {
  constexpr std::size_t kMostZeros = std::size_t{1} << 24; // nothing in the file bounds their number
  if (accessor.bufferView >= 0) {
    return viewOf(source, accessor.bufferView, accessor.byteOffset, elementSize, accessor.count);
  }
  if (accessor.count > kMostZeros) {
    fail("{} elements without a buffer are more than Tyndall takes", accessor.count);
  }
  return {nullptr, 0, accessor.count};
}

/// Calls put(i, bytes) for each sparse element.
template <class Put>
void eachSparse(const tinygltf::Model& source, const tinygltf::Accessor& accessor, std::size_t elementSize, Put put) {
  if (!accessor.sparse.isSparse) {
    return;
  }
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    fail("its sparse part has a negative count or offset");
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  const View places = viewOf(source, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                             sizeOf(sparse.indices.componentType), count);
  const View values =
      viewOf(source, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), elementSize, count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t place = integerAt(places.data + i * places.stride, sparse.indices.componentType);
    if (place >= accessor.count) {
      fail("its sparse part names element {} of {}", place, accessor.count);
    }
    put(place, values.data + i * values.stride);
  }
}

} // namespace

std::vector<float> readFloats(const tinygltf::Model& source, int index, int components) {
  const tinygltf::Accessor& accessor = accessorAt(source, index);
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components) {
    fail("accessor {} has not the {} numbers per element that it needs", index, components);
  }
  const std::size_t size = sizeOf(accessor.componentType);
  const auto width = static_cast<std::size_t>(components);
  const View view = elementsOf(source, accessor, size * width);
  std::vector<float> values(view.count * width, 0.0F);
  const auto put = [&](std::size_t element, const unsigned char* bytes) {
    for (std::size_t c = 0; c < width; ++c) {
      values[element * width + c] = numberAt(bytes + c * size, accessor.componentType, accessor.normalized);
    }
  };
  for (std::size_t i = 0; view.data != nullptr && i < view.count; ++i) {
    put(i, view.data + i * view.stride);
  }
  eachSparse(source, accessor, size * width, put);
  return values;
}

std::vector<std::uint32_t> readIndices(const tinygltf::Model& source, int index) {
  const tinygltf::Accessor& accessor = accessorAt(source, index);
  if (accessor.type != TINYGLTF_TYPE_SCALAR) {
    fail("accessor {} holds no plain numbers, as indices are", index);
  }
  const std::size_t size = sizeOf(accessor.componentType);
  const View view = elementsOf(source, accessor, size);
  std::vector<std::uint32_t> values(view.count, 0);
  const auto put = [&](std::size_t element, const unsigned char* bytes) {
    values[element] = integerAt(bytes, accessor.componentType);
  };
  for (std::size_t i = 0; view.data != nullptr && i < view.count; ++i) {
    put(i, view.data + i * view.stride);
  }
  eachSparse(source, accessor, size, put);
  return values;
}

} // namespace tyndall::geometry
