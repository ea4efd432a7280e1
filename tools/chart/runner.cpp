#include "tools/chart/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/hash.h"
#include "subdiv/error.h"
#include "tools/chart/commit.h"
#include "tools/chart/memory.h"
#include "tools/chart/watched_model.h"

namespace argil::chart {

namespace {

constexpr double k_short_run = 0.1;  // [s]
constexpr double k_bound = 100;      // times the body's size: a motion that goes farther has diverged

struct OverTime {};

double now(const Setting& setting) {
  return setting.clock ? setting.clock() : 0;
}

std::uint64_t hash_of(const fem::BodyState& state) {
  sculpt::Hash hash;
  for (const Eigen::Matrix3Xd* values : {&state.positions, &state.velocities})
    hash.add(std::span<const double>(values->data(), static_cast<std::size_t>(values->size())));
  return hash.value();
}

struct Outcome {
  std::vector<double> found, expected;
  double ms = 0;
  std::size_t steps = 0;
  bool diverged = false;
};

Outcome solve(const Problem& problem, Body& body, const Setting& setting) {
  const fem::Loads whole = problem.loads ? problem.loads(body) : fem::Loads{};
  Outcome outcome;
  const double begin = now(setting);
  fem::Integrator integrator(body.system);
  for (int step = 1; step <= problem.load_steps; ++step) {
    const double before = static_cast<double>(step - 1) / problem.load_steps;
    const double share = static_cast<double>(step) / problem.load_steps;
    if (problem.placed)
      for (Eigen::Index i = 0; i < body.rest.cols(); ++i) {
        const Eigen::Vector3d rest = body.rest.col(i);
        if (body.system.fixed[static_cast<std::size_t>(i)])
          body.state.positions.col(i) = problem.placed(rest, share);
        else
          body.state.positions.col(i) += problem.placed(rest, share) - problem.placed(rest, before);
      }
    fem::Loads loads = whole;
    loads.forces *= share;
    static_cast<void>(integrator.solve_static(loads, body.state, {}));
  }
  outcome.ms = 1e3 * (now(setting) - begin);
  outcome.steps = static_cast<std::size_t>(problem.load_steps);
  outcome.found = problem.measure(body, whole);
  outcome.expected = problem.reference(0);
  return outcome;
}

Outcome move(const Problem& problem, Body& body, const Run& run, const Setting& setting) {
  problem.start(body);
  fem::StepOptions options;
  options.method = run.integrator->method;
  const double size = (body.rest.rowwise().maxCoeff() - body.rest.rowwise().minCoeff()).norm();
  Outcome outcome;
  const auto take = [&] {
    for (const double value : problem.measure(body, {})) outcome.found.push_back(value);
    for (const double value : problem.reference(body.state.time)) outcome.expected.push_back(value);
  };
  const auto count = static_cast<std::size_t>(std::lround(problem.duration / run.time_step));
  double begin = now(setting);
  fem::Integrator integrator(body.system);
  for (; outcome.steps < count; ++outcome.steps) {
    static_cast<void>(integrator.step({}, body.state, run.time_step, options));
    const bool bounded = body.state.positions.allFinite() &&
                         (body.state.positions - body.rest).cwiseAbs().maxCoeff() < k_bound * size;
    if (!bounded) {
      outcome.diverged = true;
      break;
    }
    if (!problem.along_the_way) continue;
    outcome.ms += 1e3 * (now(setting) - begin);  // measuring is not the method's
    take();
    begin = now(setting);
  }
  outcome.ms += 1e3 * (now(setting) - begin);
  if (!outcome.diverged && !problem.along_the_way) take();
  return outcome;
}

Outcome vibrate(const Problem& problem, Body& body, const Setting& setting) {
  Outcome outcome;
  const double begin = now(setting);
  outcome.found = problem.measure(body, {});
  outcome.ms = 1e3 * (now(setting) - begin);
  outcome.steps = 1;
  outcome.expected = problem.reference(0);
  return outcome;
}

Outcome run_once(const Run& run, Body& body, const Setting& setting) {
  body.state = {};
  body.state.positions = body.rest;
  body.state.velocities.setZero(3, body.rest.cols());
  switch (run.problem->analysis) {
    case Analysis::equilibrium:
      return solve(*run.problem, body, setting);
    case Analysis::motion:
      return move(*run.problem, body, run, setting);
    case Analysis::vibration:
      return vibrate(*run.problem, body, setting);
  }
  return {};
}

Row blank(const Run& run, const Setting& setting) {
  Row row;
  row.key = key_of(run, setting);
  row.problem = run.problem->name;
  row.model = run.model->choice.name;
  row.formulation = fem::word(run.model->choice.formulation);
  if (run.integrator) row.integrator = run.integrator->name;
  row.space = run.space->name;
  row.resolution = run.resolution;
  if (run.time_step > 0) row.time_step = run.time_step;
  row.same_law = run.problem->holds_for(row.model);
  row.threads = setting.threads;
  row.version = ARGIL_VERSION;
  row.commit = commit();
  return row;
}

void fill(Row& row, const Run& run, Body& body, const Setting& setting) {
  const double begin = now(setting);
  Outcome best;
  for (int repeat = 0; repeat < std::max(1, setting.repeats); ++repeat) {
    Outcome outcome = run_once(run, body, setting);
    if (repeat == 0 || outcome.ms < best.ms) best = std::move(outcome);
    if (best.diverged || now(setting) - begin > k_short_run) break;
  }
  row.state_hash = hash_of(body.state);
  row.ms = best.ms;
  row.steps = best.steps;
  row.ms_per_step = best.ms / static_cast<double>(std::max<std::size_t>(1, best.steps));
  if (best.diverged) {
    row.status = Status::diverged;
    row.message = fmt::format("left all bounds after {} steps", best.steps + 1);
    return;
  }
  if (run.problem->analysis == Analysis::motion) row.ms_per_simulated_second = best.ms / run.problem->duration;
  row.error = relative_error(best.found, best.expected);
  row.signed_error = signed_error(best.found, best.expected);
  if (std::isfinite(row.error)) return;
  row.status = Status::diverged;
  row.message = "what is measured is not finite";
  row.error = row.signed_error = k_nothing;
}

}  // namespace

Lists all_lists() {
  const auto integrators = fem::method_table();
  return {problem_table(), models(), spaces(), {integrators.begin(), integrators.end()}};
}

std::string Run::label() const {
  std::string text = fmt::format("{}: {}", problem->name, model->name());
  if (integrator) text += fmt::format(", {} 1/{:.0f} s", integrator->name, 1 / time_step);
  return text + fmt::format(", {} {}", space->name, resolution);
}

std::vector<Run> plan(const Lists& lists, Breadth breadth) {
  const bool quick = breadth == Breadth::quick;
  std::vector<Run> runs;
  std::size_t deepest = 0;
  for (const Problem& problem : lists.problems) deepest = std::max(deepest, problem.resolutions.size());
  for (std::size_t depth = 0; depth < (quick ? std::min<std::size_t>(2, deepest) : deepest); ++depth)
    for (const Problem& problem : lists.problems) {
      if (depth >= problem.resolutions.size()) continue;
      if (quick && depth > 0 && problem.analysis == Analysis::motion)
        continue;  // there, time steps are what counts
      for (const ModelRow& model : lists.models)
        for (const SpaceRow& space : lists.spaces) {
          const bool usual_model = &model == &lists.models.front(), usual_space = &space == &lists.spaces.front();
          if (!space.has_hexahedra && model.choice.formulation != fem::Formulation::plain) continue;
          const bool as_published = model.of_published_method && space.of_published_method;
          if (quick && !usual_model && !usual_space && !as_published) continue;
          Run run{&problem, &model, &space, nullptr, problem.resolutions[depth], 0};
          if (problem.analysis != Analysis::motion) {
            runs.push_back(run);
            continue;
          }
          for (const fem::MethodKind& integrator : lists.integrators) {
            const bool usual_integrator = &integrator == &lists.integrators.front();
            const bool whole_scheme = model.of_published_method && integrator.of_published_method;
            if (breadth != Breadth::all && !usual_integrator && !usual_model && !whole_scheme) continue;
            if (quick && !usual_integrator && !usual_space && !(whole_scheme && as_published)) continue;
            if (quick && as_published && !whole_scheme) continue;
            run.integrator = &integrator;
            for (std::size_t i = 0; i < problem.time_steps.size(); i += quick ? 2 : 1) {
              run.time_step = problem.time_steps[i];
              runs.push_back(run);
            }
          }
        }
    }
  return runs;
}

std::uint64_t key_of(const Run& run, const Setting& setting) {
  const Problem& problem = *run.problem;
  sculpt::Hash hash;
  hash.add(std::string_view(problem.name)).add(std::string_view(problem.title));
  hash.add(std::string_view(problem.quantity)).add(std::string_view(problem.source));
  hash.add(problem.material.young_modulus).add(problem.material.poisson_ratio).add(problem.material.density);
  for (const double time : {0.0, 0.5 * problem.duration})
    for (const double value : problem.reference(time)) hash.add(value);
  hash.add(problem.duration).add(static_cast<std::uint64_t>(problem.load_steps));
  hash.add(std::string_view(run.model->choice.name)).add(fem::word(run.model->choice.formulation));
  hash.add(std::string_view(run.space->name)).add(static_cast<std::uint64_t>(run.space->level));
  hash.add(run.integrator ? run.integrator->name : std::string_view{});
  hash.add(static_cast<std::uint64_t>(run.resolution)).add(run.time_step);
  hash.add(static_cast<std::uint64_t>(setting.threads)).add(ARGIL_VERSION);
  return hash.value();
}

Row execute(const Run& run, const Setting& setting) {
  Row row = blank(run, setting);
  const double begin = now(setting);
  const auto check = [&] {
    if (setting.stopped && setting.stopped()) throw Stopped{};
    if (now(setting) - begin > setting.seconds_a_run) throw OverTime{};
  };
  bool made = false;
  try {
    check();
    const PeakMemory memory;
    ModelRow model = *run.model;
    model.make = [&](std::span<const fem::ElementBlock> blocks, const Eigen::Matrix3Xd& rest_nodes) {
      return watched(run.model->make(blocks, rest_nodes), check);
    };
    const std::unique_ptr<Body> body =
        make_body(run.problem->solid(run.resolution), *run.space, model, run.problem->material, run.problem->held);
    made = true;
    row.unknowns = body->unknowns();
    row.elements = body->element_count();
    fill(row, run, *body, setting);
    row.peak_bytes = memory.growth();
  } catch (const OverTime&) {
    row.status = Status::over_time;
    row.message = fmt::format("stopped after {:.0f} s", setting.seconds_a_run);
  } catch (const Error& error) {
    const bool moving = run.problem->analysis == Analysis::motion;
    const bool failed = made && error.code() == ErrorCode::not_converged;
    row.status = !failed ? Status::refused : (moving ? Status::diverged : Status::not_converged);
    row.message = error.what();
  }
  return row;
}

void execute(const std::vector<Run>& runs, const Setting& setting, Table& table,
             const std::function<void(std::size_t, const Run&, const Row*)>& tell) {
  const auto coarser_went_over_time = [&](const Row& row) {
    for (const Row& other : table.rows())
      if (other.status == Status::over_time && other.problem == row.problem && other.method() == row.method() &&
          other.space == row.space && other.version == row.version && other.resolution < row.resolution &&
          (std::isnan(row.time_step) || other.time_step >= row.time_step))
        return true;
    return false;
  };
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Row row = blank(runs[i], setting);
    if (table.find(row.key)) continue;
    if (tell) tell(i, runs[i], nullptr);
    if (coarser_went_over_time(row)) {
      row.status = Status::over_time;
      row.message = "a coarser one went over time";
    } else {
      row = execute(runs[i], setting);
    }
    table.add(row);
    if (tell) tell(i, runs[i], &row);
  }
}

}  // namespace argil::chart
