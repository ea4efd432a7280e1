#include "sculpt/step_trace.h"

#include <fmt/format.h>

#include <vector>

#include "fem/measure/energy.h"
#include "fem/measure/quality.h"
#include "sculpt/force_tools/force_tool.h"
#include "sculpt/obstacles.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

// Names and values are written side by side, so that they cannot part.
class Row {
 public:
  void add(const char* name, double value) { add(name, fmt::format("{}", value)); }
  void add(const char* name, std::size_t value) { add(name, fmt::format("{}", value)); }
  void add(const char* name, int value) { add(name, fmt::format("{}", value)); }
  void add(const char* name, const char* unit, const Eigen::Vector3d& value) {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      add(fmt::format("{}_{}_{}", name, "xyz"[axis], unit), fmt::format("{}", value[axis]));
  }
  std::string names, values;

 private:
  void add(const std::string& name, const std::string& value) {
    names += (names.empty() ? "" : ",") + name;
    values += (values.empty() ? "" : ",") + value;
  }
};

struct Balance {
  fem::Energy energy;
  double springs = 0, loads = 0, contact = 0, volume = 0, min_volume_ratio = 1;
  LostEnergy lost;
  fem::Momentum momentum;
  fem::Wrench reaction, tool;
};

Balance balance_of(const Document& document, const fem::Loads& tool) {
  const fem::System system = document.system();
  const fem::BodyState& motion = *document.state().motion;
  const Eigen::Matrix3Xd nodes = fem::nodes(system, motion.positions);
  fem::Loads loads = document.loads();
  Balance balance;
  balance.energy = fem::energy(system, motion);
  balance.springs =
      fem::spring_energy(loads.springs, motion.positions) + fem::spring_energy(tool.springs, motion.positions);
  balance.loads = fem::load_potential(loads, document.rest(), motion.positions);
  if (const auto contact = contact_at(document, motion.time))
    balance.contact = fem::stored_energy(*contact, motion);
  balance.lost = document.state().lost;
  balance.volume = fem::volume(document.discretization(), nodes);
  balance.min_volume_ratio = fem::min_volume_ratio(document.discretization().blocks, nodes);
  balance.momentum = fem::momentum(system, motion);
  balance.tool = wrench_of(tool, motion.positions);
  const fem::Wrench soft = fem::wrench(loads.springs, motion.positions);
  loads = standing_loads(document);
  add_loads(loads, tool);
  balance.reaction = fem::wrench(fem::reactions(system, loads, motion.positions), motion.positions);
  balance.reaction.force += soft.force;
  balance.reaction.moment += soft.moment;
  return balance;
}

Row row_of(const Balance& balance, double time, const StepRecord& record, std::size_t number, int line) {
  Row row;
  row.add("step", number);
  row.add("line", line);
  row.add("time_s", time);
  row.add("kinetic_J", balance.energy.kinetic);
  row.add("elastic_J", balance.energy.elastic);
  row.add("springs_J", balance.springs);
  row.add("loads_J", balance.loads);
  row.add("contact_J", balance.contact);
  row.add("friction_loss_J", balance.lost.friction);
  row.add("flow_loss_J", balance.lost.flow);
  row.add("total_J", balance.energy.kinetic + balance.energy.elastic + balance.springs + balance.loads +
                         balance.contact + balance.lost.friction + balance.lost.flow);
  row.add("momentum", "Ns", balance.momentum.linear);
  row.add("angular_momentum", "Nms", balance.momentum.angular);
  row.add("volume_m3", balance.volume);
  row.add("min_volume_ratio", balance.min_volume_ratio);
  row.add("reaction", "N", balance.reaction.force);
  row.add("reaction_moment", "Nm", balance.reaction.moment);
  row.add("tool_force", "N", balance.tool.force);
  row.add("newton_iterations", record.report.newton_iterations);
  row.add("linear_iterations", record.report.linear_iterations);
  row.add("residual", record.report.residual);
  row.add("converged", record.report.converged ? 1 : 0);
  row.add("step_ms", record.ms);
  return row;
}

}  // namespace

const std::string& step_trace_header() {
  static const std::string header = row_of({}, 0, {}, 0, 0).names;
  return header;
}

std::string step_trace_row(const Document& document, const fem::Loads& tool, const StepRecord& record,
                           std::size_t number, int line) {
  return row_of(balance_of(document, tool), document.state().motion->time, record, number, line).values;
}

void StepTrace::open(const std::filesystem::path& path) {
  file_.open(path, std::ios::trunc);
  if (!file_)
    throw Error(ErrorCode::bad_input,
                fmt::format("the trace '{}' cannot be written; choose another file with --trace", path.string()));
  write(step_trace_header());
}

}  // namespace argil::sculpt
