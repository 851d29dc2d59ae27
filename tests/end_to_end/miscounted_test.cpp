// Counters that cannot be right are seen, whatever the lists are.
#include <gtest/gtest.h>

#include "harness/bench/counting.h"

namespace ml {
namespace {

// Three pixels, the last one of sky; two of five lights contribute to the first, none to the second.
struct Frame {
  PixelCounts counts;
  ContributingLights truth{{2, 0, 0}, {77, 0, 0}};
  std::vector<uint8_t> lit{1, 1, 0};

  explicit Frame(uint32_t listed) {
    counts.listed = counts.tested = {listed, listed, 0};
    counts.contributing = {2, 0, 0};
  }
  std::string said(const AlgorithmInfo& info, LightLists walk = LightLists::none) const {
    return miscounted(info, counts, truth, lit, 5, walk);
  }
};

TEST(Miscounted, TheReferenceTestsEveryLightOfEverySurface) {
  AlgorithmInfo reference;
  reference.reference_only = true;
  EXPECT_EQ(Frame(5).said(reference), "");
  for (size_t pixel : {size_t{0}, size_t{1}}) {
    Frame shorter(5);
    shorter.counts.tested[pixel] = 4;
    EXPECT_NE(shorter.said(reference).find("1 of 2 pixels"), std::string::npos) << shorter.said(reference);
  }
  Frame sky(5);
  sky.counts.tested[2] = 5;
  EXPECT_NE(sky.said(reference), "");
}

TEST(Miscounted, IdealListsWhatContributes) {
  AlgorithmInfo ideal;
  ideal.needs_contributing_lists = true;
  Frame right(0);
  right.counts.listed[0] = right.counts.tested[0] = 2;
  EXPECT_EQ(right.said(ideal), "");
  right.counts.listed[1] = 1;
  EXPECT_NE(right.said(ideal), "");
}

// Two lights contribute to the first pixel, another one to the second, and they are in one group.
TEST(Miscounted, IdealTogetherListsWhatContributesToTheGroup) {
  AlgorithmInfo ideal;
  ideal.needs_contributing_lists = true;
  Frame right(3);
  right.truth.count[1] = 1;
  right.truth.group = {3, 3, 0};
  right.counts.contributing[1] = 1;
  EXPECT_EQ(right.said(ideal, LightLists::groups), "");
  EXPECT_NE(right.said(ideal, LightLists::pixels), "");
  Frame forward = right;
  forward.counts.listed[1] = forward.counts.tested[1] = 1;
  EXPECT_EQ(forward.said(ideal, LightLists::groups), "") << "what is lit forward walks alone";
  for (uint32_t wrong : {0u, 2u, 4u}) {
    Frame doctored = right;
    doctored.counts.listed[1] = wrong;
    EXPECT_NE(doctored.said(ideal, LightLists::groups), "");
    doctored.counts.tested[1] = wrong;
    EXPECT_NE(doctored.said(ideal, LightLists::groups), "");
  }
}

TEST(Miscounted, NobodyEvaluatesWhatHeHasNotListed) {
  const AlgorithmInfo any;
  EXPECT_EQ(Frame(2).said(any), "");
  EXPECT_EQ(Frame(5).said(any), "");
  EXPECT_NE(Frame(1).said(any), "") << "two lights are evaluated";
  EXPECT_NE(Frame(6).said(any), "") << "there are five";
}

}  // namespace
}  // namespace ml
