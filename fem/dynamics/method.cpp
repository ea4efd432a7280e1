#include "fem/dynamics/method.h"

#include <fmt/format.h>

#include <cassert>

#include "subdiv/error.h"

namespace argil::fem {

std::span<const MethodKind> method_table() {
  static constexpr MethodKind table[] = {
      {Method::bdf2, "bdf2", "the default, second order, damps what is too fast for the step", 2, true},
      {Method::implicit_euler, "implicit_euler", "first order, damps strongly", 1, true},
      {Method::semi_implicit, "semi_implicit",
       "implicit Euler with one linear solve from where the body is, first order, brakes a spin and fails where "
       "the "
       "step turns or strains much",
       1, true},
      {Method::generalised_alpha, "generalised_alpha",
       "second order, damps what is too fast for the step by a chosen share and little else, may ring at great "
       "strain",
       2, true},
      {Method::central_difference, "central_difference",
       "as published, stiffness explicit, second order, diverges above a step of 2 over the highest frequency", 2,
       false},
      {Method::forward_euler, "forward_euler", "explicit, first order, gains energy at any step", 1, false},
      {Method::symplectic_euler, "symplectic_euler",
       "explicit, first order, keeps energy in the mean, diverges above a step of 2 over the highest frequency", 1,
       false},
      {Method::velocity_verlet, "velocity_verlet",
       "explicit, second order, keeps energy in the mean, diverges above a step of 2 over the highest frequency", 2,
       false},
      {Method::midpoint, "midpoint", "explicit, second order, gains energy at any step", 2, false},
      {Method::published, "published",
       "central difference as papers/004 takes it: each step in parts of 0.4 of the largest stable one, all motion "
       "damped by a tenth of the highest frequency; runs at any step, slow where the body is stiff, and sluggish",
       0, false, true},
  };
  return table;
}

const MethodKind& method_by_name(std::string_view name) {
  std::string names;
  for (const MethodKind& kind : method_table()) {
    if (kind.name == name) return kind;
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not an integrator; there are {}", name, names));
}

const MethodKind& method_kind(Method method) {
  for (const MethodKind& kind : method_table())
    if (kind.method == method) return kind;
  assert(false && "a method that no integrator has");
  return method_table().front();
}

double load_share(Method method, double spectral_radius) {
  switch (method) {
    case Method::bdf2:
    case Method::implicit_euler:
    case Method::semi_implicit:
      return 1;
    case Method::generalised_alpha:
      return 1 / (1 + spectral_radius);  // 1 − α_f
    case Method::velocity_verlet:        // a trapezoid of two evaluations, to second order
    case Method::midpoint:
    case Method::published:  // in many parts
      return 0.5;
    case Method::central_difference:
    case Method::forward_euler:
    case Method::symplectic_euler:
      return 0;
  }
  return 1;
}

}  // namespace argil::fem
