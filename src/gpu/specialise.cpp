// SPDX-License-Identifier: Apache-2.0
#include "gpu/specialise.h"

#include "base/error.h"
#include "base/file.h"

#include <spdlog/spdlog.h>
#include <spirv-tools/libspirv.h>
#include <spirv-tools/optimizer.hpp>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <optional>
#include <unordered_map>

namespace tyndall::gpu {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".spv";
constexpr std::uint32_t kRecipe = 1; ///< raised with every change of the passes below
using Hash = std::uint64_t;

/// After the words of a kept module stands their hash.
Hash hashOf(std::span<const std::uint32_t> words) {
  return hashText({reinterpret_cast<const char*>(words.data()), words.size_bytes()});
}

/// Named after all that decides what the optimiser makes.
fs::path fileFor(std::span<const std::uint32_t> words, std::span<const SpecEntry> spec, const fs::path& folder) {
  std::string text(reinterpret_cast<const char*>(words.data()), words.size_bytes());
  text.append(reinterpret_cast<const char*>(spec.data()), spec.size_bytes());
  text += spvSoftwareVersionDetailsString();
  return folder / fmt::format("{:016x}-{}{}", hashText(text), kRecipe, kEnding);
}

std::optional<std::vector<std::uint32_t>> readKept(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (bytes.size() <= sizeof(Hash) || bytes.size() % sizeof(std::uint32_t) != 0) {
    return std::nullopt;
  }
  std::vector<std::uint32_t> words((bytes.size() - sizeof(Hash)) / sizeof(std::uint32_t));
  Hash hash = 0;
  std::memcpy(words.data(), bytes.data(), bytes.size() - sizeof(Hash));
  std::memcpy(&hash, bytes.data() + bytes.size() - sizeof(Hash), sizeof(Hash));
  return hash == hashOf(words) ? std::optional(std::move(words)) : std::nullopt;
}

void removeOldest(const fs::path& folder) {
  std::vector<std::pair<fs::file_time_type, fs::path>> kept;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == kEnding) {
      kept.emplace_back(entry.last_write_time(), entry.path());
    }
  }
  std::ranges::sort(kept);
  for (std::size_t i = 0; i + kKeptModules < kept.size(); ++i) {
    fs::remove(kept[i].second);
  }
}

void keep(const fs::path& file, std::span<const std::uint32_t> words) {
  try {
    writeFileAtomically(file, [&](const fs::path& temporary) {
      const Hash hash = hashOf(words);
      std::ofstream(temporary, std::ios::binary)
          .write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size_bytes()))
          .write(reinterpret_cast<const char*>(&hash), sizeof(hash));
    });
    removeOldest(file.parent_path());
  } catch (const std::exception& error) {
    spdlog::debug("specialised kernel not kept: {}", error.what());
  }
}

} // namespace

std::vector<std::uint32_t> specialise(std::span<const std::uint32_t> words, std::span<const SpecEntry> spec) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> values;
  for (const SpecEntry& entry : spec) {
    values[entry.id] = {entry.bits};
  }
  std::string messages;
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_3);
  optimizer.SetMessageConsumer([&](spv_message_level_t level, const char*, const spv_position_t&, const char* text) {
    messages += level <= SPV_MSG_ERROR ? std::string(text) + "\n" : "";
  });
  optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass())
      .RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(values))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateCCPPass())
      .RegisterPass(spvtools::CreateSimplificationPass())
      .RegisterPass(spvtools::CreateDeadBranchElimPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass())
      .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
      .RegisterPass(spvtools::CreateAggressiveDCEPass())
      .RegisterPass(spvtools::CreateCompactIdsPass());
  spvtools::OptimizerOptions options;
  options.set_run_validator(false); // the build has validated the module
  std::vector<std::uint32_t> result;
  if (!optimizer.Run(words.data(), words.size(), &result, options)) {
    fail("SPIRV-Tools cannot specialise a kernel: {}", messages);
  }
  return result;
}

std::vector<std::uint32_t> specialiseOnce(std::span<const std::uint32_t> words, std::span<const SpecEntry> spec,
                                          const fs::path& folder) {
  if (folder.empty()) {
    return specialise(words, spec);
  }
  const fs::path file = fileFor(words, spec, folder);
  if (std::optional<std::vector<std::uint32_t>> kept = readKept(file)) {
    return *kept;
  }
  std::vector<std::uint32_t> result = specialise(words, spec);
  keep(file, result);
  return result;
}

} // namespace tyndall::gpu
