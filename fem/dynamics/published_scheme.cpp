// The scheme of papers/004 as a whole (METHODS §4): central difference with mass damping γ = 0.1 ω_max, in parts of
// 0.4 · 2/ω_max, ω_max of the pencil at rest. Its forces are not symmetric under rotation, so that without damping
// it diverges at any step; with it, motions slower than γ creep.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fem/dynamics/integrator_body.h"
#include "fem/spectrum/largest_frequency.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr double k_damping_share = 0.1;  // γ over ω_max
constexpr double k_step_share = 0.4;     // of the limit 2/ω_max
constexpr double k_most_parts = 500;     // of a step: what takes longer is better done by another method
constexpr double k_frequency_tolerance = 1e-3;

/// Takes the damping back however the step ends.
class AddedDamping {
 public:
  AddedDamping(double& rate, double value) : rate_(rate) { rate_ = value; }
  ~AddedDamping() { rate_ = 0; }
  AddedDamping(const AddedDamping&) = delete;
  AddedDamping& operator=(const AddedDamping&) = delete;

 private:
  double& rate_;
};

}  // namespace

const PublishedScheme& Integrator::Impl::published_scheme(const std::vector<AnchorSpring>& springs) {
  if (scheme && same_hold(scheme->springs, springs)) return *scheme;
  find_free();
  const bool moves = std::find(free.begin(), free.end(), 1) != free.end();
  const double highest = moves ? largest_frequency_at_rest(system, springs, k_frequency_tolerance).value : 0;
  scheme = {k_damping_share * highest, k_step_share * 2 / highest, springs};
  return *scheme;
}

StepReport Integrator::Impl::published_step(const Loads& loads, BodyState& state, double h,
                                            const StepOptions& options, Clock clock) {
  if (loads.contact && !loads.contact->obstacles.empty())
    throw Error(
        ErrorCode::unsupported,
        "the published integrator takes its step and damping from the stiffness of the body at rest, to which "
        "obstacles add; remove them, or choose another integrator");
  const double start = clock ? clock() : 0;
  const PublishedScheme& by = published_scheme(loads.springs);
  const double parts = std::max(1.0, std::ceil(h / by.longest_step * (1 - 1e-12)));
  if (!(parts <= k_most_parts))
    throw Error(
        ErrorCode::limit_exceeded,
        fmt::format("expected at most {:.0f} parts of a published step, found that {:.6g} s takes {:.3g} parts "
                    "of {:.3g} s; take shorter steps, a softer body or an implicit integrator",
                    k_most_parts, h, parts, by.longest_step));
  const AddedDamping damping(damping_rate, by.damping_rate);
  StepOptions part = options;
  part.method = Method::central_difference;
  BodyState next = state;
  StepReport report;
  report.ms_tangent = clock ? 1e3 * (clock() - start) : 0;
  for (int i = 0; i < static_cast<int>(parts); ++i) {
    options.progress.at(i / parts);
    append(report, explicit_step(loads, next, h / parts, part, clock));
  }
  next.time = state.time + h;
  state = std::move(next);
  return report;
}

}  // namespace argil::fem
