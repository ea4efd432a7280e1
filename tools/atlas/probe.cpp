#include "tools/atlas/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fem/measure/energy.h"
#include "subdiv/error.h"

namespace argil::atlas {

namespace {

double mass_norm(const fem::System& system, const Eigen::Matrix3Xd& values) {
  return std::sqrt(std::max(0.0, values.cwiseProduct(values * *system.mass).sum()));
}

/// What is in the body, and what may be.
class EnergyBudget {
 public:
  explicit EnergyBudget(const Body& body) : body_(body), has_energy_(body.system().model->promises().has_energy) {
    const double kinetic = fem::energy(body.system(), body.start()).kinetic;
    // The disturbance came after the start's energy was taken.
    allowed_ = std::max(body.start_energy(), kinetic);
    springs_ = spring_energy(body.start());
    const double size = (body.rest().rowwise().maxCoeff() - body.rest().rowwise().minCoeff()).norm();
    // A floor far below what anyone sees: rounding, as energy of the whole mass at a millionth of its own size a
    // period.
    double mass = 0;
    for (Eigen::Index i = 0; i < body.system().mass->outerSize(); ++i) mass += body.system().mass->col(i).sum();
    const double slow = 1e-6 * size / body.duration();
    floor_ = 0.5 * mass * slow * slow;
  }
  /// Energy in the body over what was put in.
  double ratio(const fem::BodyState& state) {
    double work = springs_ - spring_energy(state);
    if (body_.loads().forces.cols() > 0)
      work += body_.loads().forces.cwiseProduct(state.positions - body_.start().positions).sum();
    done_ = std::max(done_, work);
    const fem::Energy energy = fem::energy(body_.system(), state);
    const double inside = energy.kinetic + (has_energy_ ? energy.elastic : 0);
    return inside / (allowed_ + done_ + floor_);
  }

 private:
  double spring_energy(const fem::BodyState& state) const {
    double sum = 0;
    for (const fem::AnchorSpring& spring : body_.loads().springs)
      sum += 0.5 * spring.stiffness * (fem::held_point(spring, state.positions) - spring.target).squaredNorm();
    return sum;
  }
  const Body& body_;
  bool has_energy_;
  double allowed_ = 0, springs_ = 0, floor_ = 0, done_ = 0;
};

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '\n' || c == '"') c = ';';
  return text;
}

/// The time step is no part of a body, unless it says how fast it turns.
Scene without_step(Scene scene) {
  if (scene.motion == Motion::spin) {
    scene.rotation /= scene.time_step;
    scene.time_step = 1;
  } else {
    scene.time_step = 0;
  }
  return scene;
}

std::string model_key(const fem::ModelChoice& model) {
  return model.name + " " + std::string(fem::word(model.formulation));
}

constexpr std::size_t k_kept = 24;  // bodies and references at a time

}  // namespace

Reference::Reference(const Body& body, int steps) : step_(body.duration() / steps) {
  const auto run = [&](int halvings, const auto& keep) {
    const auto stepper = reference_integration().make(body.system());
    fem::BodyState state = body.start();
    keep(0, state);
    for (int i = 1; i <= steps << halvings; ++i) {
      stepper->step(body.loads(), state, step_ / (1 << halvings));
      if (i % (1 << halvings) == 0) keep(static_cast<std::size_t>(i >> halvings), state);
    }
  };
  run(0, [&](std::size_t, const fem::BodyState& state) {
    positions_.push_back(state.positions);
    velocities_.push_back(state.velocities);
  });
  // BDF2 is of second order: steps of half the length and Richardson's extrapolation.
  run(1, [&](std::size_t i, const fem::BodyState& state) {
    positions_[i] = (4 * state.positions - positions_[i]) / 3;
    velocities_[i] = (4 * state.velocities - velocities_[i]) / 3;
    largest_ = std::max(largest_, mass_norm(body.system(), positions_[i] - body.rest()));
  });
  if (!(largest_ > 0) || !std::isfinite(largest_))
    throw Error(ErrorCode::not_converged, "the reference does not move; errors have no measure");
}

Eigen::Matrix3Xd Reference::positions(double time) const {
  const double place = std::clamp(time / step_, 0.0, static_cast<double>(positions_.size() - 1));
  const std::size_t i = std::min(static_cast<std::size_t>(place), positions_.size() - 2);
  const double s = place - static_cast<double>(i), s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * positions_[i] + (s3 - 2 * s2 + s) * step_ * velocities_[i] +
         (3 * s2 - 2 * s3) * positions_[i + 1] + (s3 - s2) * step_ * velocities_[i + 1];
}

const Body& Workbench::body(const Scene& scene, const fem::ModelChoice& model) {
  const Scene fixed = without_step(scene);
  const auto key = std::pair{scene_hash(fixed), model_key(model)};
  if (const auto found = bodies_.find(key); found != bodies_.end()) return *found->second;
  if (bodies_.size() >= k_kept) bodies_.clear();
  return *(bodies_[key] = std::make_unique<Body>(fixed, model));
}

const Reference* Workbench::reference(const Scene& scene, const fem::ModelChoice& model) {
  const auto key = std::pair{scene_hash(without_step(scene)), model_key(model)};
  if (const auto found = references_.find(key); found != references_.end()) return found->second.get();
  if (references_.size() >= k_kept) references_.clear();
  std::unique_ptr<Reference> made;
  try {
    made = std::make_unique<Reference>(body(scene, model), criteria_.reference_steps);
  } catch (const Error&) {  // remembered as null
  }
  return (references_[key] = std::move(made)).get();
}

ProbeResult Workbench::run(const Scene& scene, const fem::ModelChoice& model, const Integration& integration,
                           const std::string& reference_model) {
  ProbeResult result;
  const auto end = [&](Outcome outcome, std::string note) {
    result.outcome = outcome;
    result.note = one_line(std::move(note));
    return result;
  };
  const Body* made = nullptr;
  try {
    made = &body(scene, model);
  } catch (const Error& error) {
    return end(Outcome::refused, error.what());
  }
  const Body& it = *made;
  const double dt = scene.time_step;
  if (it.largest_frequency() > 0) result.largest_stable_step = 2 / it.largest_frequency();

  const int measured = static_cast<int>(std::min(it.duration() / dt * (1 + 1e-9), 1e9));
  const int steps = std::clamp(measured, criteria_.least_steps, criteria_.most_steps);
  EnergyBudget budget(it);
  std::vector<std::pair<double, Eigen::Matrix3Xd>> seen;  // until the reference is needed
  const int stride = std::max(1, std::min(measured, steps) / 60);
  fem::BodyState state = it.start();
  try {
    const auto stepper = integration.make(it.system());
    for (int i = 1; i <= steps; ++i) {
      stepper->step(it.loads(), state, dt);
      result.steps = i;
      const double ratio = budget.ratio(state);
      if (!std::isfinite(ratio) || !state.positions.allFinite() || !state.velocities.allFinite()) {
        result.energy_ratio = std::numeric_limits<double>::infinity();
        return end(Outcome::diverged, fmt::format("not finite after {} steps", i));
      }
      result.energy_ratio = std::max(result.energy_ratio, ratio);
      if (ratio > criteria_.energy_factor)
        return end(Outcome::diverged, fmt::format("{:.3g} times the energy after {} steps", ratio, i));
      if (i <= measured && i % stride == 0) seen.emplace_back(i * dt, state.positions);
    }
  } catch (const Error& error) {
    if (error.code() == ErrorCode::not_converged) return end(Outcome::diverged, error.what());
    return end(Outcome::refused, error.what());
  }
  if (scene.motion == Motion::invert)
    return it.is_inverted(state.positions) ? end(Outcome::inaccurate, "still inside out at the end")
                                           : end(Outcome::stable, "");
  if (measured < 2) return end(Outcome::inaccurate, "fewer than two steps in the time that is measured");
  fem::ModelChoice judge = model;
  if (!reference_model.empty()) judge = {.name = reference_model};
  const Reference* fine = reference(scene, judge);
  if (!fine) return end(Outcome::inaccurate, "no reference: fine implicit steps fail as well");
  const Body& again = body(scene, model);  // making the reference may have put the body away
  result.error = 0;
  for (const auto& [time, positions] : seen)
    result.error = std::max(
        result.error, mass_norm(again.system(), positions - fine->positions(time)) / fine->largest_displacement());
  return result.error > criteria_.error
             ? end(Outcome::inaccurate, fmt::format("{:.3g} of the displacement off", result.error))
             : end(Outcome::stable, "");
}

}  // namespace argil::atlas
