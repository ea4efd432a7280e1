#pragma once
// The methods by which time advances (METHODS §5), in one table that sessions, charts and help read.

#include <span>
#include <string_view>

namespace argil::fem {

enum class Method {
  bdf2,
  implicit_euler,
  semi_implicit,
  generalised_alpha,
  central_difference,
  forward_euler,
  symplectic_euler,
  velocity_verlet,
  midpoint,
  published
};

struct MethodKind {
  Method method;
  std::string_view name;             // as in a session
  std::string_view summary;          // what it is and where it fails, without a full stop
  int order = 1;                     // of the error at the end of a fixed time; 0: some of it stays at any step
  bool is_implicit = true;           // solves with the stiffness
  bool of_published_method = false;  // with the force model of that mark it makes up papers/004's method
};

/// Those that an Integrator has; the default first.
[[nodiscard]] std::span<const MethodKind> method_table();
/// @throws Error (not_found) that lists the names.
[[nodiscard]] const MethodKind& method_by_name(std::string_view name);
[[nodiscard]] const MethodKind& method_kind(Method method);
/// Where in a step the method balances forces, as a share of the step: dead loads that change with time are to be
/// taken there. `spectral_radius` is that of generalised-α.
[[nodiscard]] double load_share(Method method, double spectral_radius);

}  // namespace argil::fem
