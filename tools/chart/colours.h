#pragma once
// Which colour stands for which method on a page of panels.

#include <map>
#include <string>
#include <vector>

#include "tools/chart/series.h"

namespace argil::chart {

/// Colours that keep their meaning over all panels of a page, in the order of first appearance: a model with the
/// first integrator has that of the model alone. When they are used up they come again with a dot in their markers.
class Colours {
 public:
  explicit Colours(const std::vector<Panel>& panels);
  struct Look {
    const char* colour;
    bool dotted;
  };
  [[nodiscard]] Look of(const std::string& colour_name) const;

 private:
  [[nodiscard]] std::string key(const std::string& colour_name) const;

  std::string usual_;  // ", bdf2"
  std::map<std::string, std::size_t> number_;
};

}  // namespace argil::chart
