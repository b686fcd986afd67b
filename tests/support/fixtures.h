// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <filesystem>
#include <string>
#include <vector>

/// Small .vdb files with every oddity that files from other programs have, made with OpenVDB itself.
namespace tyndall::test {

/// Removed with everything in it when it goes out of scope.
class TemporaryFolder {
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
  std::filesystem::path path_;
};

/// Readable files, in `folder`. Names: see the code; each is mentioned by a test. Returns the file names.
std::vector<std::string> writeFixtures(const std::filesystem::path& folder);

/// Files that no reader can take: cut off at many lengths, text, empty, garbled. Returns the file names.
std::vector<std::string> writeMalformed(const std::filesystem::path& folder);

/// The ramps of validation A4: active voxels 0..kRampVoxels-1 on each axis hold kRampBase + kRampSlope * index[axis].
inline constexpr int kRampVoxels = 20;
inline constexpr float kRampBase = 0.25f;
inline constexpr float kRampSlope = 0.125f;

/// An affine map with a name, for tests that must hold under any.
struct NamedTransform {
  std::string name;
  glm::dmat4 worldFromIndex;
};
/// Identity, translated, rotated, sheared, non-uniform, mirrored and all at once.
std::vector<NamedTransform> affineTransforms();

} // namespace tyndall::test
