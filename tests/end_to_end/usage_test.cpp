#include <gtest/gtest.h>
TEST(Usage, Placeholder) {}
