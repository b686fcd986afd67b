// SPDX-License-Identifier: Apache-2.0
#include "film/exr_io.h"

#include "base/file.h"

#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>

#include <array>

namespace tyndall::film {
namespace {

const std::string kMetadataPrefix = "tyndall:";

} // namespace

Imf::Header makeHeader(const glm::uvec2& displaySize, const Window& window, const Metadata& metadata) {
  const Imath::Box2i display(Imath::V2i(0), Imath::V2i(int(displaySize.x) - 1, int(displaySize.y) - 1));
  const Imath::Box2i data(Imath::V2i(int(window.min.x), int(window.min.y)),
                          Imath::V2i(int(window.max.x) - 1, int(window.max.y) - 1));
  Imf::Header header(display, data);
  Imf::addChromaticities(header, Imf::Chromaticities());  // OpenEXR's default is Rec.709 with D65
  for (const auto& [key, value] : metadata) {
    header.insert(kMetadataPrefix + key, Imf::StringAttribute(value));
  }
  return header;
}

Metadata readMetadata(const Imf::Header& header) {
  Metadata metadata;
  for (auto it = header.begin(); it != header.end(); ++it) {
    const std::string name = it.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
    if (text != nullptr && name.starts_with(kMetadataPrefix)) {
      metadata[name.substr(kMetadataPrefix.size())] = text->value();
    }
  }
  return metadata;
}

void writeExrAtomically(const std::filesystem::path& path,
                        const std::function<void(std::ofstream&, const std::string&)>& write) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    try {
      std::ofstream stream(temporary, std::ios::binary);
      write(stream, temporary.string());
      // OpenEXR writes its line table in a destructor, which swallows errors: ask the stream.
      stream.close();
      if (!stream) {
        fail("{}: writing failed; is the disk full? Free some space or name another output with -o", path.string());
      }
    } catch (const Error&) {
      throw;
    } catch (const std::exception& exception) {
      fail("{}: cannot be written ({}); free some space or name another output with -o", path.string(),
           exception.what());
    }
  });
}

void checkIsExr(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    fail("{}: no such file; check the name", path.string());
  }
  if (!std::filesystem::is_regular_file(path)) {
    fail("{}: is a folder or device; name an OpenEXR file", path.string());
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    fail("{}: cannot be read; check its permissions", path.string());
  }
  std::array<char, 4> magic{};
  if (!stream.read(magic.data(), magic.size()) || !Imf::isImfMagic(magic.data())) {
    fail("{}: is not an OpenEXR file; name a .exr that was written whole", path.string());
  }
}

} // namespace tyndall::film
