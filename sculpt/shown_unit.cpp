#include "sculpt/shown_unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace argil::sculpt {

ShownUnit shown_unit(const std::string& unit, double largest) {
  if (unit == "%") return {100, "%"};
  constexpr std::array<std::string_view, 8> takes_prefix{"Pa", "N", "J", "m", "s", "W", "N/m", "m/s"};
  if (!(largest > 0) || std::find(takes_prefix.begin(), takes_prefix.end(), unit) == takes_prefix.end())
    return {1, unit};
  constexpr std::array<const char*, 9> prefixes{"p", "n", "µ", "m", "", "k", "M", "G", "T"};
  const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(largest * 1.0000001) / 3)), -4, 4);
  return {std::pow(1000.0, -thousands), prefixes[static_cast<std::size_t>(thousands + 4)] + unit};
}

std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  const double largest = std::max(std::abs(value), step);
  std::string text;
  if (largest >= 1e6 || largest < 1e-4)
    text = fmt::format("{:.3g}", value);
  else
    text = fmt::format("{:.{}f}", value, std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12));
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

}  // namespace argil::sculpt
