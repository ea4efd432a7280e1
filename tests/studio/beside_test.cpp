// What is made beside the session, films and ghosts, and how it is ended: work that nobody wants any more ends
// early, orders do not wait for it, and nothing half made stays.

#include <gmock/gmock.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "tests/studio/windows.h"
#include "tools/studio/errand.h"
#include "tools/studio/previewer.h"

namespace argil::studio {
namespace {

using testing::HasSubstr;

/// At most a minute, so that what does nothing fails instead of hanging.
bool comes(const std::function<bool()>& what) {
  for (int i = 0; i < 60000 && !what(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return what();
}

bool says(const Workshop& workshop, const std::string& words) {
  for (const Message& message : workshop.latest()->messages)
    if (message.text.find(words) != std::string::npos) return true;
  return false;
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.push_back(entry.path().lexically_relative(folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Errand, IsDoneAtOnceWithoutAThread) {
  Errand errand;
  int done = 0;
  errand.begin([&](const Progress::Listener& progress) {
    progress(0.5, "half");
    ++done;
  });
  EXPECT_EQ(done, 1);
  EXPECT_FALSE(errand.is_busy());
}

// A job that would never end of itself ends when another takes its place, or when it is cancelled.
TEST(Errand, EndsEarlyForANewerOne) {
  Errand errand;
  errand.start();
  std::atomic<long> first{0}, second{0};
  std::atomic<bool> first_ended{false};
  const auto without_end = [](std::atomic<long>& count) {
    return [&count](const Progress::Listener& progress) {
      for (;;) {
        progress(0.25, "for ever");
        ++count;
      }
    };
  };
  errand.begin([&](const Progress::Listener& progress) {
    try {
      without_end(first)(progress);
    } catch (const Cancelled&) {
      first_ended = true;
      throw;
    }
  });
  ASSERT_TRUE(comes([&] { return first > 0; }));
  ASSERT_TRUE(comes([&] { return errand.work() != nullptr; }));
  EXPECT_EQ(errand.work()->what, "for ever");
  EXPECT_EQ(errand.work()->share, 0.25);
  errand.begin(without_end(second));
  ASSERT_TRUE(comes([&] { return second > 0; }));
  EXPECT_TRUE(first_ended);
  EXPECT_TRUE(errand.is_busy());
  errand.cancel();
  ASSERT_TRUE(comes([&] { return !errand.is_busy(); }));
  EXPECT_FALSE(errand.work());
  // And at the end of its life, what is under way ends as well.
  errand.begin(without_end(second));
}

TEST(Errand, OfSeveralThatWaitOnlyTheLastIsDone) {
  Errand errand;
  errand.start();
  std::atomic<bool> holds{true};
  std::atomic<int> done{0}, last{0};
  errand.begin([&](const Progress::Listener&) {
    while (holds) std::this_thread::yield();
  });
  for (int i = 1; i <= 20; ++i)
    errand.begin([&, i](const Progress::Listener&) {
      ++done;
      last = i;
    });
  holds = false;
  ASSERT_TRUE(comes([&] { return last == 20; }));
  EXPECT_EQ(done, 1);
}

GhostSubject subject_of(sculpt::Session& session) {
  return {.state = detached(session.document().state()),
          .request = {},
          .scene = std::make_shared<sculpt::Scene>(sculpt::make_scene(session.document(), {})),
          .layout = 1,
          .out = session.options().out,
          .limits = {}};
}

// Counts what it tells: a ghost that is ended has told less than one that was made.
TEST(Ghost, EndsWhereItIsAndLeavesTheDocumentAlone) {
  sculpt::SessionOptions options;
  options.out = test_folder("ghost_ends");
  sculpt::Session session(options);
  for (const char* line : {"new box 3 3 3", "levels 2", "select faces where z > 0.9"})
    session.run_line(std::string(line));
  const std::uint64_t before = session.document().state_hash();
  long told = 0;
  double last = 0;
  const Ghost whole =
      make_ghost(subject_of(session), {"extrude 0.2", "extrude 0.1"}, [&](double share, const char*) {
        ++told;
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1);
        last = share;
      });
  EXPECT_EQ(whole.fault, "");
  EXPECT_EQ(whole.cells_made, 18U);
  ASSERT_GT(told, 10);
  for (const long end : {0L, 1L, told / 2, told - 1}) {
    long heard = 0;
    EXPECT_THROW(static_cast<void>(make_ghost(subject_of(session), {"extrude 0.2", "extrude 0.1"},
                                              [&](double, const char*) {
                                                if (heard++ == end) throw Cancelled();
                                              })),
                 Cancelled);
    EXPECT_EQ(heard, end + 1);
  }
  EXPECT_EQ(session.document().state_hash(), before);
}

// The previews that a hand goes through are not all made: those in between end early.
TEST(Previewer, MakesTheLastToItsEnd) {
  BenchOptions bench;
  bench.out = test_folder("previews");
  Workshop workshop(bench);
  workshop.start();
  workshop.run_together({"new box 6 6 6", "levels 2", "select faces where z > 0.99"});
  ASSERT_TRUE(comes([&] { return workshop.latest()->scene != nullptr; }));
  constexpr int k_wanted = 30;
  for (int i = 1; i <= k_wanted; ++i) {
    workshop.preview({fmt::format("extrude {}", 0.01 * i)});
    std::this_thread::yield();
  }
  ASSERT_TRUE(comes([&] {
    const auto now = workshop.latest();
    return now->ghost && now->ghost->lines.front() == fmt::format("extrude {}", 0.01 * k_wanted);
  }));
  EXPECT_EQ(workshop.latest()->ghost->fault, "");
  EXPECT_EQ(workshop.latest()->ghost->cells_made, 36U);
  EXPECT_LT(workshop.bench().previewer().finished(), k_wanted / 2);
  workshop.preview({});
  ASSERT_TRUE(comes([&] { return !workshop.latest()->ghost; }));
}

/// Stands in for the making of films: it goes on until it is let, writing a file meanwhile.
struct SlowFilm {
  std::atomic<bool> runs{false}, may_end{false};
  std::atomic<int> ended_early = 0;
  std::string session;

  FilmMaker maker() {
    return [this](const FilmOrder& order, const Progress::Listener& progress) -> std::string {
      session = order.session;
      runs = true;
      try {
        for (long i = 0; !may_end; ++i) progress(std::min(0.9, 0.001 * static_cast<double>(i)), "picture");
      } catch (...) {
        ++ended_early;
        throw;
      }
      runs = false;
      return "the film is there";
    };
  }
};

TEST(Darkroom, OrdersDoNotWaitForAFilmOfWhatWasThereBefore) {
  SlowFilm film;
  BenchOptions bench;
  bench.out = test_folder("film_beside");
  bench.film = film.maker();
  Workshop workshop(bench);
  workshop.start();
  workshop.post([](Bench& b) { b.begin_block(); });
  workshop.post([](Bench& b) { b.film(false); });
  ASSERT_TRUE(comes([&] { return film.runs && workshop.latest()->scene; }));
  // A stroke, what it made undone, a line and a file, while the film is made.
  const Eigen::Vector3d top(0, 0, 0.5);
  sculpt::Tool pull;
  pull.radius = 0.15;
  pull.strength = 2000;
  workshop.begin_stroke({.pose = {top}, .tool = pull, .options = {}});
  workshop.move_device({top + Eigen::Vector3d(0, 0, 0.1)});
  ASSERT_TRUE(comes([&] { return workshop.latest()->state.motion->time > 0.05; }));
  workshop.end_stroke(false);
  ASSERT_TRUE(comes([&] {
    return !workshop.latest()->stroke && !workshop.latest()->history->empty() &&
           workshop.latest()->history->back().stroke_end > 0;
  }));
  workshop.post([](Bench& b) { b.undo(); });
  workshop.run("levels 1");
  workshop.post([&](Bench& b) { b.save(bench.out / "mine.argil"); });
  ASSERT_TRUE(comes([&] { return workshop.latest()->state.level == 1 && workshop.latest()->saved; }));
  EXPECT_TRUE(film.runs);
  EXPECT_THAT(film.session, testing::Not(HasSubstr("stroke")));
  ASSERT_TRUE(comes([&] { return workshop.film_work() != nullptr; }));
  EXPECT_EQ(workshop.film_work()->what, "picture");
  // Of two at once the second is refused.
  workshop.post([](Bench& b) { b.film(true); });
  ASSERT_TRUE(comes([&] { return says(workshop, "a film is being made"); }));
  film.may_end = true;
  ASSERT_TRUE(comes([&] { return says(workshop, "the film is there"); }));
  EXPECT_FALSE(workshop.film_work());
}

TEST(Darkroom, AFilmIsCancelledAndEndsWithTheWindow) {
  SlowFilm film;
  BenchOptions bench;
  bench.out = test_folder("film_cancelled");
  bench.film = film.maker();
  {
    Workshop workshop(bench);
    workshop.start();
    workshop.post([](Bench& b) { b.film(false); });
    ASSERT_TRUE(comes([&] { return film.runs.load(); }));
    workshop.cancel_film();
    ASSERT_TRUE(comes([&] { return says(workshop, "the film was cancelled"); }));
    film.runs = false;
    workshop.post([](Bench& b) { b.film(false); });
    ASSERT_TRUE(comes([&] { return film.runs.load(); }));
  }
  EXPECT_EQ(film.ended_early, 2);  // by the sculptor, and by the workshop's end
}

// The note stands over the view until the film is there; Esc is for what the hand does, and ends no film.
TEST(Darkroom, AFilmShowsHowFarItIsAndItsButtonEndsIt) {
  SlowFilm film;
  OffscreenOptions options = small_window("film_note");
  options.real_time = true;
  options.bench.film = film.maker();
  Offscreen window(options);
  window.workshop().post([](Bench& b) { b.film(false); });
  const auto shows = [&](const char* name) { return window.studio().ui().find(name) != nullptr; };
  ASSERT_TRUE(comes([&] {
    window.wait();
    return shows("Cancel film");
  }));
  EXPECT_TRUE(shows("Progress of the film"));
  EXPECT_FALSE(shows("Cancel work"));
  window.press("Esc");
  window.wait(3);
  EXPECT_TRUE(shows("Cancel film"));
  window.click("Cancel film");
  ASSERT_TRUE(comes([&] {
    window.wait();
    return says(window.workshop(), "the film was cancelled") && !shows("Cancel film");
  }));
}

// In virtual time a film is there when the order is done: scripts give the same pictures each time.
TEST(Darkroom, InVirtualTimeAFilmIsMadeAtOnce) {
  SlowFilm film;
  film.may_end = true;
  BenchOptions bench;
  bench.out = test_folder("film_virtual");
  bench.film = film.maker();
  Workshop workshop(bench);
  workshop.run("new box 2 2 2");
  workshop.post([](Bench& b) { b.film(false); });
  workshop.advance(0);
  EXPECT_TRUE(says(workshop, "the film is there"));
  EXPECT_THAT(film.session, HasSubstr("new box 2 2 2"));
}

// Opened half way, and cancelled: the session before is there with its history, its journal and its name.
TEST(Files, AnOpeningThatIsCancelledLeavesTheSessionBefore) {
  const auto out = test_folder("opening_cancelled");
  io::write_file(out / "long.argil", "argil 1\nnew box 3 3 3\nlevels 1\nlevels 2\ngravity 0 0 -9.81\nstep 20\n");
  BenchOptions options;
  options.out = out / "studio";
  Bench bench(options);
  long told = 0, end_at = -1;
  bench.on_progress = [&](double, const std::string&) { return told++ != end_at; };
  bench.run("new box 2 1 1");
  bench.save(out / "mine.argil");
  bench.run("levels 1");
  const std::uint64_t before = bench.session().document().state_hash();
  const std::string journal = io::read_file(bench.session().journal_path());
  const auto files = files_in(options.out);
  told = 0;
  bench.open(out / "long.argil");
  const long all = told;
  const std::uint64_t opened = bench.session().document().state_hash();
  EXPECT_NE(opened, before);
  ASSERT_GT(all, 20);
  bench.open(out / "mine.argil");
  bench.run("levels 1");
  for (const long end : {0L, 5L, all / 2, all - 1}) {
    told = 0;
    end_at = end;
    bench.open(out / "long.argil");
    end_at = -1;
    EXPECT_EQ(bench.session().document().state_hash(), before) << end;
    EXPECT_EQ(io::read_file(bench.session().journal_path()), journal);
    const auto now = bench.snapshot();
    EXPECT_EQ(now->file, (out / "mine.argil").string());
    EXPECT_FALSE(now->saved);
    EXPECT_EQ(now->undo_depth, 2U);
    EXPECT_THAT(now->messages.back().text, HasSubstr("cancelled"));
    EXPECT_FALSE(std::filesystem::exists(options.out / "opening.argil"));
  }
  bench.undo();
  bench.open(out / "long.argil");
  EXPECT_EQ(bench.session().document().state_hash(), opened);
  EXPECT_EQ(bench.session().journal_path().filename(), "journal.argil");
}

// Several lines that are one action: ended in the second, the first is taken back.
TEST(Bench, OfAnActionThatIsCancelledNothingStays) {
  BenchOptions options;
  options.out = test_folder("action_cancelled");
  Bench bench(options);
  bench.run_together({"new box 3 3 3", "levels 1", "select faces where z > 0.9"});
  const std::uint64_t before = bench.session().document().state_hash();
  long told = 0, end_at = -1;
  bench.on_progress = [&](double, const std::string&) { return told++ != end_at; };
  bench.run_together({"extrude 0.2", "levels 2"});
  const long all = told;
  bench.undo();
  ASSERT_EQ(bench.session().document().state_hash(), before);
  for (const long end : {1L, all / 2, all - 1}) {
    told = 0;
    end_at = end;
    EXPECT_FALSE(bench.run_together({"extrude 0.2", "levels 2"})) << end << " of " << all;
    end_at = -1;
    EXPECT_EQ(bench.session().document().state_hash(), before) << end;
  }
}

}  // namespace
}  // namespace argil::studio
