#pragma once
// How far a command has got, on standard error: a bar that is redrawn in a terminal, a line every tenth elsewhere.
// Messages go above it.

#include <string>

namespace argil::tools {

class ProgressBar {
 public:
  explicit ProgressBar(bool quiet);
  void message(const std::string& text);
  /// A fraction below 0 is not known, and leaves the bar where it is.
  void update(double fraction, const std::string& what);
  void clear();

 private:
  bool quiet_, terminal_, drawn_ = false;
  int last_tenth_ = -1;
  double last_drawn_ = 0, last_fraction_ = 0;
};

}  // namespace argil::tools
