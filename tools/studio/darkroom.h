#pragma once
// Where films of the session are made, beside it: each of a copy of the journal as it was when the film was asked
// for, so that the sculptor works on. A film that is ended leaves nothing.

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "tools/studio/errand.h"
#include "tools/studio/snapshot.h"

namespace argil::studio {

struct FilmOrder {
  std::string session;              // its text
  std::filesystem::path read_root;  // that its lines read files beneath
  std::filesystem::path out;        // folder of the film
  bool turntable = false;           // of the last shape, else of the simulation
};
/// Makes a film and says where it is. What the listener throws ends it, and nothing of it stays.
using FilmMaker = std::function<std::string(const FilmOrder& order, const Progress::Listener& progress)>;

class Darkroom {
 public:
  /// `maker` may be empty: there are no films. `on_news` is called on the darkroom's thread.
  Darkroom(FilmMaker maker, std::function<void()> on_news);

  void start() { errand_.start(); }
  void stop() { errand_.stop(); }
  /// @throws Error (unsupported) where there are no films, (refused) while one is made.
  void make(FilmOrder order);
  void cancel() { errand_.cancel(); }
  [[nodiscard]] std::shared_ptr<const Work> work() const { return errand_.work(); }

  [[nodiscard]] bool has_news() const;
  /// What became of films since the last call.
  [[nodiscard]] std::vector<Message> take_news();

 private:
  void tell(MessageKind kind, const std::string& text);

  FilmMaker maker_;
  std::function<void()> on_news_;
  mutable std::mutex mutex_;
  std::vector<Message> news_;
  Errand errand_;  // last, so that it ends first
};

}  // namespace argil::studio
