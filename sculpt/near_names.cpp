#include "sculpt/near_names.h"

#include <algorithm>

namespace argil::sculpt {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::vector<std::string> near_names(std::string_view name, std::span<const std::string> names, std::size_t limit) {
  struct Candidate {
    std::size_t distance, index;
  };
  const std::string_view start = name.substr(0, 64);  // no known name is longer, so that the cost is bounded
  const std::size_t allowed = std::max<std::size_t>(1, start.size() / 3);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t distance = edit_distance(start, names[i]);
    if (distance <= allowed && distance < std::max<std::size_t>(2, names[i].size()))
      candidates.push_back({distance, i});
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
  });
  candidates.resize(std::min(candidates.size(), limit));
  std::vector<std::string> nearest;
  for (const Candidate& candidate : candidates) nearest.push_back(names[candidate.index]);
  return nearest;
}

std::string near_names_hint(std::string_view name, std::span<const std::string> names) {
  std::string hint;
  for (const std::string& near : near_names(name, names))
    hint += (hint.empty() ? "; did you mean `" : " or `") + near + "`";
  return hint.empty() ? hint : hint + "?";
}

}  // namespace argil::sculpt
