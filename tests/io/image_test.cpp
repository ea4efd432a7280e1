#include "io/image.h"

#include <gtest/gtest.h>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tests/io/scratch.h"

namespace argil::io {
namespace {

using test::scratch;

TEST(Image, ComesBackExactlyWithTheTopRowFirst) {
  std::vector<std::uint8_t> rgba;
  for (unsigned i = 0; i < 4U * 5 * 3; ++i) rgba.push_back(static_cast<std::uint8_t>(i * 37));
  write_png(scratch("p.png"), 5, 3, rgba);
  const Image image = read_png(scratch("p.png"));
  EXPECT_EQ(image.width, 5);
  EXPECT_EQ(image.height, 3);
  EXPECT_EQ(image.rgba, rgba);
}

TEST(Image, DamagedPicturesAreRefused) {
  write_png(scratch("q.png"), 8, 8, std::vector<std::uint8_t>(256, 7));
  const std::string whole = read_file(scratch("q.png"));
  write_file(scratch("cut.png"), whole.substr(0, whole.size() / 2));
  EXPECT_THROW((void)read_png(scratch("cut.png")), Error);
  write_file(scratch("text.png"), "not a picture");
  EXPECT_THROW((void)read_png(scratch("text.png")), Error);
  // 32768 × 32768 pixels in a file of a hundred bytes.
  std::string bomb = whole;
  bomb[17] = bomb[21] = 0;
  bomb[18] = bomb[22] = static_cast<char>(0x80);
  bomb[19] = bomb[23] = 0;
  write_file(scratch("bomb.png"), bomb);
  EXPECT_THROW((void)read_png(scratch("bomb.png")), Error);
  EXPECT_THROW((void)read_png(scratch("none.png")), Error);
  // A part that counts a gigabyte.
  std::string boast = whole;
  boast[33] = 0x3f;
  try {
    (void)read_png(boast, "boast");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "boast: byte 33");
  }
}

}  // namespace
}  // namespace argil::io
