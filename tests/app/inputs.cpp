// SPDX-License-Identifier: Apache-2.0
#include "app/inputs.h"

#include "app/program.h"
#include "film/checkpoint.h"
#include "film/exr.h"
#include "film/merge.h"
#include "support/fixtures.h"

namespace tyndall::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLamp = R"("lights": [{"type": "point", "position": [2, 2, 2], "intensity": 10}])";

std::string withGrid(const std::string& file, const std::string& grid) {
  return R"({"media": [{"type": "grid", "file": ")" + file + R"(", "grid": ")" + grid + "\"}],\n" + kLamp + "}\n";
}

std::string withLight(const std::string& light) {
  return R"({"media": [{"type": "homogeneous", "shape": {"type": "sphere"}}], "lights": [)" + light + "]}\n";
}

void writeScenes(const fs::path& folder) {
  const auto scene = [&](const std::string& name, const std::string& text) {
    writeFile(folder / (name + ".json"), text);
  };
  scene("sound", sceneText());
  scene("unclosed", R"({"media": [)");
  scene("no_comma", R"({"name": "a" "media": []})");
  scene("empty", "");
  scene("list", "[1, 2]");
  scene("not_utf8", "{\"name\": \"\xff\xfe\"}");
  scene("nan", sceneText(R"("film": {"exposure": NaN}, )"));
  scene("unknown_key", sceneText(R"("rendr": {"samples": 4}, )"));
  scene("unknown_medium_key", sceneText("", R"("extinctoin": 2, )"));
  scene("wrong_type", sceneText("", R"("albedo": "white", )"));
  scene("out_of_range", sceneText("", R"("albedo": 1.5, )"));
  scene("negative", sceneText("", R"("extinction": -1, )"));
  scene("duplicate", sceneText(R"("name": "a", "name": "b", )"));
  scene("zero_size", sceneText(R"("film": {"size": [0, 10]}, )"));
  scene("camera_in_target", sceneText(R"("camera": {"position": [1, 1, 1], "target": [1, 1, 1]}, )"));
  scene("bad_transform", sceneText("", R"("transform": [{"scale": 0}], )"));
  scene("unknown_step", sceneText("", R"("transform": [{"rotat": 4}], )"));
  scene("unknown_phase", sceneText("", R"("phase": {"type": "henyey"}, )"));
  scene("no_parameter", sceneText("", R"("phase": {"type": "henyey-greenstein"}, )"));
  scene("no_medium_type", std::string(R"({"media": [{"extinction": 1}], )") + kLamp + "}");
  scene("unbounded_sun", R"({"media": [{"type": "homogeneous"}], "lights": [{"type": "sun"}]})");
  scene("missing_volume", withGrid("plian.vdb", "density"));
  scene("missing_grid", withGrid("plain.vdb", "densty"));
  scene("vector_grid", withGrid("vec3_only.vdb", "vel"));
  scene("cut_volume", withGrid("cut_tenth_5.vdb", "density"));
  scene("missing_map", withLight(R"({"type": "map", "file": "sky.exr"})"));
  scene("damaged_map", withLight(R"({"type": "map", "file": "damaged.exr"})"));
  scene("text_map", withLight(R"({"type": "map", "file": "text.exr"})"));
}

std::string withObject(const std::string& object) { return R"({"objects": [)" + object + "],\n" + kLamp + "}\n"; }

std::string withMesh(const std::string& file) { return withObject(R"({"type": "mesh", "file": ")" + file + "\"}"); }

void writeSurfaces(const fs::path& folder) {
  writeFile(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"); // three points on a line
  writeFile(folder / "empty.obj", "");
  writeFile(folder / "text.ply", "no mesh\n");
  const auto scene = [&](const std::string& name, const std::string& text) {
    writeFile(folder / (name + ".json"), text);
  };
  scene("surfaces", withObject(R"({"type": "quad"})"));
  scene("missing_mesh", withMesh("flta.obj"));
  scene("flat_mesh", withMesh("flat.obj"));
  scene("empty_mesh", withMesh("empty.obj"));
  scene("text_mesh", withMesh("text.ply"));
  scene("volume_mesh", withMesh("plain.vdb"));
  scene("parallel_quad", withObject(R"({"type": "quad", "edge_u": [1, 0, 0], "edge_v": [-2, 0, 0]})"));
  scene("unknown_material", R"({"materials": [{"name": "glass", "type": "dielectric"}], "objects": [)"
                            R"({"type": "sphere", "material": "galss"}]})");
}

void writePictures(const fs::path& folder) {
  const auto picture = [&](const std::string& name, glm::uvec2 size) {
    film::Image image{
        .displaySize = size, .window = {glm::uvec2(0), size}, .channels = {}, .uintChannels = {}, .metadata = {}};
    for (const char* channel : {"R", "G", "B"}) {
      image.channels[channel].assign(image.window.pixelCount(), 0.5f);
    }
    film::writeExr(folder / name, image);
  };
  picture("picture_8x8.exr", {8, 8});
  picture("picture_8x4.exr", {8, 4});
  const std::string whole = bytesOf(folder / "picture_8x8.exr");
  writeFile(folder / "damaged.exr", whole.substr(0, whole.size() / 2));
  writeFile(folder / "text.exr", "no picture\n");
}

/// Four columns of an 8x4 picture with two batches in every pixel.
void writePart(const fs::path& path, std::uint32_t firstColumn, const std::string& sceneHash) {
  film::Film film(glm::uvec2(8, 4), {{firstColumn, 0}, {firstColumn + 4, 4}});
  for (std::size_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    for (std::uint32_t batch = 0; batch < 2; ++batch) {
      film::BatchSums sums;
      sums.moments = {8.0f + float(batch), 8.0f, 8.0f, 4.0f};
      film.add(pixel, batch, film::kBatchSamples, sums);
    }
  }
  film::setProvenance(film, {sceneHash, "device", 1, 0, 2 * film::kBatchSamples});
  film::saveCheckpoint(path, film);
}

const TemporaryFolder& madeFolder() {
  static const TemporaryFolder folder;
  static const bool made = [] {
    writeFixtures(folder.path());
    writeMalformed(folder.path());
    writeScenes(folder.path());
    writeSurfaces(folder.path());
    writePictures(folder.path());
    writePart(folder / "left.part", 0, "aa");
    writePart(folder / "right.part", 4, "aa");
    writePart(folder / "other_scene.part", 4, "bb");
    std::string damaged = bytesOf(folder / "left.part");
    damaged[damaged.size() - 200] = char(damaged[damaged.size() - 200] ^ 1);
    writeFile(folder / "damaged.part", damaged);
    fs::create_directory(folder / "folder.exr");
    return true;
  }();
  static_cast<void>(made);
  return folder;
}

} // namespace

const fs::path& inputs() { return madeFolder().path(); }

std::string sceneText(const std::string& members, const std::string& medium) {
  return "{" + members + R"("media": [{)" + medium + R"("type": "homogeneous", "shape": {"type": "sphere"}}],)" + "\n" +
         kLamp + "}\n";
}

} // namespace tyndall::test
