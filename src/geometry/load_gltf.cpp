// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 [Khronos 2021] by way of tinygltf, which reads the JSON, the container and the buffers. What it hands on is
// checked here: indices, lengths, files.
#include "base/error.h"
#include "geometry/load_gltf_parts.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace tyndall::geometry {
namespace {

namespace fs = std::filesystem;

constexpr std::array kHonoured{"KHR_texture_transform", "KHR_materials_emissive_strength", "KHR_materials_ior",
                               "KHR_lights_punctual",   "KHR_materials_transmission",      "KHR_mesh_quantization"};

bool isHonoured(const std::string& extension) { return std::ranges::find(kHonoured, extension) != kHonoured.end(); }

/// tinygltf follows the JSON by recursion: deep nesting would end the program.
void checkNesting(std::string_view json) {
  constexpr int kDeepest = 256;
  int depth = 0;
  bool inText = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inText) {
      i += c == '\\' ? 1 : 0;
      inText = c != '"';
    } else if (c == '"') {
      inText = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) {
        fail("its JSON is nested more than {} deep; export it again", kDeepest);
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

/// Called by tinygltf with an image's bytes. Those in a buffer view are fetched later, since tinygltf does not check
/// that they lie within their buffer.
bool keepImageBytes(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                    int size, void*) {
  if (image->bufferView < 0 && size > 0) {
    image->image.assign(bytes, bytes + size);
  }
  return true;
}

/// Regular files below the folder of the file itself: tinygltf also looks in the current folder.
bool exists(const std::string& name, void* folder) {
  std::error_code error;
  return name.starts_with(*static_cast<const std::string*>(folder)) && fs::is_regular_file(name, error);
}

bool readWhole(std::vector<unsigned char>* out, std::string* error, const std::string& name, void*) {
  try {
    const std::string bytes = readBytes(name);
    out->assign(bytes.begin(), bytes.end());
    return true;
  } catch (const Error& problem) {
    *error = problem.what();
    return false;
  }
}

std::string oneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  text.erase(text.find_last_not_of(" .") + 1);
  return text.substr(0, 400);
}

void checkRequired(const tinygltf::Model& source) {
  std::vector<std::string> unknown;
  for (const std::string& extension : source.extensionsRequired) {
    if (!isHonoured(extension)) {
      unknown.push_back(extension);
    }
  }
  if (!unknown.empty()) {
    fail("it requires the extension {}, which Tyndall does not read; export it without", joinNames(unknown));
  }
}

void warnOfWhatIsPassedOver(const tinygltf::Model& source, Model& model) {
  std::vector<std::string> passed;
  for (const std::string& extension : source.extensionsUsed) {
    if (!isHonoured(extension) && std::ranges::find(passed, extension) == passed.end()) {
      passed.push_back(extension);
    }
  }
  if (!passed.empty()) {
    model.warnings.push_back(fmt::format("What the extension {} says is passed over.", joinNames(passed)));
  }
  if (!source.skins.empty()) {
    model.warnings.push_back("Skins are passed over: their meshes keep the pose that they are stored in.");
  }
}

} // namespace

tinygltf::Model parseGltf(const fs::path& path) {
  constexpr std::uint64_t kLargest = 0xfffffff0; // tinygltf counts in 32 bits
  const std::string bytes = readBytes(path, kLargest);
  const bool binary = bytes.starts_with("glTF");
  if (binary) {
    std::uint32_t jsonLength = 0;
    std::memcpy(&jsonLength, bytes.data() + 12, bytes.size() >= 16 ? 4 : 0);
    checkNesting(std::string_view(bytes).substr(std::min<std::size_t>(20, bytes.size()), jsonLength));
  } else {
    checkNesting(bytes);
  }
  std::string folder = fs::absolute(path).parent_path().string();
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(&keepImageBytes, nullptr);
  reader.SetFsCallbacks({&exists, [](const std::string& name, void*) { return name; }, &readWhole, nullptr, &folder});
  tinygltf::Model source;
  std::string error;
  std::string ignored; // missing images: said where a texture uses them
  const auto size = static_cast<unsigned>(bytes.size());
  const bool read =
      binary ? reader.LoadBinaryFromMemory(&source, &error, &ignored,
                                           reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
             : reader.LoadASCIIFromString(&source, &error, &ignored, bytes.data(), size, folder);
  if (!read) {
    fail("no glTF that can be read ({}); see that the files it names lie beside it, or export it again",
         oneLine(error));
  }
  if (!source.asset.version.starts_with("2")) {
    fail("it is of glTF version \"{}\"; Tyndall reads 2.x", source.asset.version);
  }
  checkRequired(source);
  return source;
}

double numberOf(const tinygltf::Value& object, const std::string& key, double fallback) {
  if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber()) {
    return fallback;
  }
  return object.Get(key).GetNumberAsDouble();
}

Model loadGltf(const fs::path& path, double seconds, Mended& mended) {
  tinygltf::Model source = parseGltf(path);
  Model model;
  poseGltf(source, seconds, model);
  warnOfWhatIsPassedOver(source, model);
  GltfMaterials(source, model).readAll();
  readGltfMeshes(source, model, mended);
  readGltfScene(source, model);
  return model;
}

} // namespace tyndall::geometry
