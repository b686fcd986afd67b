// SPDX-License-Identifier: Apache-2.0
// Mistakes in materials, objects and the media inside them, each found where it stands.
#include "scene/marked.h"

namespace tyndall::scene {
namespace {

using test::expectOne;
using test::listed;
using test::Malformed;
using test::parse;

/// Sound but for what the members add: `members` are further top-level lists.
std::string lit(const std::string& members) { return "{\"lights\": [{\"type\": \"point\"}],\n " + members + "\n}"; }

constexpr const char* kGlass = R"("materials": [{"name": "glass", "type": "dielectric"}])";

std::string ofMaterial(const std::string& members) {
  return lit("\"objects\": [{\"type\": \"sphere\"}],\n \"materials\": [\n  {\"name\": \"a\", " + members + "}]");
}
std::string ofObject(const std::string& members) { return lit("\"objects\": [\n  {" + members + "}]"); }

/// A medium "fog" and a material "skin" of type null, beside the objects.
std::string filled(const std::string& objects, const std::string& medium = R"("shape": {"type": "objects"})") {
  return lit(R"("media": [{"name": "fog", "type": "homogeneous", )" + medium +
             "}],\n \"materials\": [{\"name\": \"skin\", \"type\": \"null\"}],\n \"objects\": [" + objects + "]");
}

TEST(SurfaceProblems, TheFramesAroundTheCasesAreSound) {
  for (const std::string& text : {ofMaterial(R"("type": "diffuse")"), ofObject(R"("type": "quad")"),
                                  filled(R"({"type": "sphere", "material": "skin", "medium": "fog"})")}) {
    const LoadResult result = parse(text);
    EXPECT_TRUE(result.problems.empty()) << listed(result);
  }
}

TEST(SurfaceProblems, Materials) {
  const std::vector<Malformed> cases{
      {R"("type": @"metal")", "must be \"null\", \"diffuse\", \"conductor\", \"dielectric\" or \"metal_rough\""},
      {R"("type": @"conducter")", "did you mean \"conductor\"?"},
      {R"("type": "null", @"emission": 1)", "only with every type but \"null\"; remove it or change the type"},
      {R"("type": "null", @"colour": 1)", "only with every type but \"null\""},
      {R"("type": "null", @"opacity": 1)", "only with every type but \"null\""},
      {R"("type": "null", @"two_sided": true)", "only with every type but \"null\""},
      {R"("type": "diffuse", "colour": @1.2)", "materials.0.colour: must be a number from 0 to 1, or a list of three"},
      {R"("type": "diffuse", "colour": [0, @-1, 0])", "materials.0.colour.1: must be a number from 0 to 1"},
      {R"("type": "diffuse", @"roughness": 0)", "\"conductor\", \"dielectric\" or \"metal_rough\""},
      {R"("type": "diffuse", @"metallic": 0)", "only with type \"metal_rough\""},
      {R"("type": "conductor", @"ior": 1.5)", "only with type \"dielectric\" or \"metal_rough\""},
      {R"("type": "dielectric", @"eta": 1)", "only with type \"conductor\""},
      {R"("type": "dielectric", @"k": 1)", "only with type \"conductor\""},
      {R"("type": "dielectric", "ior": @0.99)", "must be a number from 1 to 4"},
      {R"("type": "dielectric", "ior": @4.01)", "must be a number from 1 to 4"},
      {R"("type": "metal_rough", "roughness": @1.01)", "must be a number from 0 to 1"},
      {R"("type": "metal_rough", "metallic": @-0.1)", "must be a number from 0 to 1"},
      {R"("type": "conductor", "k": @101)", "must be a number from 0 to 100"},
      {R"("type": "conductor", "eta": @-1)", "must be a number from 0 to 100"},
      {R"("type": "diffuse", "opacity": @2)", "must be a number from 0 to 1"},
      {R"("type": "diffuse", "emission": @-2)", "must be a number from 0 to"},
      {R"("type": "diffuse", "two_sided": @1)", "must be true or false"},
      {R"("type": "diffuse", @"color": 1)", "did you mean \"colour\"?"},
  };
  for (const Malformed& malformed : cases) {
    expectOne(ofMaterial(malformed.text), malformed.message, false);
  }
  expectOne(ofMaterial(R"("type": "conductor", "eta": @1.5)"), "has no effect while k is 0", true);
  expectOne(lit(R"("objects": [{"type": "quad"}], "materials": [@{"type": "diffuse"}])"),
            "materials.0.name: is missing", false);
  expectOne(lit(R"("objects": [{"type": "quad"}], "materials": [{"type": "diffuse", "name": @""}])"), "must be a name",
            false);
  expectOne(lit(R"("objects": [{"type": "quad"}],
                   "materials": [{"name": "a", "type": "null"}, {"type": "diffuse", "name": @"a"}])"),
            "materials.1.name: is also the name of materials.0; rename one", false);
  for (const char* ior : {"1", "4"}) {
    EXPECT_TRUE(parse(ofMaterial(R"("type": "dielectric", "ior": )" + std::string(ior))).ok()) << ior;
  }
}

TEST(SurfaceProblems, Objects) {
  const std::vector<Malformed> cases{
      {R"("type": @"cube")", "must be \"mesh\", \"quad\", \"box\" or \"sphere\""},
      {R"("type": "mesh", "file": @"rom.glb")", "did you mean \"room.glb\"?"},
      {R"("type": "mesh", "file": @"room_##.glb")", "a mesh is one file, not a sequence"},
      {R"("type": "sphere", @"file": "room.glb")", "only with type \"mesh\""},
      {R"("type": "sphere", @"lights": true)", "only with type \"mesh\""},
      {R"("type": "sphere", @"edge_u": [1, 0, 0])", "only with type \"quad\""},
      {R"("type": "quad", @"radius": 1)", "only with type \"sphere\""},
      {R"("type": "quad", @"min": [0, 0, 0])", "only with type \"box\""},
      {R"("type": "sphere", "radius": @0)", "must be a number above 0"},
      {R"("type": "sphere", "priority": @1001)", "must be a whole number from 0 to 1000"},
      {R"("type": "sphere", "transform": [@{"scale": 0}])", "objects.0.transform.0: flattens space"},
      {R"("type": "sphere", "transform": @[{"scale": [1, 1, 2]}])",
       "objects.0.transform: makes the sphere an ellipsoid"},
      {R"("type": "sphere", "transform": @[{"matrix": [1, 0.1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}])",
       "makes the sphere an ellipsoid"},
      {R"("type": "sphere", "transform": @[{"matrix": [1, 0.6, 0, 0, 0, 0.8, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}])",
       "makes the sphere an ellipsoid"},
      {R"("type": "sphere", "instances": [[{"scale": 2}], @[{"scale": [1, 1, 2]}]])",
       "objects.0.instances.1: makes the sphere an ellipsoid"},
      {R"("type": "sphere", "instances": [[@{"scale": [1, 0, 2]}]])", "objects.0.instances.0.0: flattens space"},
      {R"("type": "box", "min": [0, 0, 0], "max": @[1, 0, 1])", "must be above min in y, but 0 is not above 0"},
      {R"("type": "quad", "edge_u": [1, 2, 3], "edge_v": @[2, 4, 6])", "spans no area with edge_u"},
      {R"("type": "quad", "edge_v": @[0, 0, 0])", "spans no area with edge_u"},
      {R"("type": "sphere", "material": @"glas")", "there is no \"glas\" in \"materials\"; nothing in \"materials\""},
  };
  for (const Malformed& malformed : cases) {
    expectOne(ofObject(malformed.text), malformed.message, false);
  }
  expectOne(lit(R"("objects": [@{"type": "mesh"}])"), "objects.0.file: is missing", false);
  expectOne(lit(R"("objects": [@{"type": "box", "max": [1, 1, 1]}])"), "objects.0.min: is missing", false);
  expectOne(lit(R"("objects": [@{}])"), "objects.0.type: is missing", false);
}

TEST(SurfaceProblems, SpheresMayBeTurnedScaledMirroredAndMoved) {
  const std::string turned = R"([{"rotate": {"axis": [1, 2, 3], "degrees": 33}}, {"scale": -0.01}])";
  EXPECT_TRUE(parse(ofObject(R"("type": "sphere", "transform": )" + turned)).problems.empty());
  // What the transform distorts, instances may put right.
  const std::string undone = R"("transform": [{"scale": [2, 1, 1]}], "instances": [[{"scale": [0.5, 1, 1]}]])";
  EXPECT_TRUE(parse(ofObject(R"("type": "sphere", )" + undone)).problems.empty());
}

TEST(SurfaceProblems, NamesOfMaterialsAndMedia) {
  const std::string objects = "\"objects\": [{\"type\": \"box\", \"min\": [0, 0, 0], \"max\": [1, 1, 1], ";
  expectOne(lit(std::string(kGlass) + ", " + objects + "\"material\": @\"glas\"}]"),
            "objects.0.material: there is no \"glas\" in \"materials\"; did you mean \"glass\"?", false);
  expectOne(lit(std::string(kGlass) + ", " + objects + "\"material\": @\"steel\"}]"), "\"materials\" has glass", false);
  expectOne(lit(objects + "\"medium\": @\"fog\"}]"), "objects.0.medium: there is no \"fog\" in \"media\"", false);
  expectOne(filled(R"({"type": "sphere", "medium": "fog"}, {"type": "sphere", "medium": @"fgo"})"),
            "did you mean \"fog\"?", false);
  expectOne(lit(R"("objects": [{"name": "a", "type": "sphere"}, {"type": "quad", "name": @"a"}])"),
            "objects.1.name: is also the name of objects.0", false);
  // A material whose own text is broken is not also reported as missing.
  expectOne(lit(objects + "\"material\": \"a\"}], \"materials\": [@5]"), "must be an object", false);
}

TEST(SurfaceProblems, MediaInsideObjects) {
  const std::string ball = R"({"type": "sphere", "material": "skin", "medium": "fog"})";
  expectOne(filled(R"({"type": "quad", "medium": @"fog"})"), "objects.0.medium: cannot be inside a quad", false);
  expectOne(filled(R"({"type": "sphere", "medium": @"fog"})", R"("shape": {"type": "sphere"})"),
            "\"fog\" has a shape of its own; give media.0 the shape", false);
  expectOne(lit(R"("media": [{"name": "fog", "type": "grid", "file": "smoke.vdb"}],
                   "objects": [{"type": "sphere", "medium": @"fog"}])"),
            "\"fog\" is of type \"grid\", but only a homogeneous medium can fill an object", false);
  expectOne(filled(R"({"type": "sphere"})", R"("shape": @{"type": "objects"})"),
            "media.0.shape: is inside objects, but no object names the medium", false);
  expectOne(lit(R"("media": [{"type": "homogeneous", "shape": @{"type": "objects"}}])"),
            "but no object can name the medium", false);
  expectOne(filled(ball, R"("shape": {"type": "objects"}, "transform": @[{"scale": 2}])"),
            "media.0.transform: has no meaning for the shape \"objects\"", false);
  expectOne(filled(ball, R"("shape": {"type": "objects"}, "instances": @[[]])"),
            "media.0.instances: has no meaning for the shape \"objects\"", false);
  expectOne(filled(ball + R"(, {"type": "sphere", "material": @"skin"})"),
            "\"skin\" is of type \"null\" and there is no medium inside", true);
}

TEST(SurfaceProblems, InteriorsAreCounted) {
  const std::string glass = R"({"type": "sphere", "material": "glass", "instances": [[], [], []]})";
  const std::string cloud = R"({"type": "sphere", "medium": "fog"})";
  std::string objects = R"({"type": "quad"})";
  for (int i = 0; i < 32; ++i) {
    objects += ",\n" + (i % 2 == 0 ? glass : cloud);
  }
  const auto scene = [&](const std::string& last) {
    return lit(R"("media": [{"name": "fog", "type": "homogeneous", "shape": {"type": "objects"}}], )" +
               std::string(kGlass) + ", \"objects\": [" + objects + last + "]");
  };
  EXPECT_TRUE(parse(scene("")).problems.empty()) << listed(parse(scene("")));
  expectOne(scene(",\n @" + glass), "objects.33: is one too many with a medium or a dielectric material: at most 32",
            false);
}

TEST(SurfaceProblems, SomethingMustShine) {
  const std::string dark = R"({"lights": @[], "objects": [)";
  expectOne(dark + R"({"type": "sphere"}]})", "the picture will be black", true);
  expectOne(dark + R"({"type": "mesh", "file": "room.glb", "lights": false, "material": "a"}],
                     "materials": [{"name": "a", "type": "diffuse"}]})",
            "the picture will be black", true);
  const std::vector<std::string> bright{
      R"({"type": "mesh", "file": "room.glb"}])", R"({"type": "mesh", "file": "room.glb", "lights": false}])",
      R"({"type": "quad", "material": "a"}], "materials": [{"name": "a", "type": "diffuse", "emission": 1}])"};
  for (const std::string& rest : bright) {
    const LoadResult result = parse(R"({"lights": [], "objects": [)" + rest + "}");
    EXPECT_TRUE(result.problems.empty()) << listed(result);
  }
}

TEST(SurfaceProblems, SpotsReachIntoAnUnboundedMedium) {
  const std::string fog = R"({"media": [{"type": "homogeneous"}], "lights": [{"type": "spot"}]})";
  EXPECT_TRUE(parse(fog).problems.empty()) << listed(parse(fog));
}

} // namespace
} // namespace tyndall::scene
