#pragma once
// Rows of a table as a chart shows them: panels (a problem each), series (a method in a space, coarse to fine) and
// the Pareto front (runs that no other beats in both time and error).

#include <string>
#include <vector>

#include "tools/chart/table.h"

namespace argil::chart {

struct Panel {
  std::string name;  // of its files: letters, digits, _
  std::string title, quantity, source;
  bool in_motion = false;  // times are per simulated second, else of the whole solve
  bool of_session = false;
  double uncertainty = 0;  // of the reference, relative
  std::vector<Row> rows;

  /// What a row is charted by [ms]; NaN if it did not end well.
  [[nodiscard]] double time(const Row& row) const;
};

/// An error as the front compares it: below the reference's own uncertainty all are alike.
[[nodiscard]] double judged_error(const Panel& panel, const Row& row);

struct Point {
  double time = 0, error = 0;
};
/// Which points no other beats: none is at least as good in both and better in one. Ascending in time; of equal
/// points the first. Cost O(n log n).
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<Point>& points);

/// Rows of the panel on its front, fastest first. What is off by as much as the answer itself does not count.
[[nodiscard]] std::vector<std::size_t> pareto_front(const Panel& panel);

/// One line of the chart: rows that differ in resolution (in motion: in the time step) only, coarse to fine.
struct Series {
  std::string colour_name;  // what the colour stands for: model, and integrator in motion
  std::string formulation, space;
  bool same_law = true;
  std::vector<std::size_t> rows;
};
[[nodiscard]] std::vector<Series> series(const Panel& panel);

/// "corotational b_bar, bdf2, cubic 2, 1/240 s": a run in words.
[[nodiscard]] std::string name_of(const Row& row);
/// 3.2 ms, 45 µs, 1.3 s.
[[nodiscard]] std::string time_text(double milliseconds);
/// 12 %, 0.034 %.
[[nodiscard]] std::string percent_text(double ratio);
/// 1/60 s where it is one over a whole number.
[[nodiscard]] std::string time_step_text(double seconds);

}  // namespace argil::chart
