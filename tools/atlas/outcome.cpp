#include "tools/atlas/outcome.h"

#include <map>

namespace argil::atlas {

std::string_view word(Outcome outcome) {
  switch (outcome) {
    case Outcome::stable:
      return "stable";
    case Outcome::inaccurate:
      return "inaccurate";
    case Outcome::diverged:
      return "diverged";
    case Outcome::refused:
      return "refused";
  }
  return "";
}

namespace {

class Search {
 public:
  explicit Search(const std::function<Outcome(int)>& outcome) : outcome_(outcome) {}
  Outcome at(int position) {
    const auto [found, is_new] = known_.try_emplace(position);
    if (is_new) found->second = outcome_(position);
    return found->second;
  }
  void narrow(int low, int high) {
    if (high - low < 2 || at(low) == at(high)) return;
    const int middle = (low + high) / 2;
    static_cast<void>(at(middle));
    narrow(low, middle);
    narrow(middle, high);
  }
  std::vector<LinePoint> points() const {
    std::vector<LinePoint> result;
    for (const auto& [position, outcome] : known_) result.push_back({position, outcome});
    return result;
  }

 private:
  const std::function<Outcome(int)>& outcome_;
  std::map<int, Outcome> known_;
};

}  // namespace

std::vector<LinePoint> search_line(const LineGrid& grid, const std::function<Outcome(int)>& outcome) {
  Search search(outcome);
  const int stride = 1 << grid.depth;
  for (int i = 0; i <= grid.coarse; ++i) static_cast<void>(search.at(i * stride));
  for (int i = 0; i < grid.coarse; ++i) search.narrow(i * stride, (i + 1) * stride);
  return search.points();
}

std::vector<Stretch> stretches(const LineGrid& grid, const std::vector<LinePoint>& points) {
  std::vector<Stretch> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!result.empty() && result.back().outcome == points[i].outcome) continue;
    const double begin = i == 0 ? 0 : 0.5 * (points[i - 1].position + points[i].position);
    if (!result.empty()) result.back().end = begin;
    result.push_back({begin, static_cast<double>(grid.last()), points[i].outcome});
  }
  return result;
}

}  // namespace argil::atlas
