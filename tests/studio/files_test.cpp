// Files in the window: what was not saved comes back, samples and recent files open, keys are changed and kept, and
// long work can be ended.

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "io/file_bytes.h"
#include "subdiv/error.h"
#include "tools/studio/offscreen.h"

namespace argil::studio {
namespace {

namespace fs = std::filesystem;

fs::path folder(const char* name) {
  const fs::path path = fs::path(testing::TempDir()) / "studio_files" / name;
  fs::remove_all(path);
  fs::create_directories(path);
  return path;
}

OffscreenOptions options(const fs::path& out) {
  OffscreenOptions result;
  result.width = 1000;
  result.height = 700;
  result.card = false;
  result.bench.out = out;
  return result;
}

std::uint64_t hash(Offscreen& window) {
  return window.workshop().bench().session().document().state_hash();
}

TEST(Files, WhatWasNotSavedIsOfferedAndComesBack) {
  const fs::path out = folder("unsaved");
  std::uint64_t made = 0;
  {
    Offscreen window(options(out));
    window.workshop().run("new box 2 3 2");
    window.workshop().run("levels 1");
    window.workshop().run("select faces where z > 0.99");
    window.workshop().run("extrude 0.25");
    window.wait(2);
    made = hash(window);
  }
  Offscreen window(options(out));
  ASSERT_EQ(window.now().unsaved->size(), 1U);
  EXPECT_EQ(window.now().unsaved->front().changes, 4U);
  EXPECT_NE(hash(window), made);
  window.wait();
  window.click("Bring back");
  window.wait(2);
  EXPECT_EQ(hash(window), made);
  EXPECT_FALSE(window.now().saved);
  EXPECT_TRUE(window.now().unsaved->empty());
}

TEST(Files, WhatIsSavedOrUntouchedIsNotOffered) {
  const fs::path out = folder("saved");
  {
    Offscreen window(options(out));
    window.workshop().run("levels 1");
    window.workshop().post([&](Bench& bench) { bench.save(out / "mine.argil"); });
    window.wait(2);
    EXPECT_TRUE(window.now().saved);
  }
  {
    Offscreen window(options(out));
    EXPECT_TRUE(window.now().unsaved->empty());
  }
  Offscreen window(options(out));
  EXPECT_TRUE(window.now().unsaved->empty());
}

TEST(Files, OpeningSomethingElseLosesNothing) {
  const fs::path out = folder("other");
  io::write_file(out / "other.argil", "argil 1\nnew box 1 1 1\n");
  Offscreen window(options(out));
  window.workshop().run("levels 3");
  window.wait();
  const std::uint64_t made = hash(window);
  window.workshop().post([&](Bench& bench) { bench.open(out / "other.argil"); });
  window.wait(2);
  ASSERT_EQ(window.now().unsaved->size(), 1U);
  window.workshop().post([](Bench& bench) {
    const UnsavedWork work = bench.snapshot()->unsaved->front();
    bench.bring_back(work);
  });
  window.wait(2);
  EXPECT_EQ(hash(window), made);
  // It came from no file, and what was open now is saved as it was.
  EXPECT_TRUE(window.now().file.empty());
}

TEST(Files, AJournalThatWasCutOffIsReadUpToItsLastWholeLine) {
  const fs::path out = folder("cut_off");
  io::write_file(out / "journal.argil", "argil 1\nnew box 2 2 2\nlevels 1\nextrude 0.1 whe");
  Offscreen window(options(out));
  ASSERT_EQ(window.now().unsaved->size(), 1U);
  window.wait();
  window.click("Bring back");
  window.wait(2);
  EXPECT_EQ(window.now().state.level, 1);
  EXPECT_EQ(window.now().control_cells, 8U);
}

TEST(Files, ADamagedJournalStays) {
  const fs::path out = folder("damaged");
  io::write_file(out / "journal.argil", "argil 1\nnew box 2 2 2\nno such line\nlevels 1\n");
  io::write_file(out / "journal.json", "{ not json");
  Offscreen window(options(out));
  ASSERT_EQ(window.now().unsaved->size(), 1U);
  window.wait();
  window.click("Bring back");
  window.wait(2);
  EXPECT_EQ(window.now().control_cells, 8U);
  EXPECT_EQ(window.now().messages.back().kind, MessageKind::error);
  EXPECT_EQ(window.now().unsaved->size(), 1U);
  EXPECT_TRUE(fs::exists(out / "unsaved-1.argil"));
}

TEST(Files, TwoWindowsDoNotShareAJournal) {
  const fs::path out = folder("two") / "studio";
  Offscreen first(options(out));
  Offscreen second(options(out));
  EXPECT_EQ(first.workshop().bench().session().journal_path(), out / "journal.argil");
  EXPECT_EQ(second.workshop().bench().session().journal_path(), out.string() + "-2/journal.argil");
}

TEST(Files, TheOldestOfManyGoes) {
  const fs::path out = folder("many");
  for (int i = 0; i < 24; ++i) {
    io::write_file(out / "journal.argil", "argil 1\nnew box 1 1 " + std::to_string(i + 1) + "\n");
    const Safekeeping keeping(out);
  }
  const Safekeeping keeping(out);
  ASSERT_EQ(keeping.unsaved().size(), 20U);
  EXPECT_EQ(io::read_file(keeping.unsaved().front().journal), "argil 1\nnew box 1 1 24\n");
  EXPECT_EQ(io::read_file(keeping.unsaved().back().journal), "argil 1\nnew box 1 1 5\n");
}

TEST(Files, ASampleOpensAsANewSession) {
  OffscreenOptions with = options(folder("samples"));
  with.bench.samples = ARGIL_SAMPLES_DIR;
  Offscreen window(with);
  window.press("Ctrl-Shift-O");
  window.wait(3);
  ASSERT_TRUE(window.now().samples);
  EXPECT_GE(window.now().samples->size(), 8U);  // every model
  window.click("Block 3");
  window.wait(3);
  EXPECT_EQ(window.studio().desk().dialogue, Dialogue::none);
  EXPECT_TRUE(window.now().file.empty());
  EXPECT_EQ(window.now().control_cells, 27U);
  EXPECT_TRUE(window.now().saved);
}

TEST(Files, RecentFilesAreKeptAndOpenAgain) {
  OffscreenOptions with = options(folder("recent"));
  with.bench.settings = with.bench.out / "settings";
  const fs::path file = with.bench.out / "one.argil";
  io::write_file(file, "argil 1\nnew box 4 1 1\n");
  {
    Offscreen window(with, file);
    EXPECT_EQ(window.now().recent->front(), file);
  }
  Offscreen window(with);
  window.press("Ctrl-O");
  window.wait(3);
  window.click("one.argil");
  window.wait(3);
  EXPECT_EQ(window.now().control_cells, 4U);
  EXPECT_EQ(window.now().file, file.string());
}

TEST(Files, AKeyIsChangedByPressingItAndKept) {
  OffscreenOptions with = options(folder("keys"));
  with.bench.settings = with.bench.out / "settings";
  Offscreen window(with);
  const Bindings& bindings = window.studio().desk().bindings;
  window.press("F1");
  window.wait(2);
  window.click("Key of undo");
  window.wait(2);
  window.press("Ctrl-U");
  window.wait(2);
  EXPECT_EQ(bindings.word_of(Action::undo), "Ctrl-U");
  // A key that another action had goes over, so that no two have the same.
  window.click("Key of redo");
  window.press("Ctrl-U");
  window.wait(2);
  EXPECT_EQ(bindings.word_of(Action::redo), "Ctrl-U");
  EXPECT_EQ(bindings.word_of(Action::undo), "");
  EXPECT_FALSE(bindings.collision());
  Bindings read;
  read.read(io::read_file(with.bench.settings / "keys"), "keys");
  EXPECT_EQ(read.key_of(Action::redo), bindings.key_of(Action::redo));
  EXPECT_EQ(read.key_of(Action::undo), bindings.key_of(Action::undo));
  window.click("ZBrush's keys");
  window.wait(2);
  EXPECT_EQ(bindings.word_of(Action::brush_radius), "S");
  window.click("Argil's keys");
  window.wait(2);
  EXPECT_EQ(bindings.changes(), "");
}

/// At most a minute, so that a workshop that does nothing fails instead of hanging.
bool comes(const std::function<bool()>& what) {
  for (int i = 0; i < 60000 && !what(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return what();
}

// By a thread, since virtual time shows no work: cancelled, a long line changes nothing.
TEST(Files, LongWorkShowsAndIsCancelled) {
  BenchOptions bench;
  bench.out = folder("cancelled");
  Workshop workshop(bench);
  workshop.start();
  workshop.post([](Bench& b) { b.begin_block(); });
  ASSERT_TRUE(comes([&] { return workshop.latest()->scene != nullptr; }));
  workshop.run("force 0 0 5 where z > 0.49");
  workshop.run("step 100000");
  std::shared_ptr<const Work> work;
  ASSERT_TRUE(comes([&] { return (work = workshop.work()) && work->seconds > 0.1; }));
  EXPECT_GE(work->share, 0);
  EXPECT_LT(work->share, 0.9);
  workshop.cancel_work();
  ASSERT_TRUE(comes([&] {
    const auto& messages = workshop.latest()->messages;
    return !messages.empty() && messages.back().text.find("cancelled") != std::string::npos;
  }));
  EXPECT_EQ(workshop.latest()->state.motion->time, 0);
  EXPECT_EQ(workshop.latest()->steps, 0);
  EXPECT_FALSE(workshop.work());
}

}  // namespace
}  // namespace argil::studio
