// Films: through ffmpeg where it is, refused with a remedy where it is not; numbered pictures always.

#include "tools/view/film.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <sstream>

#include "io/image.h"
#include "subdiv/error.h"
#include "tests/tools/process.h"

namespace argil::view {
namespace {

using testing::HasSubstr;
using tests::TemporaryFolder;

/// A grey square that goes right by 8 pixels a picture.
sculpt::Picture picture(int number, int width = 96, int height = 64) {
  sculpt::Picture result{.width = width, .height = height, .rgba = {}, .cell_ids = {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool inside = y >= 16 && y < 48 && x >= 8 * number && x < 8 * number + 32;
      for (int channel = 0; channel < 4; ++channel) result.rgba.push_back(channel == 3 || inside ? 255 : 20);
    }
  return result;
}

std::string fault_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Films, AreNumberedPicturesWithoutAnyProgram) {
  const TemporaryFolder folder;
  FilmWriter film(folder / "walk.png", {.rate = 10, .program = "no such program"});
  for (int i = 0; i < 3; ++i) film.add(picture(i));
  film.finish();
  EXPECT_THAT(folder.files(), testing::ElementsAre("walk_0000.png", "walk_0001.png", "walk_0002.png"));
  EXPECT_EQ(io::read_png(folder / "walk_0002.png").rgba, picture(2).rgba);
}

// Numbered pictures as well are there all together or not at all; those of an earlier film stay until then.
TEST(Films, LeaveTheFolderAsItWasWherePicturesAreNotFinished) {
  const TemporaryFolder folder;
  {
    FilmWriter film(folder / "walk.png");
    for (int i = 0; i < 3; ++i) film.add(picture(i));
    film.finish();
  }
  const std::string before = tests::read_bytes(folder / "walk_0001.png");
  {
    FilmWriter film(folder / "walk.png");
    for (int i = 0; i < 5; ++i) film.add(picture(i + 3));
  }
  EXPECT_THAT(folder.files(), testing::ElementsAre("walk_0000.png", "walk_0001.png", "walk_0002.png"));
  EXPECT_EQ(tests::read_bytes(folder / "walk_0001.png"), before);
}

TEST(Films, AreRefusedWithARemedy) {
  const TemporaryFolder folder;
  const FilmOptions without{.rate = 10, .program = "no such program"};
  EXPECT_FALSE(can_write_films(without));
  EXPECT_THAT(fault_of([&] { FilmWriter(folder / "walk.mp4", without); }), HasSubstr("apt-get install ffmpeg"));
  EXPECT_THAT(fault_of([&] { FilmWriter(folder / "walk.avi"); }), HasSubstr(".mp4, .gif or .png"));
  EXPECT_THAT(fault_of([&] { FilmWriter(folder / "walk.png").finish(); }), HasSubstr("at least one picture"));
  EXPECT_TRUE(folder.files().empty());
}

// What stands in for ffmpeg ends at once, so that the pipe has no reader: an error, not the end of this program.
TEST(Films, SayWhatTheProgramSaidThatGaveUp) {
  const TemporaryFolder folder;
  const auto script = folder.write("false ffmpeg", "#!/bin/sh\necho out of paint >&2\nexit 7\n");
  std::filesystem::permissions(script, std::filesystem::perms::owner_all);
  const std::string fault = fault_of([&] {
    FilmWriter film(folder / "walk.mp4", {.rate = 10, .program = script.string()});
    for (int i = 0; i < 100; ++i) film.add(picture(i % 8, 640, 480));
    film.finish();
  });
  EXPECT_THAT(fault, HasSubstr("ended with status 7: out of paint"));
  EXPECT_THAT(folder.files(), testing::ElementsAre("false ffmpeg"));
}

class WithFfmpeg : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!can_write_films()) GTEST_SKIP() << "there is no ffmpeg here";
  }
};

TEST_P(WithFfmpeg, AreWhatTheirPicturesWere) {
  const TemporaryFolder folder;
  const std::string name = std::string("walk.") + GetParam();
  {
    FilmWriter film(folder / name, {.rate = 12.5, .program = "ffmpeg"});
    for (int i = 0; i < 6; ++i) film.add(picture(i, 97, 64));  // an odd width
    EXPECT_THAT(fault_of([&] { film.add(picture(0)); }), HasSubstr("cannot take a picture"));
    film.finish();
  }
  EXPECT_THAT(folder.files(), testing::ElementsAre(name));
  const tests::Finished back = tests::run_program(
      "/usr/bin/env", {"ffmpeg", "-loglevel", "error", "-i", name, "back_%d.png"}, folder.path());
  ASSERT_EQ(back.status, 0) << back.err;
  EXPECT_EQ(folder.files().size(), 7U);
  for (int i = 0; i < 6; ++i) {
    const io::Image found = io::read_png(folder / ("back_" + std::to_string(i + 1) + ".png"));
    const sculpt::Picture wanted = picture(i, 97, 64);
    ASSERT_EQ(found.height, 64);
    ASSERT_GE(found.width, 97);
    double sum = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 97; ++x)
        sum += std::abs(int{found.rgba[static_cast<std::size_t>(4 * (y * found.width + x))]} -
                        int{wanted.rgba[static_cast<std::size_t>(4 * (y * 97 + x))]});
    EXPECT_LT(sum / (64 * 97), 6) << i;  // of 255: compression; a picture off by one in order has 20
  }
}

TEST_P(WithFfmpeg, LeaveNothingWhereTheyAreNotFinished) {
  const TemporaryFolder folder;
  {
    FilmWriter film(folder / (std::string("walk.") + GetParam()));
    film.add(picture(0));
  }
  EXPECT_TRUE(folder.files().empty());
}

INSTANTIATE_TEST_SUITE_P(Endings, WithFfmpeg, testing::Values("mp4", "gif"),
                         [](const auto& test) { return std::string(test.param); });

class MovieCommand : public tests::ArgilCalls {
 protected:
  std::filesystem::path session_ =
      folder_.write("drop.argil",
                    "argil 1\nnew box 1 1 1 size 0.1 0.1 0.1\nlevels 1\ngravity 0 0 -9.81\n"
                    "step 12 dt 1/60\nrender skipped.png\n");
};

TEST_F(MovieCommand, ShowsABodyThatFallsToAnEyeThatStandsStill) {
  const auto run = argil({"movie", "drop.argil", "--out", "film", "--file", "drop.png", "--fps", "20", "--with",
                          "size 120 160 plain wire none"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("4 pictures at 20 a second"));
  std::vector<double> heights;
  for (int i = 0; i < 4; ++i) {
    const io::Image image = io::read_png(folder_ / ("film/drop_000" + std::to_string(i) + ".png"));
    double sum = 0, rows = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const auto* pixel = &image.rgba[static_cast<std::size_t>(4 * (y * image.width + x))];
        if (pixel[0] < pixel[2] + 30) continue;  // clay is warm, the ground is not
        sum += y;
        rows += 1;
      }
    ASSERT_GT(rows, 50);
    heights.push_back(sum / rows);
  }
  // It falls by g/2 t²: in ever larger steps.
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(heights[i], heights[i - 1] + 1);
  EXPECT_GT(heights[3] - heights[2], heights[2] - heights[1]);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film/skipped.png"));
}

TEST_F(MovieCommand, TurnsAboutTheLastShape) {
  const auto run = argil({"movie", "drop.argil", "--out", "film", "--file", "turn.png", "--turntable", "--seconds",
                          "0.4", "--fps", "10", "--with", "size 80 80"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("4 pictures"));
  // A cube looks alike from four sides, but for the light.
  EXPECT_NE(io::read_png(folder_ / "film/turn_0000.png").rgba, io::read_png(folder_ / "film/turn_0001.png").rgba);
}

TEST_F(MovieCommand, TellsHowFarItHasGot) {
  const auto run = argil({"movie", "drop.argil", "--out", "film", "--file", "drop.png", "--fps", "20", "--with",
                          "size 64 64 plain wire none"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("picture 4 of 4"));
  EXPECT_THAT(run.err, HasSubstr("100 %"));
  int last = -1;
  std::istringstream lines(run.err);
  for (std::string line; std::getline(lines, line);) {
    const int share = std::stoi(line);
    EXPECT_GT(share, last) << run.err;
    last = share;
  }
  EXPECT_EQ(last, 100);
  EXPECT_EQ(argil({"movie", "drop.argil", "--out", "film", "--file", "a.png", "--quiet"}).err, "");
}

// By SIGTERM, since shells have what they run in the background ignore Ctrl-C: the film has begun, and nothing of
// it is left.
TEST_F(MovieCommand, LeavesNothingWhereItIsInterrupted) {
  folder_.write("long.argil",
                "argil 1\nnew box 2 2 2 size 0.1 0.1 0.1\nlevels 1\ngravity 0 0 -9.81\nstep 100000 dt 1/60\n");
  for (const std::string name : {"film.png", view::can_write_films() ? "film.mp4" : "again.png"}) {
    // The turn of many pictures comes after a session of few steps.
    const std::string script =
        "'" + std::string(ARGIL_PROGRAM) + "' movie drop.argil --out film --file " + name +
        " --turntable --seconds 500 --with 'size 64 64' 2>/dev/null & p=$!; " +
        "while [ -z \"$(ls film 2>/dev/null)\" ]; do :; done; kill -TERM $p; wait $p; echo $?";
    const auto run = tests::run_program("/bin/sh", {"-c", script}, folder_.path());
    EXPECT_EQ(run.out, "143\n") << run.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder_ / "film")) << folder_.files().size();
  }
  // While the session still runs, too.
  const auto run = tests::run_program(
      "/bin/sh",
      {"-c", "'" + std::string(ARGIL_PROGRAM) +
                 "' movie long.argil --out other --file a.png 2>err & p=$!; while [ ! -s err ]; do :; done; "
                 "kill -TERM $p; wait $p; echo $?"},
      folder_.path());
  EXPECT_EQ(run.out, "143\n") << run.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "other"));
}

TEST_F(MovieCommand, SaysWhatIsWrong) {
  folder_.write("still.argil", "argil 1\nnew box 1 1 1\n");
  folder_.write("empty.argil", "argil 1\n");
  for (const auto& [arguments, message] : std::initializer_list<std::pair<std::vector<std::string>, const char*>>{
           {{"movie", "still.argil"}, "takes no step"},
           {{"movie", "empty.argil", "--turntable", "--file", "a.png"}, "makes no solid"},
           {{"movie", "none.argil"}, "there is no such file"},
           {{"movie", "drop.argil", "--file", "../a.png"}, "climbs out"},
           {{"movie", "drop.argil", "--file", "a.mov"}, ".mp4, .gif or .png"},
           {{"movie", "drop.argil", "--seconds", "2"}, "add --turntable"},
           {{"movie", "drop.argil", "--file", "a.png", "--with", "feild strain"}, "--with:1"},
           {{"movie", "drop.argil", "--fps", "0"}, "--fps"},
       }) {
    const auto run = argil(arguments);
    EXPECT_EQ(run.status, 2) << message;
    EXPECT_THAT(run.err, HasSubstr(message));
  }
}

}  // namespace
}  // namespace argil::view
