// SPDX-License-Identifier: Apache-2.0
#include "film/merge.h"

#include "film_fixture.h"

namespace tyndall::film {
namespace {

const glm::uvec2 kSize(24, 18);
const Window kWhole{{0, 0}, kSize};

/// Batches [first, end) of `seed` over `window`, with provenance.
Film part(const Window& window, std::uint32_t seed, std::uint32_t first, std::uint32_t end) {
  Film film = pseudoFilm(kSize, window, seed, {first, end});
  setProvenance(film, {"feed", "a device", seed, first * kBatchSamples, end * kBatchSamples});
  film.metadata["count.nonFinite"] = "2";
  return film;
}

TEST(Merge, CropsOfOneRenderAreTheWholeBitForBit) {
  const Film whole = part(kWhole, 1, 0, 3);
  const Film merged = merge({{"c", part({{10, 7}, {24, 18}}, 1, 0, 3)},
                             {"a", part({{0, 0}, {24, 7}}, 1, 0, 3)},
                             {"b", part({{0, 7}, {10, 18}}, 1, 0, 3)}});
  expectSameBits(merged, whole);
  EXPECT_EQ(merged.metadata.at(kSeedKey), "1");
  EXPECT_EQ(merged.metadata.at("count.nonFinite"), "6");
  EXPECT_FALSE(merged.metadata.contains(kPartsKey));
}

TEST(Merge, TheOrderOfThePartsHasNoSay) {
  const std::pair<std::string, Film> a{"a", part(kWhole, 1, 0, 3)};
  const std::pair<std::string, Film> b{"b", part(kWhole, 2, 0, 5)};
  const std::pair<std::string, Film> c{"c", part({{4, 4}, {9, 9}}, 3, 0, 2)};
  const Film first = merge({a, b, c});
  const Film second = merge({c, b, a});
  expectSameBits(first, second);
  EXPECT_EQ(first.metadata, second.metadata);
}

TEST(Merge, SeedsPoolTheirSamples) {
  const Film a = part(kWhole, 1, 0, 3);
  const Film b = part(kWhole, 2, 0, 5);
  const Film merged = merge({{"a", a}, {"b", b}});
  EXPECT_EQ(merged.samples(7), 128u);
  EXPECT_NEAR(merged.mean(7, G), (48.0 * a.mean(7, G) + 80.0 * b.mean(7, G)) / 128.0, 1e-15);
  EXPECT_EQ(merged.metadata.at(kSeedKey), "1; 2");
}

TEST(Merge, SampleRangesContinueEachOther) {
  const Film merged = merge({{"late", part(kWhole, 1, 3, 7)}, {"early", part(kWhole, 1, 0, 3)}});
  const Film whole = part(kWhole, 1, 0, 7);
  for (std::size_t i = 0; i < whole.pixels().size(); ++i) {
    EXPECT_EQ(merged.pixels()[i].batches, whole.pixels()[i].batches);
    EXPECT_NEAR(merged.mean(i, R), whole.mean(i, R), 1e-14);  // sums of the same numbers in another order
    EXPECT_NEAR(merged.varianceOfMean(i, R), whole.varianceOfMean(i, R), 1e-14);
  }
}

TEST(Merge, TheSameSamplesTwiceAreRefused) {
  const std::string message =
      errorOf([] { merge({{"a.exr", part(kWhole, 1, 0, 4)}, {"b.exr", part({{3, 3}, {4, 4}}, 1, 3, 5)}}); });
  EXPECT_NE(message.find("a.exr and b.exr"), std::string::npos) << message;
  EXPECT_NE(message.find("seed 1, from 48"), std::string::npos) << message;
}

TEST(Merge, AMergedFilmRemembersItsParts) {
  const Film merged = merge({{"a", part(kWhole, 1, 0, 3)}, {"b", part(kWhole, 2, 0, 3)}});
  EXPECT_NE(errorOf([&] { merge({{"m", merged}, {"b", part(kWhole, 2, 2, 3)}}); }).find("same samples"),
            std::string::npos);
  EXPECT_EQ(merge({{"m", merged}, {"c", part(kWhole, 3, 0, 3)}}).samples(0), 144u);
}

TEST(Merge, DifferentScenesAreRefusedByName) {
  Film other = part(kWhole, 2, 0, 3);
  other.metadata[kSceneHashKey] = "beef";
  const std::string message = errorOf([&] { merge({{"a.exr", part(kWhole, 1, 0, 3)}, {"b.exr", other}}); });
  EXPECT_NE(message.find("feed"), std::string::npos) << message;
  EXPECT_NE(message.find("beef"), std::string::npos) << message;
}

TEST(Merge, DifferentPictureSizesAreRefused) {
  Film other({9, 9}, {{0, 0}, {9, 9}});
  setProvenance(other, {"feed", "a device", 2, 0, 16});
  EXPECT_NE(errorOf([&] { merge({{"a", part(kWhole, 1, 0, 3)}, {"b", other}}); }).find("9x9"), std::string::npos);
}

TEST(Merge, HolesAreNamed) {
  const std::string message = errorOf([] {
    merge({{"a", part({{2, 2}, {10, 6}}, 1, 0, 1)}, {"b", part({{10, 2}, {12, 4}}, 1, 0, 1)}});
  });
  EXPECT_NE(message.find("rows 4 to 5 (columns 10 to 11)"), std::string::npos) << message;
  const std::string middle = errorOf([] {
    merge({{"a", part({{0, 0}, {24, 3}}, 1, 0, 1)}, {"b", part({{0, 5}, {24, 8}}, 1, 0, 1)}});
  });
  EXPECT_NE(middle.find("rows 3 to 4 (columns 0 to 23)"), std::string::npos) << middle;
}

TEST(Merge, ASmallerRectangleIsFine) {
  const Film merged = merge({{"a", part({{2, 2}, {10, 6}}, 1, 0, 1)}, {"b", part({{10, 2}, {12, 6}}, 1, 0, 1)}});
  EXPECT_EQ(merged.window(), (Window{{2, 2}, {12, 6}}));
}

TEST(Merge, MissingOrDamagedProvenanceIsNamed) {
  Film film = part(kWhole, 1, 0, 3);
  film.metadata.erase(kSeedKey);
  EXPECT_NE(errorOf([&] { merge({{"a.exr", film}}); }).find("\"seed\""), std::string::npos);
  film.metadata[kSeedKey] = "one";
  EXPECT_NE(errorOf([&] { merge({{"a.exr", film}}); }).find("not a whole number"), std::string::npos);
  film.metadata[kPartsKey] = "1 2";
  EXPECT_NE(errorOf([&] { merge({{"a.exr", film}}); }).find("cannot be read"), std::string::npos);
  EXPECT_THROW(merge({}), Error);
}

} // namespace
} // namespace tyndall::film
