#include "fem/solvers/solver_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "fem/solvers/supernodal.h"

namespace argil::fem {

PreconditionerKind choose_solver(const SolverInputs& inputs) {
  if (inputs.unknowns <= k_largest_factor) return PreconditionerKind::factor;
  const bool hard = inputs.contrast > k_largest_contrast || inputs.stiffness_number > k_largest_stiffness_number;
  return hard && has_supernodal() ? PreconditionerKind::supernodal : PreconditionerKind::jacobi;
}

std::string solver_rule() {
  if (!has_supernodal())
    return fmt::format(
        "dense factor of the rest operator up to {} unknowns, else block Jacobi (this build has no CHOLMOD, which "
        "would factor stiff bodies; install libsuitesparse-dev and libopenblas0-serial and configure again)",
        k_largest_factor);
  return fmt::format(
      "dense factor of the rest operator up to {} unknowns; beyond, supernodal Cholesky of it where the stiffness "
      "contrast is over {:g} or E dt^2/(rho h^2) over {:g}, else block Jacobi",
      k_largest_factor, k_largest_contrast, k_largest_stiffness_number);
}

double stiffness_contrast(const System& system) {
  double low = std::numeric_limits<double>::max(), high = 0;
  for (const ElementBlock& block : system.blocks)
    for (const double mu : block.mu) {
      if (mu <= 0) continue;
      low = std::min(low, mu);
      high = std::max(high, mu);
    }
  return high > 0 ? high / low : 1;
}

double stiffness_number(const System& system, const RestOperator& rest, double mass_divisor,
                        const std::vector<std::uint8_t>& free) {
  if (mass_divisor <= 0) return std::numeric_limits<double>::infinity();
  std::vector<double> numbers;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    const double mass = system.mass->coeff(c, c);
    if (!free[i] || mass <= 0) continue;
    numbers.push_back(rest.diagonal[i].trace() / 3 * mass_divisor / mass);
  }
  if (numbers.empty()) return 0;
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

}  // namespace argil::fem
