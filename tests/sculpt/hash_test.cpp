#include "sculpt/hash.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace argil::sculpt {
namespace {

TEST(Hash, IsFnv1aOfTheLittleEndianBytes) {
  // Published FNV-1a vectors: the empty input, and "a" = byte 0x61. A count goes before text, so it is undone by
  // feeding the byte alone as a span and comparing with the definition.
  EXPECT_EQ(Hash().value(), 0xcbf29ce484222325ULL);
  std::uint64_t expected = 0xcbf29ce484222325ULL;
  for (const std::uint8_t byte : {0x61, 0, 0, 0, 0, 0, 0, 0x80}) expected = (expected ^ byte) * 0x100000001b3ULL;
  EXPECT_EQ(Hash().add(std::uint64_t{0x8000000000000061ULL}).value(), expected);
  EXPECT_EQ((0xcbf29ce484222325ULL ^ 0x61U) * 0x100000001b3ULL, 0xaf63dc4c8601ec8cULL);
}

TEST(Hash, ZeroHasOneSignAndNanOneForm) {
  EXPECT_EQ(Hash().add(-0.0).value(), Hash().add(0.0).value());
  EXPECT_EQ(Hash().add(std::nan("1")).value(), Hash().add(-std::numeric_limits<double>::quiet_NaN()).value());
  EXPECT_NE(Hash().add(1.0).value(), Hash().add(std::nextafter(1.0, 2.0)).value());
  EXPECT_NE(Hash().add(1.0).value(), Hash().add(-1.0).value());
}

TEST(Hash, StreamsAndKeepsPiecesApart) {
  const std::array<double, 3> values = {1, -0.0, 3};
  Hash one_by_one;
  one_by_one.add(std::uint64_t{3}).add(1.0).add(0.0).add(3.0);
  EXPECT_EQ(Hash().add(std::span<const double>(values)).value(), one_by_one.value());
  EXPECT_NE(Hash().add("ab").add("c").value(), Hash().add("a").add("bc").value());
  const std::vector<std::uint32_t> ids = {1, 2};
  const std::vector<std::uint32_t> swapped = {2, 1};
  EXPECT_NE(Hash().add(ids).value(), Hash().add(swapped).value());
}

}  // namespace
}  // namespace argil::sculpt
