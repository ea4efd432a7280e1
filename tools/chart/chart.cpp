#include "tools/chart/chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "sculpt/near_names.h"
#include "subdiv/error.h"

namespace argil::chart {

namespace {

template <class Item, class Name>
void keep(std::vector<Item>& items, const std::vector<std::string>& names, const char* kind,
          const Name& name_of_item) {
  if (names.empty()) return;
  std::vector<std::string> there;
  for (const Item& item : items) there.push_back(std::string(name_of_item(item)));
  for (const std::string& name : names) {
    if (std::find(there.begin(), there.end(), name) != there.end()) continue;
    std::string list;
    for (const std::string& t : there)
      if (list.find(t + ",") == std::string::npos) list += t + ", ";
    list.resize(list.size() >= 2 ? list.size() - 2 : 0);
    throw Error(ErrorCode::not_found, fmt::format("'{}' is not a {} of the chart{}; there are {}", name, kind,
                                                  sculpt::near_names_hint(name, there), list));
  }
  std::erase_if(items, [&](const Item& item) {
    return std::find(names.begin(), names.end(), name_of_item(item)) == names.end();
  });
}

}  // namespace

Lists chosen(Lists lists, const Choice& choice) {
  keep(lists.problems, choice.problems, "problem", [](const Problem& p) { return p.name; });
  keep(lists.models, choice.models, "model", [](const ModelRow& m) { return m.choice.name; });
  keep(lists.spaces, choice.spaces, "space", [](const SpaceRow& s) { return s.name; });
  keep(lists.integrators, choice.integrators, "integrator",
       [](const fem::MethodKind& m) { return std::string(m.name); });
  return lists;
}

Lists quick_problems(Lists lists) {
  std::erase_if(lists.problems, [](const Problem& problem) { return !problem.in_quick; });
  return lists;
}

std::vector<Panel> panels(const std::vector<Run>& runs, const Setting& setting, const Table& table) {
  std::vector<Panel> result;
  std::vector<const Problem*> problems;
  for (const Run& run : runs)
    if (std::find(problems.begin(), problems.end(), run.problem) == problems.end()) problems.push_back(run.problem);
  std::sort(problems.begin(), problems.end());  // all from one list: its order
  for (const Problem* problem : problems) {
    Panel panel;
    panel.name = problem->name;
    panel.title = problem->title;
    panel.quantity = problem->quantity;
    panel.source = problem->source;
    panel.in_motion = problem->analysis == Analysis::motion;
    panel.uncertainty = problem->uncertainty;
    for (const Run& run : runs)
      if (const Row* row = run.problem == problem ? table.find(key_of(run, setting)) : nullptr)
        panel.rows.push_back(*row);
    if (!panel.rows.empty()) result.push_back(std::move(panel));
  }
  return result;
}

}  // namespace argil::chart
