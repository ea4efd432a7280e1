#include "sculpt/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sculpt/commands/edit.h"
#include "sculpt/document_loads.h"
#include "sculpt/force_tools/force_tool.h"
#include "sculpt/obstacles.h"

namespace argil::sculpt {

void require_simulation(Session& session) {
  require_solid(session);
  check_discretization(session);
}

namespace {

fem::StepOptions step_options(const State& state) {
  fem::StepOptions options;
  options.method = state.method;
  options.newton_cap = state.newton_cap;
  options.newton_tolerance = state.newton_tolerance;
  options.line_search = state.line_search;
  options.spectral_radius = state.spectral_radius;
  return options;
}

const char* cause_of(fem::GuardFinding finding) {
  switch (finding) {
    case fem::GuardFinding::not_finite:
      return "values that were not finite";
    case fem::GuardFinding::energy:
      return "energy that came from nowhere";
    case fem::GuardFinding::inversion:
      return "cells that turned inside out";
    case fem::GuardFinding::none:
      break;
  }
  return "nothing";
}

/// Takes the body that has moved on, and lets it flow for `length` [s].
void take_motion(Document& document, State next, const fem::BodyState& motion, double length) {
  next.motion = std::make_shared<fem::BodyState>(motion);
  std::shared_ptr<fem::PlasticFlow> flow;
  if (next.plasticity.on && !next.guard.frozen) {
    const fem::Discretization& d = document.discretization();
    const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, motion.positions);
    flow = next.flow ? std::make_shared<fem::PlasticFlow>(*next.flow) : std::make_shared<fem::PlasticFlow>();
    if (fem::flow(d.blocks, nodes, next.plasticity.law, length, *flow).points == 0) flow = nullptr;
  }
  if (!flow) {
    document.assign(std::move(next));
    return;
  }
  // What the flow takes is what the law itself loses by it; the next step would ask for the same energies.
  const double stored = document.integrator_at(motion.time).elastic_energy(motion.positions);
  next.flow = flow;
  document.assign(next);
  next.lost.flow += stored - document.integrator_at(motion.time).elastic_energy(motion.positions);
  document.assign(std::move(next));
}

/// Loads of a step from there, without those of a tool, taken where the method balances them. Pressure acts on the
/// surface as it will be then if it goes on as it does.
fem::Loads loads_of_step(const Document& document, const fem::BodyState& motion, double length) {
  const State& state = document.state();
  const double until = fem::load_share(state.method, state.spectral_radius) * length, time = motion.time + until;
  fem::Loads loads = state.loads->pressures.empty()
                         ? document.loads_at(time)
                         : document.loads_at(time, motion.positions + until * motion.velocities);
  loads.contact = contact_at(document, motion.time + length);
  if (!state.pins->motions.empty()) loads.led = led_points(*state.pins, motion, motion.time + length);
  return loads;
}

bool has_friction(const fem::Loads& loads) {
  return loads.contact && std::ranges::any_of(loads.contact->obstacles,
                                              [](const fem::Obstacle& obstacle) { return obstacle.friction > 0; });
}

}  // namespace

void simulation_step(Session& session, const fem::Loads& tool, double time_step) {
  Document& document = session.document();
  const fem::Clock clock = session.options().clock;
  const double begin = clock ? clock() : 0;
  const State before = document.state();
  State next = before;
  fem::BodyState motion = *next.motion;
  fem::StepOptions options = step_options(next);
  options.progress = session.progress_of("solving");
  const double load_share = fem::load_share(next.method, next.spectral_radius);
  const bool was_frozen = next.guard.frozen;
  StepRecord record;
  const double length = time_step / next.substeps;
  try {
    for (int part = 0; part < next.substeps; ++part) {
      fem::Loads loads = loads_of_step(document, motion, length);
      add_loads(loads, tool);
      // Keyed prestress is taken with the loads.
      fem::Integrator& integrator = document.integrator_at(motion.time + load_share * length);
      const fem::BodyState before_part = has_friction(loads) ? motion : fem::BodyState{};
      if (next.guard_on) {
        const fem::GuardedReport report =
            fem::guarded_step(integrator, loads, motion, next.guard, length, options, clock);
        fem::append(record.report, report.step);
        record.substeps = std::max(record.substeps, report.substeps);
        if (report.finding != fem::GuardFinding::none) record.finding = report.finding;
        record.remedy = std::max(record.remedy, report.remedy);
        record.share = std::min(record.share, report.share);
      } else {
        fem::append(record.report, integrator.step(loads, motion, length, options, clock));
      }
      if (has_friction(loads)) next.lost.friction += fem::friction_loss(*loads.contact, before_part, motion);
      take_motion(document, next, motion, length);
      next = document.state();
    }
  } catch (...) {
    document.assign(before);
    throw;
  }
  const bool frozen_now = next.guard.frozen && !was_frozen, thawed_now = was_frozen && !next.guard.frozen;
  const fem::GuardFinding cause = next.guard.cause;
  record.ms = clock ? 1e3 * (clock() - begin) : 0;
  session.step_done(record, tool);
  if (frozen_now)
    session.print(
        fmt::format("the body is frozen at {:.6g} s: {} steps could not be saved from {}; undo, lower the "
                    "loads, step less far or choose another integrator or model, then `guard thaw`; it is tried "
                    "again by itself when less than half of what acts on it is left",
                    motion.time, fem::k_guard_failures, cause_of(cause)));
  if (thawed_now)
    session.print(fmt::format("the body moves again from {:.6g} s on, with less than half of what froze it",
                              motion.time - time_step));
}

void report_guard(const Session& session, std::size_t first_step) {
  std::array<std::size_t, fem::k_guard_findings.size()> findings{};
  std::array<std::size_t, fem::k_guard_remedies.size()> remedies{};
  std::size_t steps = 0;
  double share = 1;
  for (std::size_t i = first_step; i < session.steps().size(); ++i) {
    const StepRecord& record = session.steps()[i];
    if (record.remedy == fem::GuardRemedy::none) continue;
    ++steps;
    share = std::min(share, record.share);
    for (std::size_t k = 0; k < findings.size(); ++k) findings[k] += record.finding == fem::k_guard_findings[k];
    for (std::size_t k = 0; k < remedies.size(); ++k) remedies[k] += record.remedy == fem::k_guard_remedies[k];
  }
  if (steps == 0) return;
  std::string causes, helped;
  for (std::size_t k = 0; k < findings.size(); ++k)
    if (findings[k])
      causes +=
          fmt::format("{}{} from {}", causes.empty() ? "" : ", ", findings[k], cause_of(fem::k_guard_findings[k]));
  static constexpr std::array k_help{"saved by substeps",
                                     "by more Newton iterations",
                                     "by implicit Euler",
                                     "with loads eased",
                                     "from rest with loads eased",
                                     "from rest with cells held",
                                     "moved as a whole",
                                     "taken back",
                                     "passed frozen"};
  static_assert(k_help.size() == fem::k_guard_remedies.size());
  for (std::size_t k = 0; k < remedies.size(); ++k)
    if (remedies[k]) helped += fmt::format("{}{} {}", helped.empty() ? "" : ", ", remedies[k], k_help[k]);
  if (share < 1) helped += fmt::format("; eased: as little as {:.2g} of the force out of balance acted", share);
  session.print(fmt::format("guard: {} of {} steps{}{}: {}", steps, session.steps().size() - first_step,
                            causes.empty() ? "" : ", ", causes, helped));
}

}  // namespace argil::sculpt
