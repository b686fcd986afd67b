// SPDX-License-Identifier: Apache-2.0
// Damaged files: reading ends, and either succeeds or says where it went wrong.
#include "scene/support.h"

#include <gtest/gtest.h>

#include <random>

namespace tyndall::scene {
namespace {

using test::everything;

/// Sound, or a problem at a place inside the text.
void expectSoundOrLocated(const std::string& text) {
  const LoadResult result = test::parse(text);
  const int lines = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  for (const Problem& problem : result.problems) {
    ASSERT_FALSE(problem.message.empty());
    ASSERT_EQ(problem.location.file, "test.json");
    ASSERT_GE(problem.location.line, 1) << problem.message;
    ASSERT_LE(problem.location.line, lines) << problem.message;
    ASSERT_GE(problem.location.column, 1) << problem.message;
  }
  ASSERT_EQ(result.ok(), !result.canonical.empty());
}

TEST(SceneDamage, EveryPrefixIsReported) {
  const std::string text = everything().substr(0, everything().rfind('}') + 1);
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string prefix = text.substr(0, length);
    ASSERT_NO_FATAL_FAILURE(expectSoundOrLocated(prefix)) << prefix;
    ASSERT_FALSE(test::parse(prefix).ok()) << prefix;
  }
  EXPECT_TRUE(test::parse(text).ok());
}

TEST(SceneDamage, FlippedBitsAndMovedBytesNeverCrash) {
  std::mt19937 random(7);
  const std::string structure = "{}[]\",:/*\\'-+.eE0123456789 \n\r\t\xff\xc3";
  for (int round = 0; round < 3000; ++round) {
    std::string text = everything();
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int change = 0; change < changes; ++change) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1u << (random() % 8)));
        break;
      case 1:
        text[at] = structure[random() % structure.size()];
        break;
      case 2:
        text.erase(at, 1 + random() % 8);
        break;
      default:
        text.insert(at, text.substr(random() % text.size(), random() % 32));
        break;
      }
    }
    ASSERT_NO_FATAL_FAILURE(expectSoundOrLocated(text)) << text;
  }
}

TEST(SceneDamage, EveryValueOfEveryWrongKindIsReported) {
  // Each number, text, list and object of the scene replaced by something else: never a crash, never silence about
  // a key that cannot hold it.
  const std::vector<std::string> replacements{"null", "true", "-1e300", "\"\"", "[]", "{}", "[[[]]]", "{\"type\": 5}"};
  const std::vector<std::string> paths{"camera",
                                       "camera.type",
                                       "camera.position",
                                       "camera.vertical_fov",
                                       "film",
                                       "film.size",
                                       "film.view",
                                       "render",
                                       "render.samples",
                                       "media",
                                       "media.0",
                                       "media.0.type",
                                       "media.0.transform",
                                       "media.0.transform.0",
                                       "media.0.transform.0.rotate",
                                       "media.0.transform.0.rotate.axis",
                                       "media.0.albedo",
                                       "media.0.phase",
                                       "media.0.phase.g1",
                                       "media.0.file",
                                       "media.0.storage",
                                       "media.2.shape",
                                       "media.2.shape.min",
                                       "media.2.extinction",
                                       "lights",
                                       "lights.0",
                                       "lights.0.position",
                                       "lights.1.direction",
                                       "lights.1.visible",
                                       "lights.4.turbidity",
                                       "lights.5.inner_angle",
                                       "camera.lens_radius",
                                       "render.depth",
                                       "media.0.instances.1.0",
                                       "media.0.extinction_colour",
                                       "materials.0",
                                       "materials.1.type",
                                       "materials.1.emission",
                                       "materials.1.two_sided",
                                       "objects.0",
                                       "objects.0.file",
                                       "objects.0.instances",
                                       "objects.1.edge_u",
                                       "objects.1.material",
                                       "objects.2.medium",
                                       "objects.2.priority",
                                       "objects.3.radius"};
  for (const std::string& path : paths) {
    int refused = 0;
    for (const std::string& replacement : replacements) {
      refused += test::parse(everything(), {{path, replacement}}).ok() ? 0 : 1;
    }
    // An object or list may be empty, a flag may be true: at most two of the eight are right anywhere.
    EXPECT_GE(refused, 6) << path;
  }
}

} // namespace
} // namespace tyndall::scene
