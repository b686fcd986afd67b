// SPDX-License-Identifier: Apache-2.0
#include "geometry/mesh_files.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace tyndall::geometry {
namespace {

using test::loadSquare;
using test::squareGltf;
using test::squareMesh;
using test::warnings;
using testing::HasSubstr;

TEST(Gltf, ASquareIsWhatItsBufferSays) {
  const test::TemporaryFolder folder;
  const Model model = loadSquare(folder.path(), squareMesh());
  ASSERT_EQ(model.meshes.size(), 1U);
  const Mesh& mesh = model.meshes[0];
  EXPECT_EQ(mesh.name, "square");
  ASSERT_EQ(mesh.normals.size(), 4U);
  EXPECT_EQ(mesh.positions[2], glm::vec3(1.0F, 1.0F, 0.0F));
  EXPECT_EQ(mesh.normals[0], glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(mesh.uvs[0], glm::vec2(0.0F, 1.0F));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(mesh.materials, (std::vector<std::uint32_t>{kNone, kNone}));
  EXPECT_DOUBLE_EQ(test::area(model), 1.0);
  EXPECT_EQ(warnings(model), "");
}

TEST(Gltf, TheBinaryContainerHoldsTheSame) {
  const test::TemporaryFolder folder;
  std::string json = squareGltf(squareMesh());
  const std::string uri = R"(,"uri":"square.bin")";
  json.erase(json.find(uri), uri.size());
  const Model model = loadModel(test::write(folder / "square.GLB", test::glb(json, test::squareBuffer())));
  EXPECT_EQ(model.meshes[0].positions[2], glm::vec3(1.0F, 1.0F, 0.0F));
  EXPECT_DOUBLE_EQ(test::area(model), 1.0);
}

TEST(Gltf, StripsAndFansWindAsTheStandardSays) {
  const test::TemporaryFolder folder;
  // Without indices the strip 0 1 2 3 is 0 1 2 and 1 3 2; the fan is 1 2 0 and 2 3 0.
  const auto primitive = [](int mode) {
    return R"(,"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":)" +
           std::to_string(mode) + "}]}]";
  };
  EXPECT_EQ(loadSquare(folder.path(), primitive(5)).meshes[0].triangles,
            (std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(loadSquare(folder.path(), primitive(6)).meshes[0].triangles,
            (std::vector<glm::uvec3>{{1, 2, 0}, {2, 3, 0}}));
  test::write(folder / "lines.gltf", squareGltf(primitive(1)));
  EXPECT_THAT(test::refusal(folder / "lines.gltf"), HasSubstr("1 primitives of points or lines were left out"));
}

/// Four corners without indices are a triangle and one corner over.
TEST(Gltf, ATriangleWithoutAllCornersAndColoursOfVerticesAreNamed) {
  const test::TemporaryFolder folder;
  const Model model = loadSquare(
      folder.path(), R"(,"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":0}}]}])");
  EXPECT_EQ(model.meshes[0].triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  EXPECT_EQ(warnings(model), "Passed over: the vertices' colours.\n"
                             "1 triangles that lack a corner at their primitive's end were left out.\n");
}

TEST(Gltf, OneMeshInSeveralNodesStaysOne) {
  const test::TemporaryFolder folder;
  std::string rest = squareMesh();
  rest.replace(rest.find(R"([{"mesh":0}])"), 12, R"([{"children":[1,2],"translation":[1,0,0]},
    {"mesh":0,"scale":[-2,1,1]},
    {"mesh":0,"rotation":[0,0,0.70710678118654757,0.70710678118654757],"translation":[0,5,0]}])");
  const Model model = loadSquare(folder.path(), rest);
  ASSERT_EQ(model.meshes.size(), 1U);
  ASSERT_EQ(model.nodes.size(), 2U);
  const glm::dvec4 corner(1.0, 0.0, 0.0, 1.0);
  const glm::dvec4 mirrored = model.nodes[0].worldFromObject * corner;
  EXPECT_NEAR(glm::length(mirrored - glm::dvec4(-1.0, 0.0, 0.0, 1.0)), 0.0, 1e-12);
  EXPECT_LT(glm::determinant(model.nodes[0].worldFromObject), 0.0);
  const glm::dvec4 turned = model.nodes[1].worldFromObject * corner; // a quarter turn about z: x becomes y
  EXPECT_NEAR(glm::length(turned - glm::dvec4(1.0, 6.0, 0.0, 1.0)), 0.0, 1e-12);
}

TEST(Gltf, AScaleOfZeroIsBakedIntoAMeshOfItsOwn) {
  const test::TemporaryFolder folder;
  std::string rest = squareMesh();
  rest.replace(rest.find(R"([{"mesh":0}])"), 12, R"([{"mesh":0,"scale":[3,1,0]}])");
  const Model model = loadSquare(folder.path(), rest);
  EXPECT_EQ(model.nodes[0].worldFromObject, glm::dmat4(1.0));
  EXPECT_DOUBLE_EQ(test::area(model), 3.0);
}

TEST(Gltf, MaterialsAndTheirExtensions) {
  const test::TemporaryFolder folder;
  const Model model = loadSquare(folder.path(), squareMesh(R"(,"material":1)") + R"(,"materials":[{},{"name":"lamp",
    "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,"roughnessFactor":0.25},
    "emissiveFactor":[1,0.5,0],"alphaMode":"MASK","alphaCutoff":0.7,"doubleSided":true,
    "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8},"KHR_materials_ior":{"ior":1.33}}},
    {"name":"glass","pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},
     "extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}},
    {"name":"half","extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5}}}])");
  EXPECT_EQ(model.meshes[0].materials, (std::vector<std::uint32_t>{1, 1}));
  const Material& plain = model.materials[0]; // the standard's defaults
  EXPECT_EQ(plain.model, MaterialId::MetalRough);
  EXPECT_EQ(plain.colour, glm::dvec3(1.0));
  EXPECT_EQ(plain.metallic, 1.0);
  EXPECT_EQ(plain.roughness, 1.0);
  const Material& lamp = model.materials[1];
  EXPECT_EQ(lamp.colour, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(lamp.opacity, 0.4);
  EXPECT_EQ(lamp.metallic, 0.5);
  EXPECT_EQ(lamp.roughness, 0.25);
  EXPECT_EQ(lamp.emission, glm::dvec3(8.0, 4.0, 0.0));
  EXPECT_EQ(lamp.ior, 1.33);
  EXPECT_EQ(lamp.alpha, Alpha::Mask);
  EXPECT_EQ(lamp.alphaCutoff, 0.7);
  EXPECT_TRUE(lamp.twoSided);
  EXPECT_EQ(model.materials[2].model, MaterialId::Dielectric);
  EXPECT_EQ(model.materials[2].roughness, 0.0);
  EXPECT_EQ(model.materials[3].model, MaterialId::MetalRough);
  EXPECT_THAT(warnings(model), HasSubstr("Material \"half\" transmits in part"));
}

TEST(Gltf, TexturesAreReadOncePerUse) {
  const test::TemporaryFolder folder;
  test::write(folder / "a b.bmp", test::bmp(2, 2, {0xff0000, 0x00ff00, 0x0000ff, 0x102030}));
  const Model model = loadSquare(folder.path(), squareMesh(R"(,"material":0)") + R"(,
    "images":[{"uri":"a%20b.bmp"}],"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728}],
    "textures":[{"source":0,"sampler":0},{"source":0,"sampler":0}],
    "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0}},
      "normalTexture":{"index":0,"scale":0.5},"emissiveTexture":{"index":1}}])");
  ASSERT_EQ(model.textures.size(), 2U); // as colours and as numbers
  const Material& material = model.materials[0];
  EXPECT_EQ(material.colourTexture.texture, material.emissionTexture.texture);
  EXPECT_EQ(material.normalTexture.texture, material.metalRoughTexture.texture);
  EXPECT_EQ(material.normalScale, 0.5);
  const Texture& texture = model.textures[material.colourTexture.texture];
  EXPECT_TRUE(texture.srgb);
  EXPECT_FALSE(model.textures[material.normalTexture.texture].srgb);
  EXPECT_EQ(texture.size, glm::uvec2(2, 2));
  EXPECT_EQ(texture.texels, (std::vector<std::uint32_t>{0xff0000ff, 0xff00ff00, 0xffff0000, 0xff302010}));
  EXPECT_EQ(texture.wrapU, Wrap::Clamp);
  EXPECT_EQ(texture.wrapV, Wrap::Mirror);
  EXPECT_TRUE(texture.nearest);
}

TEST(Gltf, TextureTransformIsThatOfTheStandardsExample) {
  const test::TemporaryFolder folder;
  test::write(folder / "a.bmp", test::bmp(1, 1, {0xffffff}));
  // The extension's example: offset (0, 1), a quarter turn, scale 1/2 take the lower left quarter of the picture.
  const Model model = loadSquare(folder.path(), squareMesh(R"(,"material":0)") + R"(,"images":[{"uri":"a.bmp"}],
    "textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0,"extensions":{"KHR_texture_transform":
    {"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5]}}}}])");
  const TextureUse& use = model.materials[0].emissionTexture;
  const auto seen = [&use](double u, double v) {
    return glm::dvec2(glm::dot(use.rowU, glm::dvec3(u, v, 1.0)), glm::dot(use.rowV, glm::dvec3(u, v, 1.0)));
  };
  EXPECT_NEAR(glm::length(seen(0.0, 0.0) - glm::dvec2(0.0, 1.0)), 0.0, 1e-9); // v = 1 is the lowest row
  EXPECT_NEAR(glm::length(seen(1.0, 1.0) - glm::dvec2(0.5, 0.5)), 0.0, 1e-9);
  EXPECT_NEAR(glm::length(seen(1.0, 0.0) - glm::dvec2(0.0, 0.5)), 0.0, 1e-9);
}

TEST(Gltf, WhatTexturesLackIsSaid) {
  const test::TemporaryFolder folder;
  test::write(folder / "a.bmp", test::bmp(1, 1, {0xffffff}));
  const std::string images = R"(,"images":[{"uri":"a.bmp"},{"uri":"none.png"}],"textures":[{"source":0},{"source":1}])";
  const auto material = [&](const std::string& texture) {
    return images + R"(,"materials":[{"name":"m","pbrMetallicRoughness":{"baseColorTexture":)" + texture + "}}]";
  };
  const Model missing = loadSquare(folder.path(), squareMesh(R"(,"material":0)") + material(R"({"index":1})"));
  EXPECT_THAT(warnings(missing), HasSubstr("image \"none.png\" is not used"));
  EXPECT_EQ(missing.materials[0].colourTexture.texture, kNone);
  const Model second =
      loadSquare(folder.path(), squareMesh(R"(,"material":0)") + material(R"({"index":0,"texCoord":1})"));
  EXPECT_THAT(warnings(second), HasSubstr("another set of texture coordinates"));
  EXPECT_EQ(second.materials[0].colourTexture.texture, kNone);
  std::string rest = squareMesh(R"(,"material":0)") + material(R"({"index":0})");
  rest.erase(rest.find(R"(,"TEXCOORD_0":2)"), 15);
  const Model bare = loadSquare(folder.path(), rest);
  EXPECT_THAT(warnings(bare), HasSubstr("no texture coordinates"));
  ASSERT_EQ(bare.meshes[0].materials[0], 1U); // a copy without textures
  EXPECT_EQ(bare.materials[1].colourTexture.texture, kNone);
  EXPECT_EQ(bare.materials[0].colourTexture.texture, 0U);
}

TEST(Gltf, LightsAndCamerasTakeTheirNodesPlaces) {
  const test::TemporaryFolder folder;
  std::string rest = squareMesh() + R"(,"extensions":{"KHR_lights_punctual":{"lights":[
    {"type":"spot","color":[1,0.5,0.25],"intensity":4,"spot":{"innerConeAngle":0.5235987755982988,
     "outerConeAngle":0.7853981633974483}},{"type":"directional","intensity":3},{"type":"laser"}]}},
    "cameras":[{"type":"perspective","perspective":{"yfov":0.7853981633974483,"znear":0.1}},
      {"type":"orthographic","orthographic":{"xmag":1,"ymag":2.5,"znear":0,"zfar":9}}])";
  rest.replace(rest.find(R"([{"mesh":0}])"), 12, R"([{"mesh":0,"children":[1,2,3,4,5]},
    {"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[1,2,3],"scale":[7,7,7],
     "rotation":[0.70710678118654757,0,0,0.70710678118654757]},
    {"extensions":{"KHR_lights_punctual":{"light":1}}},{"extensions":{"KHR_lights_punctual":{"light":2}}},
    {"camera":0,"translation":[0,0,9],"scale":[2,2,2]},{"camera":1}])");
  const Model model = loadSquare(folder.path(), rest);
  ASSERT_EQ(model.lights.size(), 2U);
  const PunctualLight& spot = model.lights[0];
  EXPECT_EQ(spot.kind, PunctualLight::Kind::Spot);
  EXPECT_EQ(spot.position, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_NEAR(glm::length(spot.direction - glm::dvec3(0.0, 1.0, 0.0)), 0.0, 1e-12); // -z turned about x by a quarter
  EXPECT_EQ(spot.intensity, glm::dvec3(4.0, 2.0, 1.0));
  EXPECT_NEAR(spot.innerAngle, 30.0, 1e-9);
  EXPECT_NEAR(spot.outerAngle, 45.0, 1e-9);
  EXPECT_EQ(model.lights[1].kind, PunctualLight::Kind::Directional);
  EXPECT_THAT(warnings(model), HasSubstr("1 lights of unknown kind"));
  ASSERT_EQ(model.cameras.size(), 2U);
  EXPECT_NEAR(model.cameras[0].verticalFov, 45.0, 1e-9);
  EXPECT_EQ(model.cameras[0].worldFromCamera[3], glm::dvec4(0.0, 0.0, 9.0, 1.0));
  EXPECT_NEAR(glm::determinant(model.cameras[0].worldFromCamera), 1.0, 1e-12);
  EXPECT_FALSE(model.cameras[1].perspective);
  EXPECT_EQ(model.cameras[1].height, 5.0);
}

TEST(Gltf, SparseAndNormalisedAccessors) {
  const test::TemporaryFolder folder;
  std::string buffer = test::squareBuffer(); // 140 bytes; then uvs of 16 bits, a sparse index and its position
  const std::uint16_t uvs[8] = {0, 65535, 65535, 65535, 65535, 0, 0, 0};
  buffer.append(reinterpret_cast<const char*>(uvs), 16);
  const float moved[3] = {1.0F, 3.0F, 0.0F};
  buffer.append(std::string("\x02\0\0\0", 4));
  buffer.append(reinterpret_cast<const char*>(moved), 12);
  std::string json = squareGltf(squareMesh());
  const auto replace = [&json](const std::string& from, const std::string& to) {
    ASSERT_NE(json.find(from), std::string::npos) << from;
    json.replace(json.find(from), from.size(), to);
  };
  replace(R"("byteLength":140)", R"("byteLength":172)");
  replace(R"("byteLength":12}])", R"("byteLength":12},{"buffer":0,"byteOffset":140,"byteLength":16},
    {"buffer":0,"byteOffset":156,"byteLength":4},{"buffer":0,"byteOffset":160,"byteLength":12}])");
  replace(R"({"bufferView":2,"componentType":5126,)", R"({"bufferView":4,"componentType":5123,"normalized":true,)");
  replace(R"("count":4,"type":"VEC3"})", R"("count":4,"type":"VEC3","sparse":{"count":1,
    "indices":{"bufferView":5,"componentType":5121},"values":{"bufferView":6}}})");
  test::write(folder / "square.bin", buffer);
  const Model model = loadModel(test::write(folder / "sparse.gltf", json));
  EXPECT_EQ(model.meshes[0].positions[2], glm::vec3(1.0F, 3.0F, 0.0F));
  EXPECT_EQ(model.meshes[0].positions[1], glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(model.meshes[0].uvs[1], glm::vec2(1.0F, 1.0F));
}

TEST(Gltf, NodesInACircleArePlacedOnce) {
  const test::TemporaryFolder folder;
  std::string rest = squareMesh();
  rest.replace(rest.find(R"([{"mesh":0}])"), 12, R"([{"mesh":0,"children":[1,7]},{"children":[0,1]}])");
  const Model model = loadSquare(folder.path(), rest);
  EXPECT_EQ(model.nodes.size(), 1U);
  EXPECT_THAT(warnings(model), HasSubstr("2 nodes are their own ancestors"));
  EXPECT_THAT(warnings(model), HasSubstr("1 references to nodes"));
}

TEST(Gltf, ExtensionsAreHonouredRefusedOrNamed) {
  const test::TemporaryFolder folder;
  const Model model =
      loadSquare(folder.path(), squareMesh() + R"(,"extensionsUsed":["KHR_materials_clearcoat","KHR_materials_ior"])");
  EXPECT_EQ(warnings(model), "What the extension KHR_materials_clearcoat says is passed over.\n");
  test::write(folder / "draco.gltf",
              squareGltf(squareMesh() + R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"));
  EXPECT_THAT(test::refusal(folder / "draco.gltf"), HasSubstr("requires the extension KHR_draco_mesh_compression"));
}

} // namespace
} // namespace tyndall::geometry
