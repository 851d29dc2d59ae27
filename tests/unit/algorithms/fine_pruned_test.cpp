// The CPU's part of fine_pruned: the packed list, and the order of the visible lights.
#include <gtest/gtest.h>

#include "algorithms/fine_pruned/pruned_lists.h"

namespace ml {
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

}  // namespace
}  // namespace ml
