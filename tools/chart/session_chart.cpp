#include "tools/chart/session_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sculpt/hash.h"
#include "sculpt/session.h"
#include "subdiv/boundary.h"
#include "subdiv/error.h"
#include "subdiv/limit.h"
#include "tools/chart/chart.h"
#include "tools/chart/commit.h"
#include "tools/chart/memory.h"

namespace argil::chart {

namespace {

constexpr int k_reference_substeps = 4;
constexpr double k_usual_time_step = 1.0 / 60;  // until a line says otherwise

bool simulates(const std::string& command) {
  return command == "step" || command == "solve" || command == "stroke";
}

// The lines that make the state, with the levels and time steps of this run.
struct Lines {
  std::vector<io::SessionLine> setup;
  std::string simulation;  // a session of its own
};

Lines rewritten(const SessionFile& session, const SessionRun* run) {
  Lines lines;
  lines.simulation = std::string(io::k_session_header) + "\n";
  const auto all = io::parse_session(session.text, session.path.string());
  bool has_levels = false, simulating = false;
  double time_step = k_usual_time_step;
  const auto add = [&](const io::SessionLine& line) {
    if (simulating)
      lines.simulation += line.text + "\n";
    else
      lines.setup.push_back(line);
  };
  for (io::SessionLine line : all) {
    if (sculpt::find_command(line).effect == sculpt::Effect::output) continue;
    const std::string name = line.tokens[0].text;  // the line may be written anew
    const auto rewrite = [&](const std::string& text) {
      line = io::parse_session_line(text, line.file, line.number);
    };
    if (simulates(name) && !simulating) {
      if (run && !has_levels)
        lines.setup.push_back(io::parse_session_line(fmt::format("levels {}", run->level), line.file, line.number));
      simulating = true;
    }
    if (run && name == "levels") {
      has_levels = true;
      rewrite(fmt::format("levels {}", run->level));
    }
    if (name == "step") {
      double count = 1;
      for (std::size_t i = 1; i < line.tokens.size(); ++i) {
        if (line.tokens[i].kind != io::TokenKind::number) continue;
        const std::string& before = line.tokens[i - 1].text;
        (before == "dt" ? time_step : count) = line.tokens[i].number;
      }
      if (run && run->substeps > 1)
        rewrite(fmt::format("step {:.0f} dt {}", count * run->substeps, time_step / run->substeps));
    }
    add(line);
  }
  if (!simulating)
    throw Error(ErrorCode::bad_input,
                "the session simulates nothing, so there is nothing to chart; add `solve`, `step` "
                "or a stroke",
                session.path.string());
  return lines;
}

std::string label(const SessionRun& run, bool moves) {
  std::string text = run.model;
  if (run.formulation != "plain") text += " " + run.formulation;
  if (moves) text += ", " + run.integrator;
  text += ", " + run.space + " " + std::to_string(run.level);
  return moves && run.substeps > 1 ? text + fmt::format(", {} substeps", run.substeps) : text;
}

struct CommonPoints {
  Eigen::Matrix3Xd present, rest;
};
CommonPoints common_points(const sculpt::Document& document, int level) {
  const sculpt::State& state = document.state();
  const subdiv::Refinement refinement = subdiv::refine_to_level(document.solid(), level, state.rules);
  const subdiv::Stencils limits =
      subdiv::compose(subdiv::limit_stencils(refinement.solid(), state.rules), refinement.stencils.back());
  const Eigen::Matrix3Xd present = subdiv::apply(limits, document.positions());
  const Eigen::Matrix3Xd rest = subdiv::apply(limits, document.rest());
  const auto surface = subdiv::boundary_surface(refinement.solid());
  CommonPoints points;
  const auto count = static_cast<Eigen::Index>(surface.vertex_from_surface.size());
  points.present.resize(3, count);
  points.rest.resize(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto v = static_cast<Eigen::Index>(surface.vertex_from_surface[static_cast<std::size_t>(i)].index());
    points.present.col(i) = present.col(v);
    points.rest.col(i) = rest.col(v);
  }
  return points;
}

double root_mean_square(const Eigen::Matrix3Xd& values) {
  double sum = 0;
  for (Eigen::Index i = 0; i < values.cols(); ++i) sum += values.col(i).squaredNorm();
  return std::sqrt(sum / static_cast<double>(std::max<Eigen::Index>(1, values.cols())));
}

std::vector<std::string> choices_of(const std::string& command) {
  const auto& parameters = sculpt::find_command(io::parse_session_line(command, command, 1)).parameters;
  return parameters.empty() ? std::vector<std::string>{} : parameters.front().choices;
}

bool wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<SessionRun> session_plan(const Replayed& own, const Choice& choice) {
  const SessionRun& base = own.run;
  const bool moves = own.steps > 0;
  std::vector<SessionRun> runs;
  for (int level = std::max(0, base.level - 1); level <= base.level; ++level) {
    const auto add = [&](SessionRun run, bool with_substeps) {
      run.level = level;
      runs.push_back(run);
      if (!with_substeps || !moves) return;
      run.substeps = 2;
      runs.push_back(run);
    };
    add(base, true);
    for (const ModelRow& model : models()) {
      SessionRun run = base;
      run.model = model.choice.name;
      run.formulation = fem::word(model.choice.formulation);
      const bool same = run.model == base.model && run.formulation == base.formulation;
      if (!same && wanted(choice.models, run.model)) add(run, false);
    }
    for (const std::string& space : choices_of("space")) {
      SessionRun run = base;
      run.space = space;
      if (space != base.space && wanted(choice.spaces, space)) add(run, false);
    }
    if (!moves) continue;
    for (const fem::MethodKind& integrator : fem::method_table()) {
      SessionRun run = base;
      run.integrator = integrator.name;
      if (run.integrator != base.integrator && wanted(choice.integrators, run.integrator)) add(run, true);
    }
  }
  return runs;
}

std::uint64_t key_of(const SessionFile& session, const SessionRun& run, const Setting& setting) {
  sculpt::Hash hash;
  hash.add("session").add(std::string_view(session.text)).add(std::string_view(run.model));
  hash.add(std::string_view(run.formulation))
      .add(std::string_view(run.space))
      .add(std::string_view(run.integrator));
  hash.add(static_cast<std::uint64_t>(run.level)).add(static_cast<std::uint64_t>(run.substeps));
  hash.add(static_cast<std::uint64_t>(setting.threads)).add(ARGIL_VERSION);
  return hash.value();
}

Row compared(Row row, const Replayed& found, const Replayed& reference) {
  row.unknowns = found.unknowns;
  row.elements = found.elements;
  row.steps = found.steps;
  row.time_step = found.time_step;
  row.ms = found.ms;
  row.state_hash = found.state_hash;
  row.ms_per_step = found.ms / static_cast<double>(std::max<std::size_t>(1, found.steps));
  if (found.simulated > 0) row.ms_per_simulated_second = found.ms / found.simulated;
  if (found.topology != reference.topology) {
    row.status = Status::refused;
    row.message = "the session builds another solid at this level, so there is nothing to compare";
    return row;
  }
  if (!found.points.allFinite()) {
    row.status = Status::diverged;
    row.message = "a position is not finite";
    return row;
  }
  const Eigen::Matrix3Xd moved = reference.points - reference.rest, off = found.points - reference.points;
  const double size = (reference.rest.rowwise().maxCoeff() - reference.rest.rowwise().minCoeff()).norm();
  const double displaced = root_mean_square(moved) > 1e-9 * size ? root_mean_square(moved) : size;
  row.error = root_mean_square(off) / displaced;
  double along = 0;
  for (Eigen::Index i = 0; i < off.cols(); ++i) along += off.col(i).dot(moved.col(i));
  row.signed_error = along / (displaced * displaced * static_cast<double>(off.cols()));
  return row;
}

}  // namespace

Replayed replay(const SessionFile& session, const SessionRun* run, int common_level, const Setting& setting,
                const std::filesystem::path& scratch) {
  const Lines lines = rewritten(session, run);
  const auto now = [&] { return setting.clock ? setting.clock() : 0.0; };
  const double begin = now();
  sculpt::SessionOptions options;
  options.read_root = session.path.parent_path();
  options.out = scratch;
  options.write_journal = false;
  options.clock = setting.clock;
  options.progress = [&](double, const std::string&) {
    if (setting.stopped && setting.stopped()) throw Stopped{};
    if (now() - begin > setting.seconds_a_run)
      throw Error(ErrorCode::limit_exceeded, fmt::format("stopped after {:.0f} s", setting.seconds_a_run));
  };
  if (run) {
    options.overrides["model"] = run->model + " formulation " + run->formulation;
    options.overrides["space"] = run->space;
    options.overrides["integrator"] = run->integrator;
  }
  sculpt::Session replaying(options);
  for (const io::SessionLine& line : lines.setup) replaying.run_line(line);
  const sculpt::Document& document = replaying.document();
  if (!document.empty()) static_cast<void>(document.discretization());  // a solve begins with the discretized body
  const double start = now();
  replaying.run_text(lines.simulation, session.path.string());

  Replayed result;
  result.ms = 1e3 * (now() - start);
  const sculpt::State& state = document.state();
  const auto space_names = choices_of("space");
  result.run.model = state.model.name;
  result.run.formulation = fem::word(state.model.formulation);
  result.run.space =
      run ? run->space : space_names.at(std::min(static_cast<std::size_t>(state.space), space_names.size() - 1));
  result.run.integrator = fem::method_kind(state.method).name;
  result.run.level = state.level;
  result.run.substeps = run ? run->substeps : 1;
  result.steps = replaying.steps().size();
  result.simulated = state.motion->time;
  if (result.steps > 0) result.time_step = state.time_step;
  result.topology = document.solid().topology_hash();
  result.state_hash = document.state_hash();
  const fem::Discretization& discretization = document.discretization();
  for (const fem::ElementBlock& block : discretization.blocks) result.elements += block.element_count();
  const auto fixed = document.system().fixed;
  result.unknowns = 3 * static_cast<std::size_t>(std::count(fixed.begin(), fixed.end(), std::uint8_t{0}));
  const CommonPoints points = common_points(document, std::min(common_level, state.level));
  result.points = points.present;
  result.rest = points.rest;
  return result;
}

Panel chart_session(const SessionFile& session, const Choice& choice, const Setting& setting, Table& table,
                    const std::filesystem::path& scratch,
                    const std::function<void(const std::string&, const Row*)>& tell) {
  if (tell) tell("the session as it is written", nullptr);
  Setting patient = setting;  // without these two there is no chart
  patient.seconds_a_run = 1e300;
  const Replayed own = replay(session, nullptr, 0, patient, scratch);
  const int common = std::max(0, own.run.level - 1);
  SessionRun finer = own.run;
  ++finer.level;
  finer.substeps = own.steps > 0 ? k_reference_substeps : 1;

  const std::vector<SessionRun> runs = session_plan(own, choice);
  std::unique_ptr<Replayed> reference;  // made when the first row wants it
  Panel panel;
  panel.name = "session";
  panel.title = session.path.filename().string();
  panel.quantity = "surface at the end: RMS distance over RMS displacement";
  panel.source = "its own refinement: " + label(finer, own.steps > 0);
  panel.in_motion = own.simulated > 0;
  panel.of_session = true;
  for (const SessionRun& run : runs) {
    const std::uint64_t key = key_of(session, run, setting);
    if (const Row* known = table.find(key)) {
      panel.rows.push_back(*known);
      continue;
    }
    if (!reference) {
      if (tell) tell("the reference, " + label(finer, own.steps > 0), nullptr);
      reference = std::make_unique<Replayed>(replay(session, &finer, common, patient, scratch));
    }
    if (tell) tell(label(run, own.steps > 0), nullptr);
    Row row;
    row.key = key;
    row.problem = panel.title;
    row.model = run.model;
    row.formulation = run.formulation;
    row.integrator = own.steps > 0 ? run.integrator : "";
    row.space = run.space;
    row.resolution = run.level;
    row.same_law = run.model == own.run.model;
    row.threads = setting.threads;
    row.version = ARGIL_VERSION;
    row.commit = commit();
    try {
      const PeakMemory memory;
      row = compared(std::move(row), replay(session, &run, common, setting, scratch), *reference);
      row.peak_bytes = memory.growth();
    } catch (const Error& error) {
      row.status = error.code() == ErrorCode::limit_exceeded ? Status::over_time
                   : error.code() == ErrorCode::not_converged
                       ? (own.steps > 0 ? Status::diverged : Status::not_converged)
                       : Status::refused;
      row.message = error.what();
    }
    table.add(row);
    panel.rows.push_back(row);
    if (tell) tell(label(run, own.steps > 0), &row);
  }
  return panel;
}

}  // namespace argil::chart
