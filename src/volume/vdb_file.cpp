// SPDX-License-Identifier: Apache-2.0
#include "volume/vdb_file.h"

#include "volume/sparse.h"

#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <mutex>
#include <streambuf>
#include <string_view>

namespace tyndall::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHalfSuffix = "_HalfFloat"; ///< appended to the type of grids saved as half
constexpr std::uint32_t kMaxText = 1 << 16;            ///< names and types in the directory
constexpr std::int32_t kMaxGrids = 1 << 16;
constexpr std::array<unsigned char, 8> kMagic{0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0};

void initialiseOpenVdb() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

/// The start of a file that is no VDB, for the message.
std::string describeStart(std::span<const char> bytes) {
  if (bytes.size() >= 7 && std::memcmp(bytes.data(), "NanoVDB", 7) == 0) {
    return "it is a NanoVDB file; convert it with nanovdb_convert";
  }
  std::string start;
  for (const char c : bytes.first(std::min<std::size_t>(bytes.size(), 16))) {
    start += c >= 32 && c < 127 ? c : '.';
  }
  return fmt::format("it starts with \"{}\"; export it as OpenVDB", start);
}

std::string vdbFilesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code problem;
  for (fs::directory_iterator it(folder, problem), end; !problem && it != end; it.increment(problem)) {
    if (it->path().extension() == ".vdb" && names.size() < 5) {
      names.push_back(it->path().filename().string());
    }
  }
  return names.empty() ? "it has none" : "such as " + joinNames(names);
}

} // namespace

/// A mapped file as a stream buffer that throws rather than reading or seeking beyond its end.
class VdbFile::Buffer : public std::streambuf {
public:
  explicit Buffer(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
      fail("{}: is a folder; name a .vdb file in it ({})", path.string(), vdbFilesIn(path));
    }
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) {
      fail("{}: cannot be opened: {}; check the name and its permissions", path.string(), std::strerror(errno));
    }
    struct stat status {};
    const bool regular = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
    size_ = regular ? std::size_t(status.st_size) : 0;
    if (size_ > 0) {
      data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    }
    ::close(file);
    if (!regular || size_ == 0) {
      fail("{}: {}; export it again", path.string(), regular ? "is empty (0 bytes)" : "is not a regular file");
    }
    if (data_ == MAP_FAILED) {
      data_ = nullptr;
      fail("{}: cannot be mapped: {}", path.string(), std::strerror(errno));
    }
    seekTo(0);
  }
  ~Buffer() override {
    if (data_ != nullptr) {
      ::munmap(data_, size_);
    }
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  std::span<const char> bytes() const { return {static_cast<const char*>(data_), size_}; }

protected:
  std::streamsize xsgetn(char* target, std::streamsize count) override {
    if (count < 0 || count > egptr() - gptr()) {
      throw std::runtime_error("the file ends in the middle of a block");
    }
    std::memcpy(target, gptr(), std::size_t(count));
    seekTo(gptr() - eback() + count);
    return count;
  }
  int_type underflow() override { return traits_type::eof(); }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const off_type base = from == std::ios_base::beg   ? 0
                          : from == std::ios_base::end ? off_type(size_)
                                                       : off_type(gptr() - eback());
    // Bounded first: a damaged offset must not overflow the sum.
    if (offset < -off_type(size_) || offset > off_type(size_) || base + offset < 0 || base + offset > off_type(size_)) {
      throw std::runtime_error("the file refers to a place beyond its end");
    }
    seekTo(base + offset);
    return {base + offset};
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }

private:
  void seekTo(off_type position) {
    char* const begin = static_cast<char*>(data_); // never written through: mapped read-only
    setg(begin, begin + position, begin + size_);
  }

  void* data_ = nullptr;
  std::size_t size_ = 0;
};

VdbFile::VdbFile(const fs::path& path) : path_(path.string()), buffer_(std::make_unique<Buffer>(path)) {
  initialiseOpenVdb();
  const std::span<const char> bytes = buffer_->bytes();
  if (bytes.size() < kMagic.size() || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0) {
    fail("{}: is not a VDB file: {}", path_, describeStart(bytes));
  }
  stream_ = std::make_unique<std::istream>(buffer_.get());
  stream_->exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  guardedRead(path_, [this] { readDirectory(); });
}

VdbFile::~VdbFile() = default;

openvdb::io::Archive::Ptr VdbFile::copy() const {
  fail("{}: an open VDB file is not copied", path_);
}

std::string VdbFile::formatVersion() const { return fmt::format("v{}", fileVersion()); }

std::string VdbFile::readShortText() {
  std::uint32_t size = 0;
  stream_->read(reinterpret_cast<char*>(&size), sizeof size);
  if (size > kMaxText) {
    throw std::runtime_error("a name in its directory is absurdly long");
  }
  std::string text(size, '\0');
  stream_->read(text.data(), std::streamsize(size));
  return text;
}

GridEntry VdbFile::readEntry() {
  GridEntry entry;
  entry.uniqueName = readShortText();
  entry.name = openvdb::io::GridDescriptor::nameAsString(entry.uniqueName);
  entry.type = readShortText();
  if (entry.type.ends_with(kHalfSuffix)) {
    entry.savedAsHalf = true;
    entry.type.resize(entry.type.size() - kHalfSuffix.size());
  }
  if (fileVersion() >= openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING) {
    entry.parent = readShortText();
  }
  return entry;
}

void VdbFile::readDirectory() {
  readHeader(*stream_);
  streamMetadata_ = std::make_shared<openvdb::io::StreamMetadata>();
  streamMetadata_->setSeekable(true);
  openvdb::io::setStreamMetadataPtr(*stream_, streamMetadata_, /*transfer=*/false);
  setFormatVersion(*stream_);
  setLibraryVersion(*stream_);
  setDataCompression(*stream_);
  openvdb::MetaMap fileMetadata;
  fileMetadata.readMeta(*stream_);
  for (auto it = fileMetadata.beginMeta(); it != fileMetadata.endMeta(); ++it) {
    metadata_[it->first] = it->second == nullptr ? "" : it->second->str();
  }
  const std::int32_t count = readGridCount(*stream_);
  if (count < 0 || count > kMaxGrids) {
    throw std::runtime_error(fmt::format("its directory claims {} grids", count));
  }
  for (std::int32_t i = 0; i < count; ++i) {
    GridEntry entry = readEntry();
    std::array<std::int64_t, 3> offsets{}; // grid, first block, end
    stream_->read(reinterpret_cast<char*>(offsets.data()), sizeof offsets);
    if (inputHasGridOffsets()) {
      entry.position = offsets[0];
      stream_->seekg(offsets[2]);
    } else {
      entry.position = std::int64_t(stream_->tellg());
      if (!isKnownType(entry)) {
        fail("{}: grid '{}' has the unknown type {}, and the file was written without offsets, so that nothing after "
             "it can be found; export it again without that grid", path_, entry.name, entry.type);
      }
      entry.grid = readTree(entry, std::nullopt);
    }
    entries_.push_back(std::move(entry));
  }
}

bool VdbFile::isKnownType(const GridEntry& entry) { return openvdb::GridBase::isRegistered(entry.type); }

openvdb::GridBase::Ptr VdbFile::readHead(const GridEntry& entry) {
  openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(entry.type);
  stream_->seekg(entry.position);
  readGridCompression(*stream_);
  grid->readMeta(*stream_);
  grid->readTransform(*stream_);
  return grid;
}

openvdb::GridBase::Ptr VdbFile::readTree(const GridEntry& entry, const std::optional<openvdb::CoordBBox>& clip) {
  openvdb::io::GridDescriptor descriptor(entry.uniqueName, entry.type, entry.savedAsHalf);
  descriptor.setInstanceParentName(entry.parent);
  openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(entry.type);
  grid->setSaveFloatAsHalf(entry.savedAsHalf);
  stream_->seekg(entry.position);
  if (clip) {
    Archive::readGrid(grid, descriptor, *stream_, *clip);
  } else {
    Archive::readGrid(grid, descriptor, *stream_);
  }
  return grid;
}

std::optional<openvdb::CoordBBox> VdbFile::clipBoxOf(const openvdb::GridBase& grid, const Bounds3& worldClip) {
  if (!grid.transform().isLinear()) {
    return std::nullopt; // clipped once it is resampled
  }
  const IndexBox box = indexBoxOfClip(worldClip, worldFromIndexOf(grid));
  return openvdb::CoordBBox(openvdb::Coord(box.min.x, box.min.y, box.min.z),
                            openvdb::Coord(box.max.x, box.max.y, box.max.z));
}

const GridEntry& VdbFile::ownerOfTree(const GridEntry& entry) const {
  if (entry.parent.empty()) {
    return entry;
  }
  for (const GridEntry& other : entries_) {
    if (other.uniqueName == entry.parent && other.type == entry.type && other.parent.empty()) {
      return other;
    }
  }
  throw std::runtime_error(fmt::format("grid '{}' shares the tree of a grid that is not there", entry.name));
}

openvdb::GridBase::Ptr VdbFile::readGrid(const GridEntry& entry, const std::optional<Bounds3>& worldClip) {
  if (!isKnownType(entry)) {
    fail("{}: grid '{}' has a type that cannot be read: {}", path_, entry.name, entry.type);
  }
  return guardedRead(path_, [&]() -> openvdb::GridBase::Ptr {
    // Before instancing came, a grid's transform was written behind its tree: such old files are read whole.
    const bool headFirst = fileVersion() >= openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING && !entry.grid;
    std::optional<openvdb::CoordBBox> clip;
    if (worldClip && headFirst) {
      const openvdb::GridBase::Ptr head = readHead(entry);
      clip = clipBoxOf(*head, *worldClip);
      if (clip && clip->empty()) {
        return head;
      }
    }
    const GridEntry& owner = ownerOfTree(entry);
    const bool shares = &owner != &entry;
    openvdb::GridBase::Ptr grid = entry.grid ? entry.grid->deepCopyGrid() : readTree(entry, shares ? std::nullopt : clip);
    if (shares) {
      grid->setTree((owner.grid ? owner.grid->deepCopyGrid() : readTree(owner, clip))->baseTreePtr());
    }
    if (worldClip && !headFirst) {
      clip = clipBoxOf(*grid, *worldClip);
      if (clip) {
        grid->clip(*clip);
      }
    }
    return grid;
  });
}

glm::dmat4 worldFromIndexOf(const openvdb::GridBase& grid) {
  const openvdb::math::Mat4d map = grid.transform().baseMap()->getAffineMap()->getMat4();
  glm::dmat4 worldFromIndex;
  bool finite = true;
  for (int row = 0; row < 4; ++row) { // OpenVDB multiplies row vectors from the left: its rows are GLM's columns
    for (int column = 0; column < 4; ++column) {
      worldFromIndex[row][column] = map(row, column);
      finite = finite && std::isfinite(map(row, column));
    }
  }
  const double determinant = glm::determinant(glm::dmat3(worldFromIndex));
  if (!finite || determinant == 0.0 || !std::isfinite(determinant)) {
    fail("grid '{}' has a transform that cannot be inverted; export it with a voxel size above 0", grid.getName());
  }
  return worldFromIndex;
}

} // namespace tyndall::volume
