// The CPU's part of fine_pruned: the packed list, and the order of the visible lights.
#include <gtest/gtest.h>

#include <algorithm>

#include "algorithms/fine_pruned/visible_lights.h"
#include "tests/unit/algorithms/binning_cases.h"

namespace ml::test {
namespace {

TEST(FinePruned, PackedWordsGiveBackWhatTheyWereMadeOf) {
  const uint32_t values[] = {0, 1, 2, 511, 512, 682, 341, 1022, 1023};
  for (uint32_t a : values)
    for (uint32_t b : values)
      for (uint32_t c : values)
        for (uint32_t count = 0; count <= 3; ++count) {
          const uint32_t word = gpu_data::packed_word(a, b, c, count);
          ASSERT_EQ(gpu_data::packed_count(word), count);
          ASSERT_EQ(gpu_data::packed_index(word, 0), a);
          ASSERT_EQ(gpu_data::packed_index(word, 1), b);
          ASSERT_EQ(gpu_data::packed_index(word, 2), c);
        }
}

TEST(FinePruned, AListTakesThirtyTwoBytesATile) {
  EXPECT_EQ(ML_PACKED_WORDS * sizeof(uint32_t), 32u);
  EXPECT_EQ(ML_PACKED_WORDS * 3, ML_PACKED_LIGHTS);
  EXPECT_EQ(ML_PACKED_VISIBLE, 1u << 10);
  EXPECT_EQ(ML_PACKED_WORDS * 32, ML_PRUNED_TILE * ML_PRUNED_TILE) << "one bit a pixel";
}

// Balls, cones, boxes; then those of probe lights.
int type_of(const Light& light) {
  const int first = light.probe ? 3 : 0;
  if (light.shape == LightShape::box) return first + 2;
  return first + (has_cone(light.shape) ? 1 : 0);
}

TEST(FinePruned, VisibleLightsAreSortedByTypeAndLeftInOrder) {
  uint32_t seen = 0;
  for (uint32_t number = 0; number < 60; ++number) {
    Random random(hash_u32(7, number));
    const Camera camera = random_camera(random);
    std::vector<Light> lights = random_lights(random, number * 9, camera);
    // Frames of all shapes, and frames that lack some.
    const uint32_t shapes = 1 + number % 5, first_shape = random.below(6 - shapes);
    for (Light& light : lights) {
      light.shape = static_cast<LightShape>(first_shape + random.below(shapes));
      light.direction = {0, -1, 0};
      light.side = {1, 0, 0};
      if (has_segment(light.shape)) light.half_length = light.radius;
      light.probe = number % 3 > 0 && random.below(3) < number % 3;
      if (light.shape == LightShape::box) make_box(light, glm::vec3(light.radius));
    }
    BinningFrame frame(lights, camera, 100, 60);
    Spans spans;
    VisibleLightList list;
    list.cull(frame.frame, spans);
    VisibleLights visible;
    const BoundsConstants constants(frame.frame.view, FroxelGrid::make(frame.frame.view, 16, 1, 5, 0));
    visible.reserve(lights.size());
    visible.count = scalar::cull(frame.frame.lights, 0, lights.size(), constants, visible);
    std::vector<uint32_t> expected(visible.index.begin(),
                                   visible.index.begin() + static_cast<ptrdiff_t>(visible.count));
    std::stable_sort(expected.begin(), expected.end(),
                     [&](uint32_t a, uint32_t b) { return type_of(lights[a]) < type_of(lights[b]); });
    ASSERT_EQ(list.in_frustum(), expected.size());
    for (uint32_t max_lights : {1000000u, 40u, 1u}) {
      list.sort(frame.frame, max_lights, spans);
      const auto kept = list.lights();
      ASSERT_EQ(kept.size(), std::min<size_t>(max_lights, expected.size()));
      ASSERT_TRUE(std::equal(kept.begin(), kept.end(), expected.begin()));
      const gpu_data::VisibleHeader& header = list.header();
      ASSERT_LE(header.first_cone, header.first_box);
      ASSERT_LE(header.first_box, header.first_probe);
      ASSERT_LE(header.first_probe, header.first_probe_cone);
      ASSERT_LE(header.first_probe_cone, header.first_probe_box);
      ASSERT_LE(header.first_probe_box, header.count);
      for (uint32_t i = 0; i < header.count; ++i)
        ASSERT_EQ(type_of(lights[kept[i]]), (i >= header.first_cone) + (i >= header.first_box) +
                                                (i >= header.first_probe) + (i >= header.first_probe_cone) +
                                                (i >= header.first_probe_box));
      seen += header.count;
    }
  }
  EXPECT_GT(seen, 5000u);
}

}  // namespace
}  // namespace ml::test
