#include "tools/chart/log_axis.h"

#include <algorithm>
#include <cmath>

namespace argil::chart {

LogAxis::LogAxis(double low, double high, double begin, double end) : begin_(begin), end_(end) {
  const double middle = 0.5 * (std::log10(low) + std::log10(high));
  const double half = std::max(0.5, 0.5 * (std::log10(high) - std::log10(low)) + 0.1);
  low_ = std::pow(10, middle - half);
  high_ = std::pow(10, middle + half);
}

double LogAxis::place(double value) const {
  return begin_ + (end_ - begin_) * std::log(value / low_) / std::log(high_ / low_);
}

std::vector<double> LogAxis::multiples(bool labelled) const {
  const int first = static_cast<int>(std::floor(std::log10(low_))),
            last = static_cast<int>(std::ceil(std::log10(high_)));
  int decades = 0;
  for (int d = first; d <= last; ++d) decades += holds(std::pow(10.0, d)) ? 1 : 0;
  std::vector<double> values;
  for (int d = first; d <= last; ++d)
    for (int m = 1; m <= 9; ++m) {
      const double value = m * std::pow(10.0, d);
      const bool has_label = m == 1 || (decades < 3 && (m == 2 || m == 5));
      if (has_label == labelled && holds(value)) values.push_back(value);
    }
  return values;
}

std::vector<double> LogAxis::ticks() const {
  return multiples(true);
}

std::vector<double> LogAxis::minor() const {
  return multiples(false);
}

}  // namespace argil::chart
