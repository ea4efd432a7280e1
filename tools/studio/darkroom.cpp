#include "tools/studio/darkroom.h"

#include <utility>

#include "subdiv/error.h"

namespace argil::studio {

Darkroom::Darkroom(FilmMaker maker, std::function<void()> on_news)
    : maker_(std::move(maker)), on_news_(std::move(on_news)) {}

void Darkroom::make(FilmOrder order) {
  if (!maker_) throw Error(ErrorCode::unsupported, "this program makes no films");
  if (errand_.is_busy())
    throw Error(ErrorCode::refused, "a film is being made; wait for it, or cancel it, before the next one");
  errand_.begin([this, order = std::move(order)](const Progress::Listener& progress) {
    try {
      tell(MessageKind::note, maker_(order, progress));
    } catch (const Cancelled&) {
      tell(MessageKind::note, "the film was cancelled, and nothing of it stays");
    } catch (const std::exception& error) {
      tell(MessageKind::error, error.what());
    }
  });
}

bool Darkroom::has_news() const {
  const std::lock_guard lock(mutex_);
  return !news_.empty();
}

std::vector<Message> Darkroom::take_news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(news_, {});
}

void Darkroom::tell(MessageKind kind, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    news_.push_back({kind, text});
  }
  if (on_news_) on_news_();
}

}  // namespace argil::studio
