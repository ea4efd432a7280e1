#pragma once
// Shows what lines would make before they are run: keeps which lines are wanted and has their ghost made beside the
// session, on a copy of the document. A ghost that is wanted no more ends early.

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "tools/studio/errand.h"
#include "tools/studio/ghost.h"

namespace argil::studio {

class Previewer {
 public:
  /// `on_made` is called on the previewer's thread.
  explicit Previewer(std::function<void()> on_made) : on_made_(std::move(on_made)) {}

  void start() { errand_.start(); }
  void stop() { errand_.stop(); }
  /// From now on; none: nothing more is shown.
  void want(std::vector<std::string> lines);
  /// Lines are wanted that have not been begun, or something has been made or dropped since it was shown.
  [[nodiscard]] bool has_changed() const;
  /// Begins the ghost of the lines wanted, if that has not been done, or `anew`. The subject is asked for then.
  void begin(bool anew, const std::function<GhostSubject()>& subject);
  /// The last one made of the lines wanted; while theirs is made, the one before. Null: none.
  [[nodiscard]] std::shared_ptr<const Ghost> show();
  [[nodiscard]] std::shared_ptr<const Work> work() const { return errand_.work(); }
  /// For tests: that were made to their end.
  [[nodiscard]] long finished() const;

 private:
  std::function<void()> on_made_;
  std::vector<std::string> wanted_;
  bool is_due_ = false;
  mutable std::mutex mutex_;
  std::shared_ptr<const Ghost> made_;
  bool is_new_ = false;
  std::size_t number_ = 0;  // of the last one begun
  long finished_ = 0;
  Errand errand_;  // last, so that it ends first
};

}  // namespace argil::studio
