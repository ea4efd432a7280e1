#pragma once
// A logarithmic axis: its range, from value to place, its ticks and minor grid.

#include <vector>

namespace argil::chart {

class LogAxis {
 public:
  /// Covers low … high (positive) from place `begin` to `end`, widened by a tenth of a decade on both sides and to
  /// one decade at least.
  LogAxis(double low, double high, double begin, double end);

  double low() const { return low_; }
  double high() const { return high_; }
  [[nodiscard]] double place(double value) const;
  [[nodiscard]] bool holds(double value) const { return value >= low_ && value <= high_; }
  /// Values with a label: the decades; where fewer than three lie within, 2 and 5 of each too.
  [[nodiscard]] std::vector<double> ticks() const;
  /// Values 2 … 9 of each decade that have no label.
  [[nodiscard]] std::vector<double> minor() const;

 private:
  [[nodiscard]] std::vector<double> multiples(bool labelled) const;
  double low_, high_, begin_, end_;
};

}  // namespace argil::chart
