#include "tools/chart/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace argil::chart {

namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::string figures(const Panel& panel, const Row& row) {
  return fmt::format("{} in {}", percent_text(row.error), time_text(panel.time(row)));
}

// Worth a word only where others have the reference's law.
std::string law_note(const Panel& panel, const Row& row) {
  const bool any = std::any_of(panel.rows.begin(), panel.rows.end(),
                               [&](const Row& r) { return r.same_law && std::isfinite(panel.time(r)); });
  return row.same_law || !any ? "" : " (of another law than the reference's)";
}

// The fastest run for each bound on the error, bounds with the same answer together.
void say_fastest(const Panel& panel, const std::vector<std::size_t>& front, std::vector<std::string>& to) {
  std::map<std::size_t, std::vector<std::string>> bounds_of;
  std::vector<std::size_t> order;
  std::vector<std::string> unreached;
  for (const double bound : {0.1, 0.01, 0.001}) {
    if (bound < panel.uncertainty) continue;
    const auto found =
        std::find_if(front.begin(), front.end(), [&](std::size_t i) { return panel.rows[i].error <= bound; });
    const std::string text = fmt::format("{:g} %", 100 * bound);
    if (found == front.end()) {
      unreached.push_back(text);
      continue;
    }
    if (bounds_of[*found].empty()) order.push_back(*found);
    bounds_of[*found].push_back(text);
  }
  for (const std::size_t i : order) {
    const Row& row = panel.rows[i];
    to.push_back(fmt::format("For an error below {} the fastest is {}: {} with {} unknowns{}.",
                             joined(bounds_of[i]), name_of(row), figures(panel, row), row.unknowns,
                             law_note(panel, row)));
  }
  if (unreached.empty()) return;
  const Row& nearest = panel.rows[front.back()];
  to.push_back(fmt::format("No run came below {}; nearest is {}, {}{}.", unreached.front(), name_of(nearest),
                           figures(panel, nearest), law_note(panel, nearest)));
}

void say_fewest_unknowns(const Panel& panel, std::vector<std::string>& to) {
  const Row* fewest = nullptr;
  for (const Row& row : panel.rows)
    if (std::isfinite(panel.time(row)) && row.error <= 0.01 && (!fewest || row.unknowns < fewest->unknowns))
      fewest = &row;
  if (!fewest || panel.in_motion) return;
  to.push_back(
      fmt::format("The fewest unknowns that reach 1 % are the {} of {}.", fewest->unknowns, name_of(*fewest)));
}

// What the program does unless told otherwise: the first method and space of the table.
void say_default(const Panel& panel, const std::vector<std::size_t>& front, std::vector<std::string>& to) {
  const Row& first = panel.rows.front();
  const Row* best = nullptr;
  for (const Row& row : panel.rows)
    if (row.method() == first.method() && row.space == first.space && std::isfinite(panel.time(row)) &&
        (!best || row.error < best->error))
      best = &row;
  if (!best) {
    to.push_back(
        fmt::format("{} in {} space, the first of the list, has no good run here.", first.method(), first.space));
    return;
  }
  const std::string what = fmt::format("{} in {} space", first.method(), first.space);
  for (const std::size_t i : front) {
    const Row& row = panel.rows[i];
    if (&row == best) {
      to.push_back(fmt::format("The best of {}, {}, lies on the front.", what, figures(panel, row)));
      return;
    }
    if (judged_error(panel, row) > judged_error(panel, *best)) continue;
    const double ratio = panel.time(*best) / panel.time(row);
    to.push_back(fmt::format("The best of {} has {}; {} is as accurate {}{}.", what, figures(panel, *best),
                             name_of(row), ratio < 1.05 ? "and as fast" : fmt::format("{:.1f} times faster", ratio),
                             law_note(panel, row)));
    return;
  }
}

void say_laws(const Panel& panel, std::vector<std::string>& to) {
  std::map<std::string, double> least;
  bool any_same = false;
  for (const Row& row : panel.rows) {
    if (!std::isfinite(panel.time(row))) continue;
    any_same = any_same || row.same_law;
    if (row.same_law) continue;
    const auto [at, fresh] = least.emplace(row.model, row.error);
    if (!fresh) at->second = std::min(at->second, row.error);
  }
  if (least.empty()) return;
  std::vector<std::string> words;
  for (const auto& [model, error] : least) words.push_back(fmt::format("{} {}", model, percent_text(error)));
  to.push_back(fmt::format(
      "{} the difference between the models is part of the error, which came down to {}.",
      any_same ? "Of the methods drawn hollow" : "The reference holds for another law than every model here, so",
      joined(words)));
}

void say_lucky(const Panel& panel, std::vector<std::string>& to) {
  std::vector<std::string> names;
  for (const Series& s : series(panel)) {
    bool low = false, high = false;
    for (const std::size_t i : s.rows) {
      const Row& row = panel.rows[i];
      if (std::abs(row.signed_error) <= std::max(panel.uncertainty, 1e-2 * row.error)) continue;
      (row.signed_error < 0 ? low : high) = true;
    }
    const Row& row = panel.rows[s.rows.front()];
    if (low && high) names.push_back(fmt::format("{} in {} space", row.method(), row.space));
  }
  if (names.empty()) return;
  const std::size_t shown = std::min<std::size_t>(4, names.size());
  std::vector<std::string> first(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown));
  if (shown < names.size()) first.push_back(fmt::format("{} more", names.size() - shown));
  to.push_back(fmt::format("The error changes its sign along the way for {}: its smallest values there are luck.",
                           joined(first)));
}

void say_failures(const Panel& panel, std::vector<std::string>& to) {
  struct Group {
    std::string method;
    Status status;
    std::string message;
    std::vector<const Row*> rows;
  };
  std::vector<Group> groups;
  std::map<std::string, std::size_t> tried;
  for (const Row& row : panel.rows) {
    ++tried[row.method()];
    if (row.status == Status::ok) continue;
    auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return g.method == row.method() && g.status == row.status &&
             (row.status == Status::diverged || g.message == row.message);
    });
    if (found == groups.end()) found = groups.insert(groups.end(), {row.method(), row.status, row.message, {}});
    found->rows.push_back(&row);
  }
  for (const Group& g : groups) {
    std::vector<std::string> where;
    for (const Row* row : g.rows) {
      std::string place = fmt::format("{} {}", row->space, row->resolution);
      if (std::isfinite(row->time_step)) place += ", " + time_step_text(row->time_step);
      if (where.size() < 4) where.push_back(place);
    }
    if (g.rows.size() > where.size()) where.push_back("…");
    std::string places;
    for (const std::string& place : where) places += (places.empty() ? "" : "; ") + place;
    std::string status = word(g.status);
    std::replace(status.begin(), status.end(), '_', ' ');
    to.push_back(fmt::format("{}: {} of {} runs {} ({}): {}", g.method, g.rows.size(), tried[g.method], status,
                             places, g.message));
  }
}

}  // namespace

Findings findings(const Panel& panel) {
  Findings result;
  const std::vector<std::size_t> front = pareto_front(panel);
  if (front.empty()) {
    result.choice.push_back("No run of this problem came nearer than the size of the answer itself.");
  } else {
    say_fastest(panel, front, result.choice);
    say_fewest_unknowns(panel, result.choice);
    say_default(panel, front, result.choice);
    say_laws(panel, result.choice);
    say_lucky(panel, result.choice);
  }
  say_failures(panel, result.failures);
  return result;
}

}  // namespace argil::chart
