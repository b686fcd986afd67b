// SPDX-License-Identifier: Apache-2.0
// Lets one header describe device memory to both compilers. The only file that may test __cplusplus.
// Layout is scalar: GLSL offsets equal C++ offsets for 4-byte scalars, vectors, matrices and 8-byte addresses.
#ifndef TYNDALL_INTEROP_H
#define TYNDALL_INTEROP_H

#ifdef __cplusplus

#include <glm/glm.hpp>

#include <cstdint>
#include <type_traits>

namespace tyndall::interop {
using glm::ivec2;
using glm::ivec3;
using glm::ivec4;
using glm::mat4;
using glm::mat4x3;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

/// Device address of an array of T; 0 = none. Eight-byte aligned, like GLSL's buffer_reference.
template <class T> struct Ptr {
  std::uint64_t address = 0;
};
} // namespace tyndall::interop

#define GPU_BEGIN namespace tyndall::interop {
#define GPU_END }
#define GPU_CONST inline constexpr
#define GPU_PTR(T) Ptr<T>
#define GPU_BUFFER(T) static_assert(std::is_standard_layout_v<T> && std::is_trivially_copyable_v<T>);

#else

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require

#define GPU_BEGIN
#define GPU_END
#define GPU_CONST const
#define GPU_PTR(T) T##Ptr
#define GPU_BUFFER(T)                                                                              \
  layout(buffer_reference, scalar, buffer_reference_align = 4) buffer T##Ptr {                     \
    T at[];                                                                                        \
  };

#endif
#endif
