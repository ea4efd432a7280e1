#include "tools/chart/problem.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

#include "subdiv/error.h"

namespace argil::chart {

std::vector<Problem> static_problems();   // problems_at_rest.cpp
std::vector<Problem> dynamic_problems();  // problems_in_motion.cpp

bool Problem::holds_for(const std::string& model) const {
  if (laws.empty()) return true;
  for (const std::string& law : laws)
    if (law == model) return true;
  return false;
}

const std::vector<Problem>& problem_table() {
  static const std::vector<Problem> table = [] {
    std::vector<Problem> all = static_problems();
    for (Problem& problem : dynamic_problems()) all.push_back(std::move(problem));
    return all;
  }();
  return table;
}

const Problem& problem_by_name(const std::string& name) {
  std::string names;
  for (const Problem& problem : problem_table()) {
    if (problem.name == name) return problem;
    names += (names.empty() ? "" : ", ") + problem.name;
  }
  throw Error(ErrorCode::not_found, fmt::format("'{}' is not a problem of the chart; there are {}", name, names));
}

double relative_error(const std::vector<double>& found, const std::vector<double>& expected) {
  assert(found.size() == expected.size());
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    difference += (found[i] - expected[i]) * (found[i] - expected[i]);
    size += expected[i] * expected[i];
  }
  return std::sqrt(difference / size);
}

double signed_error(const std::vector<double>& found, const std::vector<double>& expected) {
  assert(found.size() == expected.size());
  double along = 0, size = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    along += (found[i] - expected[i]) * expected[i];
    size += expected[i] * expected[i];
  }
  return along / size;
}

}  // namespace argil::chart
