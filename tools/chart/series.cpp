#include "tools/chart/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace argil::chart {

double Panel::time(const Row& row) const {
  if (row.status != Status::ok || !std::isfinite(row.error)) return k_nothing;
  return in_motion ? row.ms_per_simulated_second : row.ms;
}

double judged_error(const Panel& panel, const Row& row) {
  return std::max(row.error, panel.uncertainty);
}

std::vector<std::size_t> pareto_front(const std::vector<Point>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(points[a].time, points[a].error) < std::tie(points[b].time, points[b].error);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || points[i].error < points[front.back()].error) front.push_back(i);
  return front;
}

std::vector<std::size_t> pareto_front(const Panel& panel) {
  std::vector<Point> points;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < panel.rows.size(); ++i) {
    const double time = panel.time(panel.rows[i]);
    if (!std::isfinite(time) || panel.rows[i].error >= 1) continue;
    points.push_back({time, judged_error(panel, panel.rows[i])});
    rows.push_back(i);
  }
  std::vector<std::size_t> front;
  for (const std::size_t i : pareto_front(points)) front.push_back(rows[i]);
  return front;
}

std::vector<Series> series(const Panel& panel) {
  std::vector<Series> result;
  for (std::size_t i = 0; i < panel.rows.size(); ++i) {
    const Row& row = panel.rows[i];
    if (!std::isfinite(panel.time(row))) continue;
    const auto fits = [&](const Series& s) {
      const Row& first = panel.rows[s.rows.front()];
      return first.method() == row.method() && first.space == row.space &&
             (!panel.in_motion || panel.of_session || first.resolution == row.resolution);
    };
    auto found = std::find_if(result.begin(), result.end(), fits);
    if (found == result.end()) {
      Series made;
      made.colour_name = row.model;
      if (panel.in_motion && !row.integrator.empty()) made.colour_name += ", " + row.integrator;
      made.formulation = row.formulation;
      made.space = row.space;
      made.same_law = row.same_law;
      found = result.insert(result.end(), made);
    }
    found->rows.push_back(i);
  }
  for (Series& s : result)
    std::stable_sort(s.rows.begin(), s.rows.end(), [&](std::size_t a, std::size_t b) {
      const Row &x = panel.rows[a], &y = panel.rows[b];
      if (x.resolution != y.resolution) return x.resolution < y.resolution;
      return x.time_step > y.time_step;  // false where there is none
    });
  return result;
}

std::string name_of(const Row& row) {
  std::string text = fmt::format("{}, {} {}", row.method(), row.space, row.resolution);
  if (std::isfinite(row.time_step)) text += ", " + time_step_text(row.time_step);
  return text;
}

std::string time_text(double milliseconds) {
  const double size = std::abs(milliseconds);
  if (size >= 1e3) return fmt::format("{:.3g} s", milliseconds / 1e3);
  if (size >= 1) return fmt::format("{:.3g} ms", milliseconds);
  return fmt::format("{:.3g} µs", milliseconds * 1e3);
}

std::string percent_text(double ratio) {
  const double percent = 100 * ratio;
  if (percent >= 1e6 || (percent != 0 && percent < 1e-4)) return fmt::format("{:.1e} %", percent);
  if (percent >= 100) return fmt::format("{:.0f} %", percent);
  return fmt::format("{:.3g} %", percent);
}

std::string time_step_text(double seconds) {
  const double inverse = std::round(1 / seconds);
  if (std::abs(inverse * seconds - 1) < 1e-9) return fmt::format("1/{:.0f} s", inverse);
  return fmt::format("{:.3g} s", seconds);
}

}  // namespace argil::chart
