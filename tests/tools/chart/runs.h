#pragma once
// Runs of the chart by the names of their problem, model and space.

#include <gtest/gtest.h>

#include "subdiv/error.h"
#include "tools/chart/runner.h"

namespace argil::chart::test {

inline const Lists& lists() {
  static const Lists all = all_lists();
  return all;
}
inline const ModelRow& model(const std::string& name) {
  for (const ModelRow& row : lists().models)
    if (row.name() == name) return row;
  throw Error(ErrorCode::not_found, name);
}
inline const SpaceRow& space(const std::string& name) {
  for (const SpaceRow& row : lists().spaces)
    if (row.name == name) return row;
  throw Error(ErrorCode::not_found, name);
}

inline Row run(const Problem& problem, const std::string& of_model, const std::string& in_space, int resolution,
               const std::string& integrator = {}, double time_step = 0) {
  Run what{&problem, &model(of_model), &space(in_space), nullptr, resolution, time_step};
  if (!integrator.empty()) what.integrator = &fem::method_by_name(integrator);
  Setting setting;
  setting.repeats = 1;
  Row row = execute(what, setting);
  EXPECT_EQ(row.status, Status::ok) << what.label() << ": " << row.message;
  return row;
}
inline Row run(const std::string& problem, const std::string& of_model, const std::string& in_space, int resolution,
               const std::string& integrator = {}, double time_step = 0) {
  return run(problem_by_name(problem), of_model, in_space, resolution, integrator, time_step);
}

}  // namespace argil::chart::test
