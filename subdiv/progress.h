#pragma once
// How far something has got that takes long, told to whoever waits for it. A listener that throws ends the work,
// which has then changed nothing. The handle is passed down by value, and in parts to the parts of the work.

#include <functional>

#include "subdiv/error.h"

namespace argil {

/// What ends work that nobody waits for any more.
class Cancelled : public Error {
 public:
  explicit Cancelled(const std::string& message = "it was cancelled, and has changed nothing")
      : Error(ErrorCode::refused, message) {}
};

class Progress {
 public:
  /// Hears the share that is done, 0 … 1, and what is being done; only ever on the thread that asked for the work.
  /// A share of 0 begins something new; after that it may also fall, where how much there is to do turns out later.
  using Listener = std::function<void(double share, const char* what)>;

  Progress() = default;  // nobody listens
  /// The listener must outlive the work.
  explicit Progress(const Listener& listener, const char* what = "") : listener_(&listener), what_(what) {}

  bool is_heard() const { return listener_ != nullptr && *listener_; }
  void at(double share) const {
    if (is_heard()) (*listener_)(from_ + share * (to_ - from_), what_);
  }
  /// For a part of the work, which is all of it that lies between these shares.
  [[nodiscard]] Progress part(double from, double to) const {
    Progress result = *this;
    result.from_ = from_ + from * (to_ - from_);
    result.to_ = from_ + to * (to_ - from_);
    return result;
  }
  /// The same under another name, a literal.
  [[nodiscard]] Progress of(const char* what) const {
    Progress result = *this;
    result.what_ = what;
    return result;
  }

 private:
  const Listener* listener_ = nullptr;
  double from_ = 0, to_ = 1;
  const char* what_ = "";
};

}  // namespace argil
