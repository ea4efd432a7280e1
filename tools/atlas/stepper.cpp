#include "tools/atlas/stepper.h"

#include "fem/dynamics/integrator.h"

namespace argil::atlas {

namespace {

class IntegratorStepper final : public Stepper {
 public:
  IntegratorStepper(const fem::System& system, const fem::StepOptions& options)
      : integrator_(system), options_(options) {}
  void step(const fem::Loads& loads, fem::BodyState& state, double time_step) override {
    static_cast<void>(integrator_.step(loads, state, time_step, options_));
  }

 private:
  fem::Integrator integrator_;
  fem::StepOptions options_;
};

Integration integration(const fem::MethodKind& kind, const fem::StepOptions& options) {
  return {std::string(kind.name), kind.is_implicit,
          [options](const fem::System& system) { return std::make_unique<IntegratorStepper>(system, options); },
          kind.of_published_method};
}

}  // namespace

std::vector<Integration> integrations() {
  std::vector<Integration> result;
  for (const fem::MethodKind& kind : fem::method_table()) {
    fem::StepOptions options;
    options.method = kind.method;
    result.push_back(integration(kind, options));
  }
  return result;
}

Integration reference_integration() {
  fem::StepOptions options;
  options.method = fem::Method::bdf2;
  options.newton_cap = 30;
  options.newton_tolerance = 1e-6;
  options.linear_tolerance = 1e-6;
  return integration(fem::method_kind(fem::Method::bdf2), options);
}

}  // namespace argil::atlas
