#include <gmock/gmock.h>

#include "io/image.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

void write_grey(const TestSession& session, const std::string& name, int width, int height, std::uint8_t grey) {
  io::write_png(session.folder().path() / name, width, height,
                std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width * height), grey));
}

class NoRenderer final : public Renderer {
 public:
  Picture render(const Scene&, const PictureOptions&) override { return {}; }
};

struct Drawing {
  NoRenderer renderer;
  TestSession session{{"new box 2 1 1"}, with(renderer)};
  static SessionOptions with(Renderer& renderer) {
    SessionOptions options;
    options.renderer = &renderer;
    return options;
  }
};

TEST(Panels, StandRowByRowInTheMiddleOfEqualPlaces) {
  Drawing drawing;
  write_grey(drawing.session, "a.png", 4, 3, 50);
  write_grey(drawing.session, "b.png", 2, 3, 100);
  write_grey(drawing.session, "c.png", 4, 1, 150);
  drawing.session.run({"panels all.png \"a.png b.png c.png\" columns 2 gap 1 light"});
  const io::Image sheet = io::read_png(drawing.session.folder().path() / "all.png");
  ASSERT_EQ(sheet.width, 4 + 1 + 4);
  ASSERT_EQ(sheet.height, 3 + 1 + 3);
  std::string seen;
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = 0; x < sheet.width; ++x) {
      const int grey = sheet.rgba[4 * static_cast<std::size_t>(y * sheet.width + x)];
      seen += grey == 50 ? 'a' : grey == 100 ? 'b' : grey == 150 ? 'c' : grey == 255 ? '.' : '?';
    }
    seen += '\n';
  }
  EXPECT_EQ(seen,
            "aaaa..bb.\n"
            "aaaa..bb.\n"
            "aaaa..bb.\n"
            ".........\n"
            ".........\n"
            "cccc.....\n"
            ".........\n");
}

TEST(Panels, RefuseWhatIsNotThereOrElsewhereOrTooLarge) {
  Drawing drawing;
  TestSession& session = drawing.session;
  write_grey(session, "a.png", 4, 3, 50);
  write_grey(session, "large.png", 4000, 4000, 50);
  EXPECT_THAT(session.fault_of("panels all.png \"a.png none.png\"").what(), HasSubstr("no picture 'none.png'"));
  EXPECT_THAT(session.fault_of("panels all.jpg \"a.png\"").what(), HasSubstr("all.jpg"));
  EXPECT_THAT(session.fault_of("panels all.png \"../a.png\"").what(), HasSubstr("climbs out"));
  EXPECT_THAT(session.fault_of("panels all.png \" \"").what(), HasSubstr("found 0"));
  EXPECT_THAT(session.fault_of("panels all.png \"large.png large.png large.png large.png large.png\"").what(),
              HasSubstr("smaller"));
  EXPECT_THAT(session.fault_of("panels all.png \"large.png a.png a.png a.png a.png\" columns 1").what(),
              HasSubstr("smaller"));
  EXPECT_FALSE(std::filesystem::exists(session.folder().path() / "all.png"));
}

TEST(Panels, AreSkippedWhereThereIsNoRenderer) {
  TestSession session({"new box 2 1 1", "panels all.png \"a.png\""});
  EXPECT_EQ(session->skipped_pictures, 1);
}

}  // namespace
}  // namespace argil::sculpt
