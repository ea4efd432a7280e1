#include "tools/argil/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace argil::tools {

namespace {

constexpr double k_between = 0.05;  // [s], two pictures of the bar

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

ProgressBar::ProgressBar(bool quiet) : quiet_(quiet), terminal_(isatty(fileno(stderr)) != 0) {}

void ProgressBar::message(const std::string& text) {
  if (quiet_) return;
  clear();
  std::fprintf(stderr, "  %s\n", text.c_str());
}

void ProgressBar::update(double fraction, const std::string& what) {
  if (quiet_) return;
  if (!terminal_) {
    const int tenth = static_cast<int>(fraction * 10 + 1e-9);
    if (tenth > last_tenth_) std::fprintf(stderr, "%3d %%  %s\n", 10 * tenth, what.c_str());
    last_tenth_ = std::max(last_tenth_, tenth);
    return;
  }
  if (fraction >= 0) last_fraction_ = fraction;
  const double now = seconds();
  if (now - last_drawn_ < k_between && fraction < 1) return;
  last_drawn_ = now;
  const int width = 30, filled = static_cast<int>(last_fraction_ * width);
  std::string bar;
  for (int i = 0; i < width; ++i) bar += i < filled ? "█" : "░";
  std::fprintf(stderr, "\r\x1b[2K%s %3.0f %%  %.60s", bar.c_str(), 100 * last_fraction_, what.c_str());
  drawn_ = true;
}

void ProgressBar::clear() {
  if (drawn_) std::fprintf(stderr, "\r\x1b[2K");
  drawn_ = false;
}

}  // namespace argil::tools
