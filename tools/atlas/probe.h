#pragma once
// One run of one method on one scene, and the criteria by which it is called stable, inaccurate or diverged.

#include <limits>
#include <map>
#include <memory>
#include <string>

#include "tools/atlas/outcome.h"
#include "tools/atlas/scene.h"
#include "tools/atlas/stepper.h"

namespace argil::atlas {

struct Criteria {
  /// Diverged: a value is not finite, or kinetic and potential energy exceed this times what the start held and the
  /// loads have done since (without the potential energy for a model that has none).
  double energy_factor = 10;
  /// Inaccurate: the largest distance from the reference, in the norm of the mass and over the largest displacement
  /// of the reference, exceeds this within the body's duration; or that holds fewer than two steps. After an
  /// inverted start it is called inaccurate if some quadrature point is inside out at the end.
  double error = 0.1;
  int least_steps = 120;      // taken in any case, to see instabilities grow
  int most_steps = 6000;      // and at most; errors are then measured over these
  int reference_steps = 300;  // in the body's duration, and twice that
};

struct ProbeResult {
  Outcome outcome = Outcome::stable;
  double error = std::numeric_limits<double>::quiet_NaN();  // NaN where it was not measured
  double energy_ratio = 0;                                  // largest, as the criterion says
  int steps = 0;
  double largest_stable_step = 0;  // 2/ω_max [s], 0 where unknown
  std::string note{};              // why, in words; no commas or line ends
};

/// A fine implicit run, extrapolated from `steps` and 2 `steps` of BDF2 to steps of no length, between its points
/// by cubic Hermite polynomials.
class Reference {
 public:
  /// @throws what the steps throw.
  Reference(const Body& body, int steps);
  Eigen::Matrix3Xd positions(double time) const;            // 0 ≤ time ≤ duration
  double largest_displacement() const { return largest_; }  // from rest, norm of the mass

 private:
  double step_ = 0, largest_ = 0;
  std::vector<Eigen::Matrix3Xd> positions_, velocities_;
};

/// Bodies and references that probes share, by model and scene. Not to be shared between threads.
class Workbench {
 public:
  explicit Workbench(const Criteria& criteria) : criteria_(criteria) {}
  /// `reference_model`: empty for the model itself.
  [[nodiscard]] ProbeResult run(const Scene& scene, const fem::ModelChoice& model, const Integration& integration,
                                const std::string& reference_model = {});

 private:
  const Body& body(const Scene& scene, const fem::ModelChoice& model);
  const Reference* reference(const Scene& scene, const fem::ModelChoice& model);

  Criteria criteria_;
  std::map<std::pair<std::uint64_t, std::string>, std::unique_ptr<Body>> bodies_;
  std::map<std::pair<std::uint64_t, std::string>, std::unique_ptr<Reference>> references_;  // null: it fails
};

}  // namespace argil::atlas
