#pragma once
// How time advances, as the atlas wants it: by name, one step at a time, without the guard that a session has. The
// methods come from fem::method_table(), so that a new one appears by itself; a test brings its own.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fem/system.h"

namespace argil::atlas {

class Stepper {
 public:
  virtual ~Stepper() = default;
  /// @throws argil::Error where the step fails.
  virtual void step(const fem::Loads& loads, fem::BodyState& state, double time_step) = 0;
};

struct Integration {
  std::string name;
  bool is_implicit = true;
  std::function<std::unique_ptr<Stepper>(const fem::System&)> make;
  bool of_published_method = false;  // as in fem::MethodKind
};

/// Every method of the table with the options that a session has by default.
[[nodiscard]] std::vector<Integration> integrations();
/// BDF2 with Newton's method run to convergence: what the reference is made with.
[[nodiscard]] Integration reference_integration();

}  // namespace argil::atlas
