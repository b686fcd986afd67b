// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.h"
#include "math/bounds.h"

#include <openvdb/Grid.h>
#include <openvdb/io/Archive.h>
#include <openvdb/io/io.h>

#include <filesystem>
#include <istream>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Reading of .vdb files that may be damaged or hostile. Only files that name OpenVDB types include this.
namespace tyndall::volume {

/// One grid as the file's directory lists it.
struct GridEntry {
  std::string name;              ///< as users see it: "density", or "density[1]" for the second one of that name
  std::string uniqueName;        ///< as the file writes it
  std::string type;              ///< OpenVDB's type name, such as "Tree_float_5_4_3"
  std::string parent;            ///< unique name of the grid whose tree it shares; empty: it has its own
  bool savedAsHalf = false;
  std::int64_t position = 0;     ///< byte offset of the grid
  openvdb::GridBase::Ptr grid;   ///< already read: files written to a stream have no offsets
};

/// An open file. Every read past the end throws instead of leaving memory unset, which OpenVDB's own io::File does
/// not promise; nothing is loaded lazily, so a file may change once this is gone.
class VdbFile : private openvdb::io::Archive {
public:
  /// Reads header and directory. @throws Error if the file is missing, a folder, not a VDB or damaged.
  explicit VdbFile(const std::filesystem::path& path);
  ~VdbFile() override;
  VdbFile(const VdbFile&) = delete;
  VdbFile& operator=(const VdbFile&) = delete;

  const std::string& path() const { return path_; }
  std::string formatVersion() const; ///< "v224"
  const std::map<std::string, std::string>& metadata() const { return metadata_; }
  const std::vector<GridEntry>& entries() const { return entries_; }

  /// False for grids of a type that this build cannot read at all.
  static bool isKnownType(const GridEntry& entry);
  /// One grid with its voxels; of affine grids only those that can influence `worldClip`.
  /// @throws Error if its type is unknown or the file is damaged.
  openvdb::GridBase::Ptr readGrid(const GridEntry& entry, const std::optional<Bounds3>& worldClip);

private:
  class Buffer;

  openvdb::io::Archive::Ptr copy() const override;
  void readDirectory();
  GridEntry readEntry();
  std::string readShortText();
  openvdb::GridBase::Ptr readTree(const GridEntry& entry, const std::optional<openvdb::CoordBBox>& clip);
  openvdb::GridBase::Ptr readHead(const GridEntry& entry);
  const GridEntry& ownerOfTree(const GridEntry& entry) const;
  static std::optional<openvdb::CoordBBox> clipBoxOf(const openvdb::GridBase& grid, const Bounds3& worldClip);

  std::string path_;
  std::unique_ptr<Buffer> buffer_;
  std::shared_ptr<openvdb::io::StreamMetadata> streamMetadata_; ///< the stream only borrows it
  std::unique_ptr<std::istream> stream_;
  std::map<std::string, std::string> metadata_;
  std::vector<GridEntry> entries_;
};

/// The affine map of a grid whose transform is linear. @throws Error if it is singular or not finite.
glm::dmat4 worldFromIndexOf(const openvdb::GridBase& grid);

/// Runs `work`; whatever OpenVDB, its codecs or the allocator throw becomes an Error that names the file.
template <class Work> auto guardedRead(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    fail("{}: not enough memory to read it, or the file is damaged; clip the grid (\"clip\": [[min], [max]]) or "
         "export the file again", path);
  } catch (const std::exception& problem) {
    fail("{}: cannot be read: {}; the file is damaged or incomplete: copy or export it again", path, problem.what());
  }
}

} // namespace tyndall::volume
