// The global sort: ascending keys, stable, whatever the depths and however the lights are cut into runs.
#include "algorithms/froxels/depth_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "harness/base/random.h"

namespace ml {
namespace {

gpu_data::ViewData view_between(float near, float far) {
  gpu_data::ViewData view{};
  view.near = near;
  view.far = far;
  return view;
}

float random_depth(Random& random) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float odd[] = {0, -0.0f, -1, 1e-40f, 1e30f, infinity, -infinity, -1e-30f};
  if (random.below(20) == 0) return odd[random.below(8)];
  return 1e-3f * std::pow(1e8f, random.uniform()) * (random.below(10) == 0 ? -1.0f : 1.0f);
}

TEST(DepthKey, AscendsWithDepthInFineSteps) {
  Random random(1);
  for (auto [near, far] :
       {std::pair(0.1f, 1000.0f), {0.01f, 1e7f}, {1.0f, 1.0f}, {0.0f, 100.0f}, {5.0f, 1.0f}}) {
    const DepthKey key(view_between(near, far));
    for (int i = 0; i < 20000; ++i) {
      float a = random_depth(random), b = random_depth(random);
      if (a > b) std::swap(a, b);
      ASSERT_LE(key(a), key(b)) << a << " " << b;
      ASSERT_LE(key(b), DepthKey::max);
      // As fine up to an octave beyond the far depth.
      const bool inside = near > 0 && a >= near && b <= 2 * std::max(near, far) && far / near < 0x1p29f;
      if (inside && b > a * 1.001f) {
        ASSERT_LT(key(a), key(b)) << a << " " << b;
      }
    }
  }
}

TEST(DepthOrder, IsAStableSortForAnyRuns) {
  DepthOrder order;  // reused, as from frame to frame
  for (uint32_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const DepthKey key(view_between(0.1f, 500));
    const size_t count = 1 + random.below(seed % 10 == 0 ? 70000 : 500);
    std::vector<float> z(count);
    for (float& depth : z) depth = random_depth(random);
    // Runs with gaps between them.
    std::vector<IndexRun> runs;
    std::vector<uint32_t> expected;
    for (size_t first = random.below(3); first < count || runs.empty(); first += 1 + random.below(50)) {
      size_t length = first < count ? std::min<size_t>(random.below(30000), count - first) : 0;
      runs.push_back({first, length});
      for (size_t i = first; i < first + length; ++i) expected.push_back(static_cast<uint32_t>(i));
      first += length;
    }
    std::stable_sort(expected.begin(), expected.end(),
                     [&](uint32_t a, uint32_t b) { return key(z[a]) < key(z[b]); });
    for (unsigned threads : {1u, 3u}) {
      Threads pool(threads);
      order.sort(z.data(), runs, key, pool);
      ASSERT_TRUE(std::ranges::equal(order.indices(), expected)) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace ml
