#include "tools/studio/previewer.h"

#include <utility>

namespace argil::studio {

void Previewer::want(std::vector<std::string> lines) {
  if (lines == wanted_) return;
  wanted_ = std::move(lines);
  is_due_ = true;
  errand_.cancel();
}

bool Previewer::has_changed() const {
  const std::lock_guard lock(mutex_);
  return is_due_ || is_new_;
}

void Previewer::begin(bool anew, const std::function<GhostSubject()>& subject) {
  if (!is_due_ && !anew) return;
  is_due_ = false;
  std::size_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++number_;
    if (wanted_.empty() || anew) made_ = nullptr;
  }
  if (wanted_.empty()) return;
  errand_.begin([this, number, lines = wanted_, of = subject()](const Progress::Listener& progress) {
    auto ghost = std::make_shared<const Ghost>(make_ghost(of, lines, progress));
    {
      const std::lock_guard lock(mutex_);
      ++finished_;
      if (number != number_) return;
      made_ = std::move(ghost);
      is_new_ = true;
    }
    if (on_made_) on_made_();
  });
}

std::shared_ptr<const Ghost> Previewer::show() {
  const std::lock_guard lock(mutex_);
  is_new_ = false;
  return made_;
}

long Previewer::finished() const {
  const std::lock_guard lock(mutex_);
  return finished_;
}

}  // namespace argil::studio
