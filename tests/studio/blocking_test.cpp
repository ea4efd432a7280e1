// No frame waits: while one is laid out, no call of the system that could block is made. The calls are counted by
// functions that stand before the C library's own.

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>

#include <atomic>
#include <cstdarg>
#include <ctime>
#include <filesystem>

#include "tools/studio/offscreen.h"

#if !defined(__SANITIZE_ADDRESS__)  // which stands before the C library itself

namespace argil::studio {
namespace {

std::atomic<Workshop*> watched{nullptr};
std::atomic<long> calls{0};
std::atomic<const char*> last_call{""};

void note(const char* name) {
  Workshop* const workshop = watched.load();
  if (workshop == nullptr || !workshop->is_in_frame()) return;
  ++calls;
  last_call = name;
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace
}  // namespace argil::studio

using argil::studio::next;
using argil::studio::note;

extern "C" {

int open(const char* path, int flags, ...) {
  note("open");
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(rest, int)) : 0;
  va_end(rest);
  return next<int(const char*, int, ...)>("open")(path, flags, mode);
}
FILE* fopen(const char* path, const char* how) {
  note("fopen");
  return next<FILE*(const char*, const char*)>("fopen")(path, how);
}
DIR* opendir(const char* path) {
  note("opendir");
  return next<DIR*(const char*)>("opendir")(path);
}
int stat(const char* path, struct stat* result) {
  note("stat");
  return next<int(const char*, struct stat*)>("stat")(path, result);
}
int poll(struct pollfd* files, nfds_t count, int timeout) {
  note("poll");
  return next<int(struct pollfd*, nfds_t, int)>("poll")(files, count, timeout);
}
int nanosleep(const struct timespec* wanted, struct timespec* left) {
  note("nanosleep");
  return next<int(const struct timespec*, struct timespec*)>("nanosleep")(wanted, left);
}
int clock_nanosleep(clockid_t clock, int flags, const struct timespec* wanted, struct timespec* left) {
  note("clock_nanosleep");
  return next<int(clockid_t, int, const struct timespec*, struct timespec*)>("clock_nanosleep")(clock, flags,
                                                                                                wanted, left);
}
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  note("pthread_cond_wait");
  return next<int(pthread_cond_t*, pthread_mutex_t*)>("pthread_cond_wait")(condition, mutex);
}
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const struct timespec* until) {
  note("pthread_cond_clockwait");
  return next<int(pthread_cond_t*, pthread_mutex_t*, clockid_t, const struct timespec*)>("pthread_cond_clockwait")(
      condition, mutex, clock, until);
}
int pthread_join(pthread_t thread, void** result) {
  note("pthread_join");
  return next<int(pthread_t, void**)>("pthread_join")(thread, result);
}

}  // extern "C"

namespace argil::studio {
namespace {

class WatchFrames {
 public:
  explicit WatchFrames(Workshop& workshop) {
    calls = 0;
    watched = &workshop;
  }
  ~WatchFrames() { watched = nullptr; }
};

TEST(Blocking, NoFrameCallsWhatCouldWait) {
  OffscreenOptions options;
  options.width = 960;
  options.height = 640;
  options.bench.out = std::filesystem::path(testing::TempDir()) / "studio_blocking";
  std::filesystem::remove_all(options.bench.out);
  options.bench.samples = ARGIL_SAMPLES_DIR;
  options.bench.settings = options.bench.out / "settings";
  Offscreen window(options);
  const WatchFrames watch(window.workshop());
  // What a hand does, dialogues that show the disk included.
  window.drag(480, 260, 500, 200, 8);
  for (const char* keys : {"Ctrl-O", "Esc", "Ctrl-Shift-O", "Esc", "F1", "Esc", "F3", "Esc", "Ctrl-D", "Esc", "C",
                           "V", "Ctrl-Z", "Ctrl-Shift-Z", "Space", "Space", "Tab", "Tab"}) {
    window.press(keys);
    window.wait(3);
  }
  window.press("Ctrl-O");
  window.wait(2);
  window.type("/tm");
  window.wait(3);
  EXPECT_EQ(calls.load(), 0) << last_call.load();
}

// The watch itself works: what is called in a frame is seen.
TEST(Blocking, WhatIsCalledInAFrameIsSeen) {
  BenchOptions options;
  options.out = std::filesystem::path(testing::TempDir()) / "studio_blocking_seen";
  Workshop workshop(options);
  const WatchFrames watch(workshop);
  workshop.frame_begins();
  (void)std::filesystem::is_directory("/");
  workshop.frame_ends();
  EXPECT_EQ(calls.load(), 1);
}

}  // namespace
}  // namespace argil::studio

#endif
