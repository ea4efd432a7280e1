#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/document_loads.h"
#include "sculpt/obstacles.h"
#include "sculpt/region.h"
#include "sculpt/simulation.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

void set_integrator(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  next.method = fem::method_by_name(arguments.word("method")).method;
  next.newton_cap = static_cast<int>(arguments.integer("newton", next.newton_cap));
  next.newton_tolerance = arguments.number("tolerance", next.newton_tolerance);
  next.line_search = arguments.word("line_search", next.line_search ? "on" : "off") == "on";
  next.spectral_radius = arguments.number("spectral_radius", next.spectral_radius);
  next.substeps = static_cast<int>(arguments.integer("substeps", next.substeps));
  session.change(std::move(next));
}

void set_guard(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  const std::string& what = arguments.word("what");
  if (what == "thaw") {
    session.print(next.guard.frozen ? "the body moves again from where it stands"
                                    : "the body was not frozen; its failures are forgotten");
    next.guard = {};
  } else {
    next.guard_on = what == "on";
    if (!next.guard_on) next.guard = {};
  }
  session.change(std::move(next));
}

void step(Session& session, const Arguments& arguments) {
  require_simulation(session);
  const long count = arguments.integer("count", 1);
  session.require_steps(static_cast<double>(count));
  State first = session.document().state();
  const double time_step = arguments.number("dt", first.time_step);
  if (time_step != first.time_step)
    first.tick_carry = 0;  // what was left over was part of a step of another length
  first.time_step = time_step;
  session.document().assign(std::move(first));
  const std::size_t first_step = session.steps().size();
  for (long i = 0; i < count && !session.stop_requested(); ++i) simulation_step(session, {}, time_step);
  report_guard(session, first_step);
  session.change(session.document().state());
}

// A pressure that follows the surface is taken where that stands, until it stays there to this share of the size.
constexpr double k_still = 1e-9;
constexpr int k_pressure_rounds = 60;

/// The longest side of the box about some points, and the largest way between two places of a point [m].
double largest_way(const Eigen::Matrix3Xd& points) {
  return points.cols() == 0 ? 0 : (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff();
}
double largest_way(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  return from.cols() == 0 ? 0 : (to - from).cwiseAbs().maxCoeff();
}

void solve(Session& session, const Arguments&) {
  require_simulation(session);
  Document& document = session.document();
  State next = document.state();
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  fem::StepOptions options;
  options.linear_tolerance = 1e-9;
  options.newton_tolerance = 1e-8;
  options.progress = session.progress_of("finding the equilibrium");
  const bool follows = !next.loads->pressures.empty();
  fem::StepReport report;
  for (int round = 1;; ++round) {
    fem::Loads loads = document.loads_at(motion->time, motion->positions);
    loads.contact = contact_at(document, motion->time);
    const Eigen::Matrix3Xd before = motion->positions;
    fem::append(report, document.integrator().solve_static(loads, *motion, options, session.options().clock));
    if (!follows || largest_way(before, motion->positions) <= k_still * largest_way(document.rest())) break;
    if (round == k_pressure_rounds)
      throw Error(
          ErrorCode::not_converged,
          fmt::format("the surface under pressure has not come to rest in {} rounds of equilibrium; lower the "
                      "pressure, pin the body, or step in time with damping",
                      round));
  }
  session.print(fmt::format("equilibrium in {} Newton and {} linear iterations", report.newton_iterations,
                            report.linear_iterations));
  next.motion = motion;
  next.guard = {};
  session.change(std::move(next));
}

void commit(Session& session, const Arguments&) {
  require_simulation(session);
  Document& document = session.document();
  const double mass_before = document.discretization().total_mass;
  State next = document.state();
  // A force at a point stays with its matter, which has a new rest position.
  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  for (AppliedForce& force : loads->forces)
    if (force.at_point())
      force.point = fem::position(material_point(document, force.point).stencil, document.positions());
  next.loads = loads;
  next.rest = std::make_shared<Eigen::Matrix3Xd>(next.motion->positions);
  auto motion = std::make_shared<fem::BodyState>();
  motion->positions = next.motion->positions;
  motion->velocities = Eigen::Matrix3Xd::Zero(3, motion->positions.cols());
  motion->time = next.motion->time;
  motion->grips = next.motion->grips;
  next.motion = motion;
  next.flow = nullptr;
  next.guard = {};
  document.assign(next);
  check_discretization(session);
  session.print(fmt::format("the present shape is the rest shape now; mass {:.6g} → {:.6g} kg", mass_before,
                            document.discretization().total_mass));
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> simulation_commands() {
  std::vector<std::string> methods;
  std::string method_summaries;
  for (const fem::MethodKind& kind : fem::method_table()) {
    methods.emplace_back(kind.name);
    method_summaries += (method_summaries.empty() ? "" : " ") + fmt::format("{}: {}.", kind.name, kind.summary);
  }
  return {
      {.name = "integrator",
       .summary = "How time advances. " + method_summaries,
       .parameters = {{.name = "method",
                       .type = ArgumentType::word,
                       .help = "the method",
                       .positional = true,
                       .required = true,
                       .choices = methods},
                      {.name = "newton",
                       .type = ArgumentType::integer,
                       .help = "most Newton iterations a step",
                       .low = 1,
                       .high = 100},
                      {.name = "tolerance",
                       .help = "of Newton's method, as a share of the first residual",
                       .low = 1e-14,
                       .high = 1},
                      {.name = "line_search",
                       .type = ArgumentType::word,
                       .help = "of Newton's method; off takes whole steps, to show where they fail",
                       .choices = {"on", "off"}},
                      {.name = "spectral_radius",
                       .help = "of generalised_alpha: what is left after a step of what is too fast for it",
                       .low = 0,
                       .high = 1},
                      {.name = "substeps",
                       .type = ArgumentType::integer,
                       .help = "parts that every step is taken in",
                       .low = 1,
                       .high = 1000}},
       .example = "integrator bdf2 newton 3",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = set_integrator},
      {.name = "guard",
       .summary = "Watches every step for values that are not finite, energy from nowhere and cells turned inside "
                  "out; takes such a step back and tries substeps, more Newton iterations, then implicit Euler. If "
                  "these fail it eases: only a part of the force out of balance acts in this step, at last on the "
                  "body brought to rest, or with the cells held that would turn, or moves a free body as a whole. "
                  "A body that nothing helps three "
                  "times is frozen where it last stood well, until it is thawed or less than half is left of the "
                  "loads or the pull that froze it. All of it is printed and counted in the summary.",
       .parameters = {{.name = "what",
                       .type = ArgumentType::word,
                       .help = "on (as at the start), off, or thaw to let a frozen body move again",
                       .positional = true,
                       .required = true,
                       .choices = {"on", "off", "thaw"}}},
       .example = "guard thaw",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = set_guard},
      {.name = "step",
       .summary = "Advances time without a device.",
       .parameters = {{.name = "count",
                       .type = ArgumentType::integer,
                       .help = "steps",
                       .positional = true,
                       .low = 1,
                       .high = 1e7},
                      {.name = "dt",
                       .help = "length of a step, kept for what follows",
                       .unit = "s",
                       .low = 1e-9,
                       .high = 10}},
       .example = "step 10 dt 1/60",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "pin where x < 0.01", "gravity 0 0 -9.81"},
       .run = step},
      {.name = "solve",
       .summary = "Finds the static equilibrium under the loads and pins.",
       .parameters = {},
       .example = "solve",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "pin where x < 0.01",
                  "force 0 0 -1 where z > 0.09"},
       .run = solve},
      {.name = "commit",
       .summary = "Makes the present shape the rest shape; velocities are zero then and what has "
                  "flowed is forgotten, pins, loads and obstacles stay.",
       .parameters = {},
       .example = "commit",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "pin where x < 0.01", "force 0 0 -1 where z > 0.09",
                  "solve"},
       .run = commit},
  };
}

}  // namespace argil::sculpt
