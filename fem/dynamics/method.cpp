#include "fem/dynamics/method.h"

#include <fmt/format.h>

#include <cassert>

#include "subdiv/error.h"

namespace argil::fem {

std::span<const MethodKind> method_table() {
  static constexpr MethodKind table[] = {
      {Method::bdf2, "bdf2", "the default, second order, damps what is too fast for the step", 2, true},
      {Method::implicit_euler, "implicit_euler", "first order, damps strongly", 1, true},
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

}  // namespace argil::fem
