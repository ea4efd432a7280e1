#include "tools/studio/sample_pace.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace argil::studio {
namespace {

TEST(SamplePace, KeepsItsSamplesWhileFramesComeInTime) {
  SamplePace pace;
  for (int i = 0; i < 1000; ++i) pace.frame(1.0 / 60, true);
  EXPECT_EQ(pace.samples(), 4);
}

TEST(SamplePace, TakesAsFewAsSlowFramesAskForAndIgnoresTheFirst) {
  SamplePace pace;
  pace.frame(0.16, true);  // of a frame that was not drawn anew
  pace.frame(0.16, true);
  EXPECT_EQ(pace.samples(), 4);
  pace.frame(0.16, true);
  EXPECT_EQ(pace.samples(), 1);
}

TEST(SamplePace, DoesNotCareForSlowFramesInWhichNothingMoved) {
  SamplePace pace;
  for (int i = 0; i < 100; ++i) pace.frame(0.2, false);
  EXPECT_EQ(pace.samples(), 4);
}

TEST(SamplePace, ComesBackOnceFramesAreQuick) {
  SamplePace pace;
  for (int i = 0; i < 3; ++i) pace.frame(0.2, true);
  ASSERT_EQ(pace.samples(), 1);
  for (int i = 0; i < 2000; ++i) pace.frame(1.0 / 60, true);
  EXPECT_EQ(pace.samples(), 4);
}

TEST(SamplePace, TriesTooMuchEverMoreSeldom) {
  // A machine that draws a sample in 14 ms: one fits, two do not.
  SamplePace pace;
  int slow = 0;
  double took = 0.014;
  for (int i = 0; i < 20'000; ++i) {
    pace.frame(took, true);
    took = std::max(1.0 / 60, 0.014 * pace.samples());
    if (took > 1.0 / 40) ++slow;
  }
  EXPECT_EQ(pace.samples(), 1);
  EXPECT_LT(slow, 40);  // in more than five minutes
}

}  // namespace
}  // namespace argil::studio
