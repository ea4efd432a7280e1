#pragma once
// `argil chart` from plan to results: what is asked for is run, rows and pictures land in one folder.

#include "tools/chart/page.h"
#include "tools/chart/runner.h"

namespace argil::chart {

/// Names to keep of each list; empty keeps all.
struct Choice {
  std::vector<std::string> problems, models, spaces, integrators;
};
/// @throws Error (not_found) for a name that no row has, with those that there are.
[[nodiscard]] Lists chosen(Lists lists, const Choice& choice);
/// Problems that a quick chart runs if none is named.
[[nodiscard]] Lists quick_problems(Lists lists);

/// A panel a problem that has rows among `keys`, in the order of the problems; rows in the order of the runs.
[[nodiscard]] std::vector<Panel> panels(const std::vector<Run>& runs, const Setting& setting, const Table& table);

}  // namespace argil::chart
