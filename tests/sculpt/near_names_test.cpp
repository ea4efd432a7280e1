#include "sculpt/near_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace argil::sculpt {
namespace {

TEST(NearNames, DistanceCountsEditsAndSwaps) {
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("densiyt", "density"), 1U);
  EXPECT_EQ(edit_distance("same", "same"), 0U);
}

TEST(NearNames, OffersTheNearestFirstAndNothingFar) {
  const std::vector<std::string> names = {"young_modulus", "density", "mask", "damping", "x"};
  EXPECT_THAT(near_names("densitty", names), testing::ElementsAre("density"));
  EXPECT_THAT(near_names("youngs_modulus", names), testing::ElementsAre("young_modulus"));
  EXPECT_TRUE(near_names("chair", names).empty());
  EXPECT_EQ(near_names_hint("mesk", names), "; did you mean `mask`?");
  EXPECT_EQ(near_names_hint(std::string(60000, 'a'), names), "");
}

}  // namespace
}  // namespace argil::sculpt
