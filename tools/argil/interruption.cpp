#include "tools/argil/interruption.h"

#include <csignal>

#include "subdiv/progress.h"

namespace argil::tools {

namespace {

constexpr int k_signals[] = {SIGINT, SIGTERM, SIGHUP};
// A handler can reach nothing else.
volatile std::sig_atomic_t came = 0;
struct sigaction before[std::size(k_signals)];

void note(int signal) {
  came = signal;
}

}  // namespace

Interruption::Interruption() {
  came = 0;
  struct sigaction noting {};
  noting.sa_handler = note;
  noting.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < std::size(k_signals); ++i) {
    sigaction(k_signals[i], nullptr, &before[i]);
    // What a shell has told to be ignored, as for work in the background, stays so.
    if (before[i].sa_handler != SIG_IGN) sigaction(k_signals[i], &noting, nullptr);
  }
}

Interruption::~Interruption() {
  restore();
}

void Interruption::restore() {
  if (restored_) return;
  for (std::size_t i = 0; i < std::size(k_signals); ++i) sigaction(k_signals[i], &before[i], nullptr);
  restored_ = true;
}

void Interruption::check() {
  if (came != 0) throw Cancelled("interrupted; nothing is left of what was half made");
}

void Interruption::pass_on() {
  if (came == 0) return;
  restore();
  std::raise(came);
}

}  // namespace argil::tools
