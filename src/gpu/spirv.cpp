// SPDX-License-Identifier: Apache-2.0
#include "gpu/spirv.h"

#include "base/error.h"

namespace tyndall::gpu {
namespace {

// SPIR-V 1.6 specification, sections 2.3 and 3.
constexpr std::uint32_t kMagic = 0x07230203;
constexpr std::uint32_t kHeaderWords = 5;
constexpr std::uint32_t kOpName = 5;
constexpr std::uint32_t kOpMemberName = 6;
constexpr std::uint32_t kOpExecutionMode = 16;
constexpr std::uint32_t kOpTypeImage = 25;
constexpr std::uint32_t kOpConstant = 43;
constexpr std::uint32_t kOpSpecConstant = 50;
constexpr std::uint32_t kOpExecutionModeId = 331;
constexpr std::uint32_t kOpMemberDecorate = 72;
constexpr std::uint32_t kModeLocalSize = 17;
constexpr std::uint32_t kModeLocalSizeId = 38;
constexpr std::uint32_t kDecorationOffset = 35;

std::string literal(std::span<const std::uint32_t> words) {
  std::string text;
  for (const std::uint32_t word : words) {
    for (int byte = 0; byte < 4; ++byte) {
      const char character = static_cast<char>((word >> (8 * byte)) & 0xffu);
      if (character == '\0') {
        return text;
      }
      text += character;
    }
  }
  return text;
}

struct Member {
  std::string name;
  std::uint32_t offset = 0;
  bool placed = false;
};

} // namespace

SpirvInfo readSpirv(std::span<const std::uint32_t> words) {
  if (words.size() < kHeaderWords || words[0] != kMagic) {
    fail("not a SPIR-V module");
  }
  SpirvInfo info;
  std::map<std::uint32_t, std::string> names;
  std::map<std::uint32_t, std::uint32_t> constants;
  std::uint32_t workgroupSizeId = 0;
  std::map<std::uint32_t, std::map<std::uint32_t, Member>> structs;
  for (std::size_t i = kHeaderWords; i < words.size();) {
    const std::uint32_t length = words[i] >> 16;
    const std::uint32_t op = words[i] & 0xffffu;
    if (length == 0 || i + length > words.size()) {
      fail("a broken SPIR-V module: instruction of {} words at word {}", length, i);
    }
    const std::span<const std::uint32_t> operands = words.subspan(i + 1, length - 1);
    if (op == kOpName) {
      names[operands[0]] = literal(operands.subspan(1));
    } else if (op == kOpMemberName) {
      structs[operands[0]][operands[1]].name = literal(operands.subspan(2));
    } else if (op == kOpExecutionMode && operands[1] == kModeLocalSize) {
      info.workgroupSize = operands[2];
    } else if (op == kOpExecutionModeId && operands[1] == kModeLocalSizeId) {
      workgroupSizeId = operands[2];
    } else if (op == kOpConstant || op == kOpSpecConstant) {
      constants[operands[1]] = operands[2];
    } else if (op == kOpTypeImage) {
      info.usesImages = true;
    } else if (op == kOpMemberDecorate && operands[2] == kDecorationOffset) {
      Member& member = structs[operands[0]][operands[1]];
      member.offset = operands[3];
      member.placed = true;
    }
    i += length;
  }
  if (workgroupSizeId != 0) {
    info.workgroupSize = constants[workgroupSizeId];
  }
  for (const auto& [id, members] : structs) {
    for (const auto& [index, member] : members) {
      if (member.placed) {
        info.offsets[names[id]].try_emplace(member.name, member.offset);
      }
    }
  }
  return info;
}

} // namespace tyndall::gpu
