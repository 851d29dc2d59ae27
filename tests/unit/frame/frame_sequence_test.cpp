// How the frames of a sequence follow on each other, and from which view.
#include <gtest/gtest.h>

#include "harness/frame/frame_input.h"
#include "tests/support/light_test_level.h"

namespace ml {
namespace {

CameraPath along_x() {
  CameraPath path;
  path.keys = {{0, {0, 5, 30}, {0, 5, 0}}, {1, {8, 5, 30}, {8, 5, 0}}};
  return path;
}

TEST(FrameSequence, SaysHowEachFrameFollowsOnTheOneBefore) {
  const LightSet lights(spec_of(5), level());
  const CameraPath path = along_x();
  Threads threads(1);
  FrameSequence frames(level(), lights, path, 6, 16, 9, threads);
  const std::pair<uint32_t, Step> asked[] = {{0, Step::first}, {1, Step::next},  {1, Step::same},
                                             {2, Step::next},  {4, Step::first}, {5, Step::next},
                                             {0, Step::first}, {0, Step::same},  {1, Step::next}};
  glm::vec3 before(0), camera(0);  // of the frame before, and of this one
  for (const auto& [index, step] : asked) {
    SCOPED_TRACE(index);
    const FrameInput& input = frames.at(index);
    EXPECT_EQ(input.index, index);
    EXPECT_EQ(input.step, step);
    if (step == Step::next) before = camera;
    if (step == Step::first) before = input.view.camera;
    camera = input.view.camera;
    EXPECT_EQ(input.previous_view.camera, before);
  }
}

}  // namespace
}  // namespace ml
