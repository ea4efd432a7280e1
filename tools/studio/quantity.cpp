#include "tools/studio/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>

#include "subdiv/error.h"

namespace argil::studio {

namespace {

struct Prefixed {
  const char* unit;   // of the field
  const char* shown;  // as written and shown
  double factor;
  double from;  // smallest value that is shown so; negative: only read
};

constexpr std::array k_units{Prefixed{"m", "µm", 1e-6, 0},
                             Prefixed{"m", "mm", 1e-3, 1e-4},
                             Prefixed{"m", "m", 1, 0.01},
                             Prefixed{"m", "km", 1e3, 1e4},
                             Prefixed{"m", "cm", 1e-2, -1},
                             Prefixed{"m", "um", 1e-6, -1},
                             Prefixed{"N", "mN", 1e-3, 0},
                             Prefixed{"N", "N", 1, 0.01},
                             Prefixed{"N", "kN", 1e3, 1e4},
                             Prefixed{"N", "MN", 1e6, 1e7},
                             Prefixed{"N", "GN", 1e9, 1e10},
                             Prefixed{"N/m", "N/m", 1, 0},
                             Prefixed{"N/m", "kN/m", 1e3, 1e4},
                             Prefixed{"N/m", "MN/m", 1e6, 1e7},
                             Prefixed{"N/m", "GN/m", 1e9, 1e10},
                             Prefixed{"N/m", "N/mm", 1e3, -1},
                             Prefixed{"Pa", "Pa", 1, 0},
                             Prefixed{"Pa", "kPa", 1e3, 1e3},
                             Prefixed{"Pa", "MPa", 1e6, 1e6},
                             Prefixed{"Pa", "GPa", 1e9, 1e9},
                             Prefixed{"kg/m^3", "kg/m³", 1, 0},
                             Prefixed{"kg/m^3", "kg/m^3", 1, -1},
                             Prefixed{"kg/m^3", "g/cm³", 1e3, -1},
                             Prefixed{"kg/m^3", "g/cm^3", 1e3, -1},
                             Prefixed{"s", "µs", 1e-6, 0},
                             Prefixed{"s", "ms", 1e-3, 1e-4},
                             Prefixed{"s", "s", 1, 0.1},
                             Prefixed{"s", "us", 1e-6, -1},
                             Prefixed{"s", "min", 60, -1},
                             Prefixed{"1/s", "1/s", 1, 0},
                             Prefixed{"1/s", "Hz", 1, -1},
                             Prefixed{"m/s²", "m/s²", 1, 0},
                             Prefixed{"m/s²", "m/s^2", 1, -1},
                             Prefixed{"m/s", "m/s", 1, 0},
                             Prefixed{"%", "%", 1, 0},
                             Prefixed{"°", "°", 1, 0},
                             Prefixed{"°", "deg", 1, -1},
                             Prefixed{"J", "mJ", 1e-3, 0},
                             Prefixed{"J", "J", 1, 0.1}};

const Prefixed* prefix_for(double value, const std::string& unit) {
  const Prefixed* best = nullptr;
  const double size = std::abs(value);
  for (const Prefixed& p : k_units)
    if (unit == p.unit && p.from >= 0 && (best == nullptr || size >= p.from * (1 - 1e-9))) best = &p;
  // Nothing is nothing in the plain unit.
  if (size == 0)
    for (const Prefixed& p : k_units)
      if (unit == p.unit && p.factor == 1) return &p;
  return best;
}

std::string three_digits(double value) {
  if (value == 0 || !std::isfinite(value)) return value == 0 ? "0" : "—";
  const int places = std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)), 0, 6);
  if (std::abs(value) >= 1e6 || std::abs(value) < 1e-4) return fmt::format("{:.3g}", value);
  std::string text = fmt::format("{:.{}f}", value, places);
  if (text.find('.') != text.npos) {
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& unit, const std::string& default_unit)
      : all_(text), left_(text), unit_(unit), default_unit_(default_unit) {}

  double whole() {
    const double value = sum();
    skip();
    if (!left_.empty()) fail(unit_.empty() ? "nothing more" : "a unit as " + unit_);
    if (!std::isfinite(value))
      throw Error(ErrorCode::bad_input, "expected a finite number; look for a division by 0");
    return has_unit_ ? value : value * factor_of(default_unit_);
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw Error(
        ErrorCode::bad_input,
        fmt::format("expected {} at '{}' of '{}'; write a number{}, as in {}", expected, left_, all_,
                    unit_.empty() ? "" : " with or without " + unit_, unit_ == "m" ? "2 mm or 1/3" : "1/3"));
  }
  void skip() {
    while (!left_.empty() && (left_.front() == ' ' || left_.front() == '\t')) left_.remove_prefix(1);
  }
  bool take(char c) {
    skip();
    if (left_.empty() || left_.front() != c) return false;
    left_.remove_prefix(1);
    return true;
  }
  double sum() {
    double value = product();
    for (;;) {
      if (take('+'))
        value += product();
      else if (take('-'))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    // A unit is that of all factors before it: 3/100 MPa is 0.03 MPa.
    double value = signed_power() * unit_here();
    for (;;) {
      if (take('*'))
        value *= signed_power();
      else if (take('/'))
        value /= signed_power();
      else
        return value;
      value *= unit_here();
    }
  }
  double signed_power() {
    if (take('-')) return -signed_power();
    if (take('+')) return signed_power();
    const double base = atom();
    return take('^') ? std::pow(base, signed_power()) : base;
  }
  double atom() {
    if (++depth_ > 100) fail("fewer parentheses");
    double value = 0;
    if (take('(')) {
      value = sum();
      if (!take(')')) fail("a closing parenthesis");
    } else {
      skip();
      const auto [end, failure] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
      if (failure != std::errc{}) fail("a number");
      left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
    }
    --depth_;
    return value;
  }
  // The longest unit that stands here: "m" must not be taken off "mm".
  double unit_here() {
    skip();
    const Prefixed* found = nullptr;
    for (const Prefixed& p : k_units)
      if (unit_ == p.unit && left_.starts_with(p.shown) &&
          (found == nullptr || std::string_view(p.shown).size() > std::string_view(found->shown).size()))
        found = &p;
    if (found == nullptr) return 1;
    left_.remove_prefix(std::string_view(found->shown).size());
    has_unit_ = true;
    return found->factor;
  }
  double factor_of(const std::string& shown) const {
    for (const Prefixed& p : k_units)
      if (unit_ == p.unit && shown == p.shown) return p.factor;
    return 1;
  }

  std::string_view all_, left_;
  std::string unit_, default_unit_;
  bool has_unit_ = false;
  int depth_ = 0;
};

}  // namespace

Quantity shown(double value, const std::string& unit) {
  if (unit == "%" && std::abs(value) < 1e-4) value = 0;  // of a body at rest only rounding is left
  const Prefixed* prefix = prefix_for(value, unit);
  if (prefix == nullptr) return {three_digits(value), unit};
  return {three_digits(value / prefix->factor), prefix->shown};
}

std::string editable(double value, const std::string& unit) {
  const Prefixed* prefix = prefix_for(value, unit);
  return fmt::format("{:.10g}", prefix != nullptr ? value / prefix->factor : value);
}

double parse_quantity(const std::string& text, const std::string& unit, const std::string& default_unit) {
  return Parser(text, unit, default_unit).whole();
}

}  // namespace argil::studio
