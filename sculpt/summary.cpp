#include "sculpt/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "fem/solvers/solver_choice.h"
#include "sculpt/measures.h"
#include "sculpt/obstacles.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

}  // namespace

std::string summary_json(const Session& session, const std::string& name, int threads) {
  using nlohmann::ordered_json;
  const Document& document = session.document();
  ordered_json json;
  json["version"] = ARGIL_VERSION;
  json["session"] = name;
  json["state_hash"] = fmt::format("{:016x}", document.state_hash());
  json["topology_hash"] = fmt::format("{:016x}", document.solid().topology_hash());
  json["steps"] = session.steps().size();
  json["space"] = fem::word(document.state().space);
  json["levels"] = document.state().level;
  json["rules"] = word(document.state().rules);
  json["model"] = document.state().model.name;
  json["formulation"] = fem::word(document.state().model.formulation);
  json["integrator"] = fem::method_kind(document.state().method).name;
  json["control_cells"] = document.solid().cell_count();
  // A solid that was never simulated, and cannot be, still has counts.
  try {
    const fem::Discretization& d = document.discretization();
    json["cells"] = {{"regular", d.cells.regular},
                     {"regular_published", d.cells.regular_published},
                     {"extraordinary", d.cells.extraordinary},
                     {"irregular", d.cells.irregular}};
    json["elements"] = {
        {"cubic", d.elements.cubic}, {"linear", d.elements.linear}, {"pyramid", d.elements.pyramid}};
    json["pyramids_without_stiffness"] = d.elements.pyramids_without_stiffness;
    json["unknowns"] = static_cast<std::size_t>(measure(document, {.name = "unknowns"}));
    for (const char* measured : {"energy", "volume", "mass"})
      json[measured] = measure(document, {.name = measured});
  } catch (const Error& error) {
    const fem::CellCounts cells =
        document.empty() ? fem::CellCounts{} : fem::count_cells(document.refinement().solid());
    json["cells"] = {{"regular", cells.regular},
                     {"regular_published", cells.regular_published},
                     {"extraordinary", cells.extraordinary},
                     {"irregular", cells.irregular}};
    json["elements"] = {{"cubic", 0}, {"linear", 0}, {"pyramid", 0}};
    json["not_simulated"] = error.what();
  }
  std::vector<double> ms;
  double all_ms = 0;
  fem::StepReport sum;
  for (const StepRecord& step : session.steps()) {
    ms.push_back(step.ms);
    all_ms += step.ms;
    fem::append(sum, step.report);
  }
  ordered_json guard;
  guard["on"] = document.state().guard_on;
  guard["frozen"] = document.state().guard.frozen;
  const auto count = [&](const auto& holds) {
    return std::count_if(session.steps().begin(), session.steps().end(), holds);
  };
  for (const fem::GuardFinding finding : fem::k_guard_findings)
    guard["found"][std::string(fem::word(finding))] =
        count([&](const StepRecord& step) { return step.finding == finding; });
  for (const fem::GuardRemedy remedy : fem::k_guard_remedies)
    guard["steps"][std::string(fem::word(remedy))] =
        count([&](const StepRecord& step) { return step.remedy == remedy; });
  const double n = std::max<double>(1, static_cast<double>(ms.size()));
  json["ms_per_step"] = {
      {"median", quantile(ms, 0.5)},
      {"p99", quantile(ms, 0.99)},
      {"mean", all_ms / n},
      {"forces", sum.ms_forces / n},
      {"tangent", sum.ms_tangent / n},
      {"solve", sum.ms_solve / n},
      {"line_search", sum.ms_line_search / n},
      {"other", (all_ms - sum.ms_forces - sum.ms_tangent - sum.ms_solve - sum.ms_line_search) / n}};
  json["solver_iterations"] = sum.linear_iterations;
  json["newton_iterations"] = sum.newton_iterations;
  json["guard"] = guard;
  json["linear_solver"]["rule"] = fem::solver_rule();
  for (const fem::PreconditionerKind kind : fem::k_preconditioner_kinds)
    json["linear_solver"]["steps"][std::string(fem::word(kind))] =
        count([&](const StepRecord& step) { return step.report.preconditioner == kind; });
  ordered_json keyed = ordered_json::array();
  if (!document.state().loads->gravity_track.empty()) keyed.push_back("gravity");
  for (const AppliedForce& force : document.state().loads->forces)
    if (!force.track.empty()) keyed.push_back("force " + force.name);
  for (const AppliedPressure& pressure : document.state().loads->pressures)
    if (!pressure.track.empty()) keyed.push_back("pressure " + pressure.name);
  if (!document.state().loads->prestress_track.empty()) keyed.push_back("prestress");
  for (const PinMotion& motion : document.state().pins->motions) keyed.push_back("pin " + motion.name);
  if (!keyed.empty()) json["keyed"] = keyed;
  json["threads"] = threads;
  if (document.state().obstacles) {
    ordered_json obstacles = ordered_json::array();
    for (const NamedObstacle& obstacle : *document.state().obstacles) obstacles.push_back(description(obstacle));
    json["obstacles"] = obstacles;
  }
  if (const Plasticity& plasticity = document.state().plasticity; plasticity.on)
    json["plasticity"] = {{"yield_Pa", plasticity.law.yield}, {"creep_s", plasticity.law.relaxation}};
  ordered_json measures = ordered_json::array();
  for (const MeasureRecord& record : session.measures())
    measures.push_back({{"name", record.name}, {"value", record.value}, {"line", record.line}});
  json["measures"] = measures;
  json["expectations"] = {{"checked", session.expectations}, {"failed", session.failed().size()}};
  json["skipped_pictures"] = session.skipped_pictures;
  return json.dump(2);
}

}  // namespace argil::sculpt
