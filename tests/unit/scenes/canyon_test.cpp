#include <gtest/gtest.h>

#include "harness/lights/set.h"
#include "scenes/scene_registry.h"

namespace ml {
namespace {

TEST(Canyon, ForeignPlacementsGetASizeOfTheirOwn) {
  const Scene canyon = make_scene("canyon");
  for (Placement placement : {Placement::area, Placement::triangle}) {
    LightSpec spec;
    spec.placement = placement;
    LightSet set(spec, canyon);
    EXPECT_EQ(set.base().size(), 8192u);
    EXPECT_GT(set.base_size(), 0.1f);
    EXPECT_LT(set.base_size(), 10);
  }
}

}  // namespace
}  // namespace ml
