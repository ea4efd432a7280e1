#pragma once
// Ctrl-C and the like while something is made: they are noted, so that what is half made is taken away before the
// program ends as it was asked to.

namespace argil::tools {

class Interruption {
 public:
  /// From here on, and until this dies, SIGINT, SIGTERM and SIGHUP are noted. One at a time.
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// @throws Cancelled if one has come.
  static void check();
  /// Lets the signal that came do what it would have done; returns if none came.
  void pass_on();

 private:
  void restore();
  bool restored_ = false;
};

}  // namespace argil::tools
