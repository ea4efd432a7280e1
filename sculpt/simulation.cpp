#include "sculpt/simulation.h"

#include "sculpt/commands/edit.h"

namespace argil::sculpt {

void require_simulation(Session& session) {
  require_solid(session);
  check_discretization(session);
}

void simulation_step(Session& session, const std::vector<fem::AnchorSpring>& tool_springs, double time_step) {
  Document& document = session.document();
  const fem::Clock clock = session.options().clock;
  const double begin = clock ? clock() : 0;
  State next = document.state();
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  fem::Loads loads = document.loads();
  loads.springs.insert(loads.springs.end(), tool_springs.begin(), tool_springs.end());
  fem::StepOptions options;
  options.method = next.method;
  options.newton_cap = next.newton_cap;
  const fem::StepReport report = document.integrator().step(loads, *motion, time_step, options, clock);
  next.motion = motion;
  document.assign(std::move(next));
  StepRecord record;
  record.newton_iterations = report.newton_iterations;
  record.linear_iterations = report.linear_iterations;
  record.converged = report.converged;
  record.residual = report.residual;
  record.ms = clock ? 1e3 * (clock() - begin) : 0;
  record.ms_forces = report.ms_forces;
  record.ms_tangent = report.ms_tangent;
  record.ms_solve = report.ms_solve;
  record.ms_line_search = report.ms_line_search;
  session.step_done(record, tool_springs);
}

}  // namespace argil::sculpt
