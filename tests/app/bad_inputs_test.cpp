// SPDX-License-Identifier: Apache-2.0
// Whatever a user gets wrong: the program ends by itself with an exit code that is not 0, names the file or option and
// the fix, and leaves nothing behind.
#include "app/inputs.h"
#include "app/program.h"
#include "support/fixtures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

namespace tyndall::test {
namespace {

using testing::HasSubstr;

struct BadInput {
  const char* arguments; ///< {in}: the folder of inputs()
  const char* culprit;   ///< the file, option or value that stderr must name
  const char* fix;       ///< part of what stderr must advise
};

// So that a failing case shows its command line.
void PrintTo(const BadInput& input, std::ostream* stream) { *stream << input.arguments; }

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, AreExplainedAndLeaveNothingBehind) {
  const BadInput& input = GetParam();
  const TemporaryFolder folder;
  const std::vector<std::string> before = namesIn(inputs());
  const Outcome outcome = runProgram(wordsOf(input.arguments, inputs()), folder.path());
  EXPECT_FALSE(outcome.timedOut);
  EXPECT_EQ(outcome.signal, 0) << outcome.errors;
  EXPECT_TRUE(outcome.exitCode == 1 || outcome.exitCode == 2) << outcome.exitCode << outcome.output;
  EXPECT_THAT(outcome.errors, HasSubstr(input.culprit));
  EXPECT_THAT(outcome.errors, HasSubstr(input.fix));
  EXPECT_THAT(namesIn(folder.path()), testing::IsEmpty());
  EXPECT_EQ(namesIn(inputs()), before);
}

const BadInput kVolumes[] = {
    {"render {in}/cut_4.vdb", "cut_4.vdb", "export it as OpenVDB"},
    {"render {in}/cut_20.vdb", "cut_20.vdb", "export it again"},
    {"render {in}/cut_100.vdb", "cut_100.vdb", "export it again"},
    {"render {in}/cut_300.vdb", "cut_300.vdb", "export it again"},
    {"render {in}/cut_tenth_1.vdb", "cut_tenth_1.vdb", "export it again"},
    {"render {in}/cut_tenth_5.vdb", "cut_tenth_5.vdb", "export it again"},
    {"render {in}/cut_tenth_9.vdb", "cut_tenth_9.vdb", "export it again"},
    {"render {in}/cut_last_byte.vdb", "cut_last_byte.vdb", "export it again"},
    {"render {in}/text.vdb", "text.vdb", "not a VDB file"},
    {"render {in}/zero_bytes.vdb", "zero_bytes.vdb", "empty (0 bytes)"},
    {"render {in}/nano.vdb", "nano.vdb", "nanovdb_convert"},
    {"render {in}", "tyndall_", "a file is needed"},
    {"render none.vdb", "none.vdb", "No such file"},
    {"render {in}/plain.vdb --grid densty", "densty", "did you mean 'density'"},
    {"render {in}/vec3_only.vdb", "vec3_only.vdb", "export a scalar grid"},
    {"render {in}/points_only.vdb", "points_only.vdb", "rasterise"},
    {"render {in}/no_grids.vdb", "no_grids.vdb", "export the volume again"},
    {"render {in}/far_tile.vdb", "far_tile.vdb", "clip"},
    {"render {in}/plain.vdb --memory 1K", "--memory", "allow more"},
    {"info {in}/text.vdb", "text.vdb", "not a VDB file"},
    {"info {in}/cut_tenth_5.vdb", "cut_tenth_5.vdb", "export it again"},
    {"info {in}/damaged.exr", "damaged.exr", "(.vdb)"},
    {"info none.json", "none.json", "no such file"},
};
INSTANTIATE_TEST_SUITE_P(Volumes, BadInputs, testing::ValuesIn(kVolumes));

const BadInput kScenes[] = {
    {"render {in}/unclosed.json", "unclosed.json:1:", "]"},
    {"render {in}/no_comma.json", "no_comma.json:1:", "comma"},
    {"render {in}/empty.json", "empty.json:1:1", "{"},
    {"render {in}/list.json", "list.json:1:1", "object"},
    {"render {in}/not_utf8.json", "not_utf8.json:1:", "UTF-8"},
    {"render {in}/nan.json", "nan.json:1:", "NaN"},
    {"render {in}/unknown_key.json", "rendr", "\"render\""},
    {"render {in}/unknown_medium_key.json", "extinctoin", "\"extinction\""},
    {"render {in}/wrong_type.json", "media.0.albedo", "number"},
    {"render {in}/out_of_range.json", "media.0.albedo", "0 to 1"},
    {"render {in}/negative.json", "media.0.extinction", "from 0 to"},
    {"render {in}/duplicate.json", "duplicate.json:1:", "remove one"},
    {"render {in}/zero_size.json", "film.size", "1 to 65536"},
    {"render {in}/camera_in_target.json", "camera", "target"},
    {"render {in}/bad_transform.json", "media.0.transform", "no factor may be 0"},
    {"render {in}/unknown_step.json", "rotat", "rotate"},
    {"render {in}/unknown_phase.json", "henyey", "henyey-greenstein"},
    {"render {in}/no_parameter.json", "media.0.phase", "g"},
    {"render {in}/no_medium_type.json", "media.0", "type"},
    {"render {in}/unbounded_sun.json", "lights.0", "shape"},
    {"render {in}/missing_volume.json", "plian.vdb", "did you mean \"plain.vdb\""},
    {"render {in}/missing_grid.json", "densty", "did you mean 'density'"},
    {"render {in}/vector_grid.json", "vec3_only.vdb", "export a density"},
    {"render {in}/cut_volume.json", "cut_tenth_5.vdb", "export it again"},
    {"render {in}/missing_map.json", "sky.exr", "correct the name"},
    {"render {in}/damaged_map.json", "damaged.exr", "again"},
    {"render {in}/text_map.json", "text.exr", "OpenEXR"},
    {"render none.json", "none.json", "no such file"},
    {"check {in}/no_comma.json", "no_comma.json:1:14: error:", "comma"},
    {"check {in}/missing_grid.json", "missing_grid.json:1:58: error: media.0.grid", "did you mean \"density\""},
    {"check {in}/vector_grid.json", "media.0.grid", "name a scalar grid"},
    {"check {in}/cut_volume.json", "cut_volume.json:1:37: error: media.0.file", "export it again"},
    {"check {in}/damaged_map.json", "lights.0.file", "again"},
    {"check {in}/text_map.json", "lights.0.file", "OpenEXR"},
    {"check {in}/plain.vdb", "plain.vdb", "tyndall info"},
    {"check {in}/picture_8x8.exr", "picture_8x8.exr", ".json"},
    {"check none.json", "none.json", "no such file"},
};
INSTANTIATE_TEST_SUITE_P(Scenes, BadInputs, testing::ValuesIn(kScenes));

const BadInput kSurfaces[] = {
    {"render {in}/flat.obj", "flat.obj: is a mesh", "\"objects\""},
    {"check {in}/flat.obj", "flat.obj: is a mesh", "\"objects\""},
    {"info {in}/flat.obj", "flat.obj: is a mesh", "\"objects\""},
    {"render {in}/missing_mesh.json", "missing_mesh.json:1:", "did you mean \"flat.obj\""},
    {"render {in}/flat_mesh.json", "flat.obj", "export it with its surfaces"},
    {"render {in}/empty_mesh.json", "empty.obj", "export it again"},
    {"render {in}/text_mesh.json", "text.ply", "check the file"},
    {"render {in}/volume_mesh.json", "plain.vdb", ".gltf, .glb, .obj or .ply"},
    {"render {in}/parallel_quad.json", "objects.0.edge_v", "not parallel"},
    {"render {in}/unknown_material.json", "objects.0.material", "did you mean \"glass\""},
    {"render {in}/surfaces.json --estimator march", "--estimator march", "--estimator path"},
    {"render {in}/surfaces.json --estimator tracking", "--estimator tracking", "--estimator path"},
    {"render {in}/surfaces.json --preview", "--preview", "leave --preview away"},
    {"render {in}/sound.json --depth 2 --estimator march", "--estimator march", "--estimator path"},
    {"check {in}/missing_mesh.json", "objects.0.file", "did you mean \"flat.obj\""},
    {"check {in}/flat_mesh.json", "flat_mesh.json:1:39: error: objects.0.file", "export it with its surfaces"},
    {"check {in}/text_mesh.json", "objects.0.file", "check the file"},
};
INSTANTIATE_TEST_SUITE_P(Surfaces, BadInputs, testing::ValuesIn(kSurfaces));

const BadInput kOptions[] = {
    {"render {in}/sound.json -o nowhere/out.exr", "nowhere", "create it"},
    {"render {in}/sound.json -o {in}/folder.exr", "folder.exr", "name a file"},
    {"render {in}/sound.json -o {in}/sound.json/out.exr", "sound.json", "name another output with -o"},
    {"render {in}/sound.json -o /proc/out.exr", "/proc", "name another output with -o"},
    {"render {in}/sound.json -o out.jpg", "out.jpg", ".exr"},
    {"render {in}/sound.json --stats nowhere/stats.json", "nowhere", "create it"},
    {"render {in}/sound.json --spp 0", "--spp 0", "1"},
    {"render {in}/sound.json --spp -1", "--spp -1", "whole number"},
    {"render {in}/sound.json --spp abc", "--spp abc", "whole number"},
    {"render {in}/sound.json --spp 1e30", "--spp 1e30", "whole number"},
    {"render {in}/sound.json --seed 4294967296", "--seed 4294967296", "4294967295"},
    {"render {in}/sound.json --size 0x0", "--size 0x0", "65536"},
    {"render {in}/sound.json --size 99999999x1", "--size 99999999x1", "65536"},
    {"render {in}/sound.json --size 640", "--size 640", "640x480"},
    {"render {in}/sound.json --crop 0,0,5000,10", "--crop", "640x480"},
    {"render {in}/sound.json --crop 5,5,5,5", "--crop 5,5,5,5", "x0"},
    {"render {in}/sound.json --error 0", "--error 0", "1%"},
    {"render {in}/sound.json --error -1%", "--error -1%", "0.01"},
    {"render {in}/sound.json --time -1", "--time -1", "60s"},
    {"render {in}/sound.json --time soon", "--time soon", "60s"},
    {"render {in}/plain_####.vdb --frames 3-1", "3-1", "1-3"},
    {"render {in}/plain_####.vdb --frames 1-2", "plain_0001.vdb", "frame"},
    {"render {in}/plain_####.vdb", "plain_####.vdb", "--frames"},
    {"render {in}/sound.json --memory little", "--memory little", "2G"},
    {"render {in}/sound.json --set film.sise=[4,4]", "film.sise", "size"},
    {"render {in}/sound.json --set film.size=[0,4]", "film.size", "1 to 65536"},
    {"render {in}/sound.json --set film", "--set film", "film.exposure=1"},
    {"render {in}/sound.json --aov depht", "depht", "depth"},
    {"render {in}/sound.json --device nosuch", "nosuch", "not selected"},
    {"render {in}/sound.json --depth some", "--depth some", "unlimited"},
    {"render {in}/sound.json --depth 65537", "--depth 65537", "65536"},
    {"render {in}/sound.json --tracker fast", "--tracker fast", "weighted"},
    {"render {in}/sound.json --estimator fast", "--estimator fast", "march"},
    {"render {in}/sound.json --integrator fast", "--integrator fast", "mcpg-paper"},
    {"render {in}/sound.json --light-sampling maybe", "--light-sampling maybe", "off"},
    {"render {in}/sound.json --integrator mcpg --error 5%", "--error", "--integrator path"},
    {"render {in}/sound.json --integrator screen-chains --deterministic", "render.deterministic", "take mcpg"},
    {"render {in}/sound.json --integrator mcpg --deterministic --set guide.distance_share=0.5", "guide.distance_share",
     "leave --deterministic away"},
    {"render {in}/sound.json --preview --estimator tracking", "--preview", "leave"},
    {"render {in}/sound.json --preview --tracker delta", "--preview", "--tracker away"},
    {"render {in}/sound.json --estimator march --tracker delta", "--tracker", "--estimator tracking"},
    {"render {in}/sound.json --grid density", "--grid", "--set"},
    {"render {in}/sound.json --sp 4", "--sp", "did you mean --spp"},
    {"render {in}/sound.json --spp", "--spp", "--help"},
    {"render {in}/sound.json {in}/sound.json", "one argument too many", "--help"},
    {"render", "required", "--help"},
    {"rendr {in}/sound.json", "rendr", "did you mean render"},
    {"{in}/plain.vdb", "plain.vdb", "tyndall render"},
    {"--spp 4", "--spp", "tyndall render FILE --spp"},
    {"-v", "command is missing", "tyndall render FILE"},
    {"devices --device nosuch", "nosuch", "not selected"},
    {"verify furnance", "furnance", "did you mean furnace?"},
    {"verify furnace --json nowhere/checks.json", "nowhere", "create it"},
    {"verify --device nosuch", "nosuch", "not selected"},
};
INSTANTIATE_TEST_SUITE_P(Options, BadInputs, testing::ValuesIn(kOptions));

const BadInput kFilms[] = {
    {"compare {in}/picture_8x8.exr {in}/picture_8x4.exr", "picture_8x4.exr", "8x4"},
    {"compare {in}/picture_8x8.exr none.exr", "none.exr", "check the name"},
    {"compare {in}/picture_8x8.exr {in}/text.exr", "text.exr", "name a .exr"},
    {"compare {in}/picture_8x8.exr {in}/damaged.exr", "damaged.exr", "again"},
    {"compare {in}/picture_8x8.exr", "required", "--help"},
    {"compare {in}/picture_8x8.exr {in}/picture_8x8.exr --max-bias much", "--max-bias", "1%"},
    {"compare {in}/picture_8x8.exr {in}/picture_8x8.exr --max-rrmse -1", "--max-rrmse", "1%"},
    {"compare {in}/picture_8x8.exr {in}/picture_8x8.exr --difference nowhere/d.png", "nowhere", "create it"},
    {"merge {in}/left.part {in}/left.part -o out.exr", "left.part", "another --seed"},
    {"merge {in}/left.part {in}/other_scene.part -o out.exr", "other_scene.part", "parts of one scene"},
    {"merge {in}/picture_8x8.exr {in}/left.part -o out.exr", "picture_8x8.exr", "--mergeable"},
    {"merge {in}/left.part none.part -o out.exr", "none.part", "check the name"},
    {"merge {in}/damaged.part {in}/right.part -o out.exr", "damaged.part", "render again"},
    {"merge {in}/left.part {in}/right.part", "--output", "--help"},
    {"merge {in}/left.part {in}/right.part -o out.png", "out.png", ".exr"},
    {"merge {in}/left.part {in}/right.part -o nowhere/out.exr", "nowhere", "create it"},
    {"merge {in}/left.part {in}/right.part -o out.exr --view loud", "--view", "filmic"},
    {"merge {in}/left.part {in}/right.part -o out.exr --exposure nan", "--exposure", "number of stops"},
    {"merge -o out.exr", "parts", "--help"},
};
INSTANTIATE_TEST_SUITE_P(Films, BadInputs, testing::ValuesIn(kFilms));

} // namespace
} // namespace tyndall::test
