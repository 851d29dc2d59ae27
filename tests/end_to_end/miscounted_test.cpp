// Counters that cannot be right are seen, whatever the lists are.
#include <gtest/gtest.h>

#include <cmath>

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

// Four pixels across, the third is sky; cells end at 10 m, with 7 lights before and 3 after, in the second
// row one more.
TEST(Miscounted, WhatIsListedIsWhatTheListHolds) {
  const ListLength list = [](glm::uvec2 pixel, float depth) -> std::optional<uint32_t> {
    return (depth < 10 ? 7u : 3u) + pixel.y;
  };
  const ViewDepths depths{{5, 20, 0, std::nextafter(10.0f, 0.0f), 5, 20, 0, 10}, 4};
  PixelCounts counts;
  counts.listed = {7, 3, 0, 7, 8, 4, 0, 4};
  EXPECT_EQ(mislisted(counts, depths, list), "");
  // On the boundary either is right.
  counts.listed[3] = 3;
  counts.listed[7] = 8;
  EXPECT_EQ(mislisted(counts, depths, list), "");
  for (size_t pixel : {0, 1, 3, 4, 5, 7}) {
    PixelCounts doctored = counts;
    ++doctored.listed[pixel];
    const std::string said = mislisted(doctored, depths, list);
    EXPECT_NE(said.find("1 of 6 pixels"), std::string::npos) << said;
    EXPECT_EQ(mislisted(doctored, depths, [](glm::uvec2, float) { return std::optional<uint32_t>(); }), "");
  }
}

}  // namespace
}  // namespace ml
