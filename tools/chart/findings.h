#pragma once
// What the rows of a panel say, in sentences made from them: what to choose, what failed and why. Nothing is said
// that the rows do not show.

#include <string>
#include <vector>

#include "tools/chart/series.h"

namespace argil::chart {

struct Findings {
  std::vector<std::string> choice;    // sentences of one paragraph
  std::vector<std::string> failures;  // one a method and reason
};
[[nodiscard]] Findings findings(const Panel& panel);

}  // namespace argil::chart
